//! Parts that the student's page and the class page share. Text of a submission goes through [`escape`](super::escape) first.

use fem_chart::page::static_page;
use maud::{Markup, html};

use super::escape;

/// A whole page, without scripts.
pub fn page(title: &str, body: Markup) -> String {
    static_page(&escape::plain(title), include_str!("page.css"), body)
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
