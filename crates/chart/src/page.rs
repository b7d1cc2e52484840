//! HTML pages without external resources: in the light, in the dark, on a phone, on paper.

use maud::{DOCTYPE, Markup, PreEscaped, Render, html};

use crate::{Picture, STYLE};

/// A page with the style of reports. A script shows the titles of dots, cells and bars at once, under a finger too.
pub fn page(title: &str, body: Markup) -> String {
    document(title, PAGE, Some((SCRIPT, "'unsafe-inline'")), body)
}

/// A page with a style of its own, and without scripts.
pub fn static_page(title: &str, style: &str, body: Markup) -> String {
    document(title, style, None, body)
}

/// A page with a style and a script of its own. `source` is the script's hash as a Content Security Policy names it, so that a browser
/// runs this script and no other.
pub fn scripted_page(title: &str, style: &str, (script, source): (&str, &str), body: Markup) -> String {
    document(title, style, Some((script, source)), body)
}

fn document(title: &str, style: &str, script: Option<(&str, &str)>, body: Markup) -> String {
    let scripts = script.map_or(String::new(), |(_, source)| format!("; script-src {source}"));
    let page = html! {
        (DOCTYPE) "\n"
        html lang="en" {
            head {
                meta charset="utf-8";
                meta name="viewport" content="width=device-width, initial-scale=1";
                meta http-equiv="Content-Security-Policy" content={ "default-src 'none'; style-src 'unsafe-inline'" (scripts) };
                meta name="referrer" content="no-referrer";
                meta name="color-scheme" content="light dark";
                title { (title) } "\n"
                style { (PreEscaped(STYLE)) (PreEscaped(style)) } "\n"
            }
            body {
                main { "\n" (body) "\n" }
                @if let Some((script, _)) = script { script { (PreEscaped(script)) } }
            }
        }
    };
    page.into_string() + "\n"
}

/// A picture with its legend and its caption.
pub fn figure(picture: &Picture, caption: impl Render) -> Markup {
    html! { figure { (picture.inline()) (picture.legend()) figcaption { (caption) } } "\n" }
}

/// A table. A head that begins with `>` aligns its column to the right, for numbers. Cells that are text are escaped.
pub fn table<R: Render>(head: &[&str], rows: &[Vec<R>]) -> Markup {
    let class = |column: usize| head.get(column).is_some_and(|name| name.starts_with('>')).then_some("right");
    html! {
        div class="scroll" {
            table { "\n"
                thead { tr {
                    @for (column, name) in head.iter().enumerate() { th class=[class(column)] { (name.trim_start_matches('>')) } }
                } } "\n"
                tbody { "\n"
                    @for row in rows {
                        tr { @for (column, cell) in row.iter().enumerate() { td class=[class(column)] { (cell) } } } "\n"
                    }
                }
            }
        } "\n"
    }
}

/// A part that the reader can open, and that is always open on paper.
pub fn details(summary: &str, contents: Markup) -> Markup {
    html! { details { summary { (summary) } "\n" (contents) } "\n" }
}

const PAGE: &str = include_str!("page.css");

const SCRIPT: &str = include_str!("page.js");

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pages_load_no_external_resource() {
        let text = || html! { p { "text" } };
        let scripted = scripted_page("a <page>", "", ("let x = 1;", "'sha256-x='"), text());
        assert!(scripted.contains("script-src 'sha256-x='") && scripted.contains("<script>let x = 1;</script>"));
        for page in [page("a <page>", text()), static_page("a <page>", "", text()), scripted] {
            assert!(page.contains("<title>a &lt;page&gt;</title>") && page.contains("default-src 'none'"));
            for word in ["http://", "https://", "src=", "@import", "url("] {
                assert!(!page.contains(word), "{word}");
            }
        }
        assert!(!static_page("", "", html! {}).contains("script"));
    }

    #[test]
    fn cells_of_text_are_escaped() {
        let cells = table(&["a", ">b"], &[vec![html! { "1 & 2" }, html! { b { "3" } }]]).into_string();
        assert!(cells.contains("<td>1 &amp; 2</td><td class=\"right\"><b>3</b></td>"), "{cells}");
        assert!(table(&["a"], &[vec!["<i>"]]).into_string().contains("<td>&lt;i&gt;</td>"));
    }
}
