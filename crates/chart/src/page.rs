//! HTML pages that hold all they need and ask nothing of any other place: in the light, in the dark, on a phone, on paper.

use crate::{Picture, STYLE, escape};

/// A whole page. `body` is HTML, `title` is text.
pub fn page(title: &str, body: &str) -> String {
    let policy = "default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'";
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"{policy}\">\n\
         <meta name=\"color-scheme\" content=\"light dark\">\n<title>{}</title>\n<style>\n{STYLE}{PAGE}</style>\n</head>\n\
         <body>\n<main>\n{body}</main>\n<script>\n{SCRIPT}</script>\n</body>\n</html>\n",
        escape(title)
    )
}

/// A picture with its legend below it and a caption, which is HTML.
pub fn figure(picture: &Picture, caption: &str) -> String {
    let drawing = picture.inline();
    format!("<figure>\n{drawing}{}<figcaption>{caption}</figcaption>\n</figure>\n", picture.legend_html())
}

/// A table. A head that begins with `>` is that of a column of numbers, aligned to the right. Cells are text; one that begins
/// with `<` is HTML.
pub fn table(head: &[&str], rows: &[Vec<String>]) -> String {
    let class = |column: usize| {
        if head.get(column).is_some_and(|name| name.starts_with('>')) { " class=\"right\"" } else { "" }
    };
    let cell = |tag: &str, column: usize, content: &str| {
        let content = if content.starts_with('<') { content.to_owned() } else { escape(content) };
        format!("<{tag}{}>{content}</{tag}>", class(column))
    };
    let names: String =
        head.iter().enumerate().map(|(column, name)| cell("th", column, name.trim_start_matches('>'))).collect();
    let line = |row: &Vec<String>| {
        let cells: String = row.iter().enumerate().map(|(column, text)| cell("td", column, text)).collect();
        format!("<tr>{cells}</tr>\n")
    };
    let body: String = rows.iter().map(line).collect();
    format!("<div class=\"scroll\"><table>\n<thead><tr>{names}</tr></thead>\n<tbody>\n{body}</tbody>\n</table></div>\n")
}

/// What is shown when a reader asks for it; on paper always. `inside` is HTML.
pub fn details(summary: &str, inside: &str) -> String {
    format!("<details>\n<summary>{}</summary>\n{inside}</details>\n", escape(summary))
}

const PAGE: &str = include_str!("page.css");

const SCRIPT: &str = include_str!("page.js");

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_asks_nothing_of_any_other_place() {
        let page = page("a <page>", "<p>text</p>");
        assert!(page.contains("<title>a &lt;page&gt;</title>"));
        for word in ["http://", "https://", "src=", "@import", "url("] {
            assert!(!page.contains(word), "{word}");
        }
    }

    #[test]
    fn cells_are_text_unless_they_are_markup() {
        let table = table(&["a", ">b"], &[vec!["1 & 2".to_owned(), "<b>3</b>".to_owned()]]);
        assert!(table.contains("<td>1 &amp; 2</td><td class=\"right\"><b>3</b></td>"), "{table}");
    }
}
