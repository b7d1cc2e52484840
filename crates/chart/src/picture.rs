//! A finished drawing, for a page or as a file.

use maud::{Markup, PreEscaped, html};

use crate::STYLE;
use crate::svg::{Px, text};

/// A finished drawing.
#[derive(Clone, Debug)]
pub struct Picture {
    /// Width and height before scaling, pixels.
    pub(crate) size: (f64, f64),
    /// A description for readers who cannot see the drawing.
    pub(crate) label: String,
    /// The contents of the `svg` element.
    pub(crate) inner: Markup,
    /// Name and mark of each entry of the legend.
    pub(crate) legend: Vec<(String, Markup)>,
}

/// Columns of the legend of a file.
const COLUMNS: usize = 3;

/// Height of a line of that legend, pixels.
const ROW: f64 = 18.0;

/// Height of the title of a file, pixels.
const TITLE: f64 = 30.0;

impl Picture {
    /// The drawing for a page that includes [`STYLE`].
    pub fn inline(&self) -> Markup {
        let (width, height) = self.size;
        html! { svg viewBox={ "0 0 " (width) " " (height) } role="img" aria-label=(self.label) { "\n" (self.inner) } "\n" }
    }

    /// The legend for the same page.
    pub fn legend(&self) -> Markup {
        html! {
            @if !self.legend.is_empty() {
                div class="legend" {
                    @for (name, mark) in &self.legend {
                        span class="entry" { svg viewBox="-9 -7 18 14" aria-hidden="true" { (mark) } (name) } "\n"
                    }
                }
            }
        }
    }

    /// A file with its own style, the title above and the legend below the drawing.
    pub fn standalone(&self) -> String {
        let (width, height) = self.size;
        let rows = self.legend.len().div_ceil(COLUMNS);
        let whole = TITLE + height + ROW * rows as f64 + 14.0;
        let place = |i: usize| {
            let x = 60.0 + (width - 70.0) / COLUMNS as f64 * (i % COLUMNS) as f64;
            (x, TITLE + height + 6.0 + ROW * (i / COLUMNS) as f64)
        };
        let file = html! {
            svg xmlns="http://www.w3.org/2000/svg" viewBox={ "0 0 " (width) " " (whole) } width=(width) height=(whole) class="alone" {
                style { (PreEscaped(STYLE)) }
                rect class="paper" width=(width) height=(whole) {}
                (text("title", "start", (10.0, 20.0), &self.label))
                g transform={ "translate(0 " (TITLE) ")" } { (self.inner) } "\n"
                @for (i, (name, mark)) in self.legend.iter().enumerate() {
                    @let (x, y) = place(i);
                    g transform={ "translate(" (Px(x)) " " (Px(y)) ")" } { (mark) }
                    (text("", "start", (x + 12.0, y + 4.0), name))
                }
            }
        };
        file.into_string() + "\n"
    }
}
