//! Parts that the student's page and the class page share. Text of a submission goes through [`escape`](super::escape) first.

use fem_chart::page::{scripted_page, static_page};
use maud::{Markup, html};
use sha2::{Digest, Sha256};

use super::escape;

/// A whole page, without scripts.
pub fn page(title: &str, body: Markup) -> String {
    static_page(&escape::plain(title), include_str!("page.css"), body)
}

/// Sorts a table by its headings, and filters its rows.
const TABLE: &str = include_str!("table.js");

/// A whole page whose table of the class `sortable` can be sorted and filtered. Its script is the only one that a browser runs.
pub fn page_with_table(title: &str, body: Markup) -> String {
    let source = format!("'sha256-{}'", base64(&Sha256::digest(TABLE.as_bytes())));
    scripted_page(&escape::plain(title), include_str!("page.css"), (TABLE, &source), body)
}

/// Base64 (RFC 4648, with padding), in which a Content Security Policy names a hash.
fn base64(bytes: &[u8]) -> String {
    const LETTERS: &[u8; 64] = b"ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    let mut text = String::new();
    for group in bytes.chunks(3) {
        let bits = (0..3).fold(0, |bits, i| bits << 8 | u32::from(group.get(i).copied().unwrap_or(0)));
        for i in 0..4 {
            let letter = LETTERS[(bits >> (18 - 6 * i) & 63) as usize];
            text.push(if i <= group.len() { char::from(letter) } else { '=' });
        }
    }
    text
}

/// A figure with its caption, for the head of a page.
pub fn figure(value: &str, caption: &str) -> Markup {
    html! { div { b { (value) } span { (caption) } } "\n" }
}

/// A chart with its heading.
pub fn chart(heading: &str, picture: &fem_chart::Picture, caption: impl maud::Render) -> Markup {
    html! {
        figure { h2 { (heading) } (picture.inline()) (picture.legend()) figcaption { (caption) } } "\n"
    }
}

/// The name of a function. A narrow screen breaks it at its underscores.
pub fn name(name: &str) -> Markup {
    html! {
        @for (i, part) in escape::line(name).split('_').enumerate() { @if i > 0 { "_" wbr; } (part) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_page_with_a_table_runs_its_own_script_alone() {
        assert_eq!(
            ["", "f", "fo", "foo", "foob"].map(|text| base64(text.as_bytes())),
            ["", "Zg==", "Zm8=", "Zm9v", "Zm9vYg=="]
        );
        let page = page_with_table("<script>", html! { p { "<script>alert(1)</script>" } });
        assert_eq!((page.matches("<script>").count(), page.matches("</script>").count()), (1, 1), "{page}");
        let script = page.split("<script>").nth(1).and_then(|rest| rest.split("</script>").next()).unwrap();
        let hash = base64(&Sha256::digest(script.as_bytes()));
        assert!(
            page.contains(&format!("script-src &#39;sha256-{hash}&#39;"))
                || page.contains(&format!("script-src 'sha256-{hash}'"))
        );
    }
}
