//! Dots on one logarithmic axis, a row for each name.

use maud::{Markup, html};

use crate::bars::{SIZE, room};
use crate::svg::{line, mark, text, title};
use crate::{Axis, COLOURS, Dot, Picture};

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
