//! The frame of an HTML page: it holds all it needs and asks nothing of any other place.

use super::escape;

/// A whole page. `body` is HTML, `title` is text.
pub fn page(title: &str, body: &str) -> String {
    format!(
        "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n\
         <meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n\
         <meta http-equiv=\"Content-Security-Policy\" content=\"default-src 'none'; style-src 'unsafe-inline'\">\n\
         <meta name=\"referrer\" content=\"no-referrer\">\n<meta name=\"color-scheme\" content=\"light dark\">\n\
         <title>{}</title>\n<style>\n{STYLE}</style>\n</head>\n<body>\n<main>\n{body}</main>\n</body>\n</html>\n",
        escape::html(title)
    )
}

/// A figure with its caption, as the head of a page shows them.
pub fn figure(value: &str, caption: &str) -> String {
    format!("<div><b>{}</b><span>{}</span></div>\n", escape::html(value), escape::html(caption))
}

const STYLE: &str = include_str!("page.css");
