//! Rows with a name and a figure each: stacked bars, or dots on one logarithmic axis.

use maud::{Markup, html};

use crate::svg::{line, mark, rectangle, text, title};
use crate::{Axis, COLOURS, Dot, Picture};

/// A bar: shares that follow each other from left to right.
#[derive(Clone, Debug, PartialEq)]
pub struct Bar {
    /// Written on the left.
    pub name: String,
    /// Lengths, in the order of the kinds.
    pub shares: Vec<f64>,
    /// Written on the right.
    pub figure: String,
}

/// Width of the picture and height of a row, pixels.
const SIZE: (f64, f64) = (540.0, 24.0);

/// Bars of shares. `kinds` names each kind of share and the number of its colour. The longest bar fills the width. `tell` writes a
/// share, given the whole of its bar, for the reader who points at it.
pub fn bars(label: &str, kinds: &[(&str, usize)], bars: &[Bar], tell: impl Fn(f64, f64) -> String) -> Picture {
    let (width, row) = SIZE;
    let left = room(bars.iter().map(|bar| bar.name.as_str()));
    let length = width - left - room(bars.iter().map(|bar| bar.figure.as_str()));
    let size = |bar: &Bar| bar.shares.iter().filter(|share| share.is_finite()).sum::<f64>();
    let longest = bars.iter().map(size).fold(0.0, f64::max);
    let height = row * bars.len() as f64;
    let draw = |(i, bar): (usize, &Bar)| {
        let (y, mut x) = (row * i as f64, left);
        let shares = bar.shares.iter().zip(kinds).filter(|(share, _)| share.is_finite() && **share > 0.0);
        let parts: Vec<_> = shares
            .map(|(&share, (kind, colour))| {
                let tip = format!("{}: {kind} {}", bar.name, tell(share, size(bar)));
                let (at, extent) = ((x, y + 4.0), (length * share / longest, row - 8.0));
                x += extent.0;
                rectangle(&format!("share k{}", colour % COLOURS), at, extent, &tip)
            })
            .collect();
        html! {
            (text("", "end", (left - 8.0, y + 16.0), &bar.name))
            @for part in parts { (part) }
            (text("", "start", (x + 6.0, y + 16.0), &bar.figure))
        }
    };
    let inner = html! {
        (line("axis", (left, 0.0), (left, height)))
        @for bar in bars.iter().enumerate() { (draw(bar)) }
    };
    let entry =
        |colour: usize| html! { rect class={ "share k" (colour % COLOURS) } x="-6" y="-5" width="12" height="10" {} };
    let legend = kinds.iter().map(|(kind, colour)| ((*kind).to_owned(), entry(*colour))).collect();
    Picture { size: (width, height + 4.0), label: label.to_owned(), inner, legend }
}

/// Pixels for the longest of some texts, with a margin.
fn room<'a>(texts: impl Iterator<Item = &'a str>) -> f64 {
    14.0 + 6.4 * texts.map(|text| text.chars().count()).max().unwrap_or(0) as f64
}

/// A row: dots joined by a line. Their `y` is not used.
#[derive(Clone, Debug, PartialEq)]
pub struct DotRow {
    /// Written on the left.
    pub name: String,
    /// Dots, each with the number of its colour, from back to front.
    pub dots: Vec<(Dot, usize)>,
    /// Written on the right.
    pub figure: String,
}

/// Rows of dots over one axis.
pub fn dot_rows(label: &str, axis: &Axis, rows: &[DotRow]) -> Picture {
    let (width, height) = SIZE;
    let left = room(rows.iter().map(|row| row.name.as_str()));
    let right = width - room(rows.iter().map(|row| row.figure.as_str()));
    let bottom = height * rows.len() as f64 + 4.0;
    let x = axis.between(left + 8.0, right - 8.0, rows.iter().flat_map(|row| &row.dots).map(|(dot, _)| dot.x));
    let draw = |(i, row): (usize, &DotRow)| -> Markup {
        let y = height * (i as f64 + 0.5) + 2.0;
        let shown: Vec<_> = row.dots.iter().filter(|(dot, _)| axis.shows(dot.x)).collect();
        let ends = || shown.iter().map(|(dot, _)| x.at(dot.x));
        html! {
            (text("", "end", (left - 8.0, y + 4.0), &row.name))
            @if let Some((low, high)) = ends().reduce(f64::min).zip(ends().reduce(f64::max)) {
                (line("axis", (low, y), (high, y)))
            }
            @for (dot, colour) in shown {
                g class={ "dot k" (colour % COLOURS) } { (mark(0, (x.at(dot.x), y), 4.2)) (title(&dot.title)) } "\n"
            }
            (text("", "start", (right + 8.0, y + 4.0), &row.figure))
        }
    };
    let inner = html! {
        @for (value, name) in x.ticks() {
            @let at = x.at(value);
            (line("grid", (at, 0.0), (at, bottom)))
            (text("", "middle", (at, bottom + 16.0), &name))
        }
        @for row in rows.iter().enumerate() { (draw(row)) }
        (text("name", "end", (right, bottom + 34.0), &axis.name))
    };
    Picture { size: (width, bottom + 42.0), label: label.to_owned(), inner, legend: Vec::new() }
}
