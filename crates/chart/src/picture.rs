//! A finished drawing, for a page or as a file; and several of them on one.

use maud::{Markup, PreEscaped, html};
use serde::{Deserialize, Serialize};

use crate::svg::{Px, text};
use crate::{COLOURS, STYLE};

/// A finished drawing.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[serde(from = "Stored", into = "Stored")]
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

/// A drawing as it is stored: its elements as text.
#[derive(Serialize, Deserialize)]
struct Stored {
    size: (f64, f64),
    label: String,
    inner: String,
    legend: Vec<(String, String)>,
}

impl From<Picture> for Stored {
    fn from(Picture { size, label, inner, legend }: Picture) -> Self {
        let legend = legend.into_iter().map(|(name, mark)| (name, mark.into_string())).collect();
        Self { size, label, inner: inner.into_string(), legend }
    }
}

impl From<Stored> for Picture {
    fn from(Stored { size, label, inner, legend }: Stored) -> Self {
        let legend = legend.into_iter().map(|(name, mark)| (name, PreEscaped(mark))).collect();
        Self { size, label, inner: PreEscaped(inner), legend }
    }
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

    /// The same at another width, pixels, with smaller or larger texts; for a [`grid`].
    pub fn scaled(self, width: f64) -> Self {
        let (own, height) = self.size;
        let height_then = height * width / own;
        let inner = html! { svg width=(width) height=(Px(height_then)) overflow="visible" viewBox={ "0 0 " (own) " " (height) } { (self.inner) } };
        Self { size: (width, height_then), inner, ..self }
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
                style { (PreEscaped(literal_style())) }
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

/// Height of the title of each picture of a grid, and the space between pictures, pixels.
const GRID_TITLE: f64 = 22.0;
const GAP: f64 = 16.0;

/// Pictures in rows of `columns`, each under its label; their legends are left out.
pub fn grid(label: &str, columns: usize, pictures: &[Picture]) -> Picture {
    let (mut parts, mut y, mut width) = (Vec::<Markup>::new(), 0.0, 0.0_f64);
    for row in pictures.chunks(columns.max(1)) {
        let mut x = 0.0;
        for picture in row {
            let (w, h) = picture.size;
            let (left, top) = (x, y + GRID_TITLE);
            parts.push(html! {
                (text("name", "start", (left + 10.0, top - 7.0), &picture.label))
                svg x=(left) y=(top) width=(w) height=(h) viewBox={ "0 0 " (w) " " (h) } { (picture.inner) } "\n"
            });
            x += w + GAP;
        }
        width = width.max(x - GAP);
        y += GRID_TITLE + GAP + row.iter().map(|picture| picture.size.1).fold(0.0, f64::max);
    }
    let inner = html! { @for part in parts { (part) } };
    Picture { size: (width.max(1.0), y.max(1.0)), label: label.to_owned(), inner, legend: Vec::new() }
}

/// [`STYLE`] with the colours of the light page written out: viewers other than browsers know no variables of CSS, and draw in black.
fn literal_style() -> String {
    let (palette, rules) = STYLE.split_once("svg .paper").unwrap_or(("", STYLE));
    let colour = |name: &str| {
        let value = palette.split_once(&format!("--{name}: ")).and_then(|(_, rest)| rest.split(';').next());
        value.unwrap_or("#000000")
    };
    let written_out = |declarations: &str| {
        let mut parts = declarations.split("var(--");
        let first = parts.next().unwrap_or_default().to_owned();
        parts.fold(first, |text, part| {
            let (name, rest) = part.split_once(')').unwrap_or((part, ""));
            text + colour(name) + rest
        })
    };
    let mut style = String::new();
    for (selector, declarations) in format!("svg .paper{rules}").split('}').filter_map(|rule| rule.split_once('{')) {
        let selector = selector.trim();
        if selector.starts_with(".k") {
            continue; // the rules that give `--k` its value
        }
        if !declarations.contains("var(--k)") {
            style += &format!("{selector} {{{}}}\n", written_out(declarations));
            continue;
        }
        // The colour of a series: its class is that of the element or of the group around it.
        let part = selector.strip_prefix("svg ").unwrap_or(selector);
        for k in 0..COLOURS {
            let declarations = written_out(&declarations.replace("var(--k)", &format!("var(--k{k})")));
            style += &format!("svg .k{k} {part}, svg {part}.k{k} {{{declarations}}}\n");
        }
    }
    style
}
