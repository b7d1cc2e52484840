//! Heat maps: a cell for each pair of two parameters, and curves over them.

use maud::html;

use crate::svg::{line, points, rectangle, text, title, window};
use crate::{COLOURS, Picture};

/// The shade of a cell.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shade {
    /// Green.
    Good,
    /// Amber.
    Fair,
    /// Red.
    Bad,
}

/// A cell.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Column, from the left.
    pub column: usize,
    /// Row, from the bottom.
    pub row: usize,
    /// Shade.
    pub shade: Shade,
    /// Text on the cell.
    pub text: String,
    /// Shown under the pointer.
    pub title: String,
}

/// A curve over a map: name and points.
pub type Curve = (String, Vec<(f64, f64)>);

/// A map over two parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// A description for readers who cannot see the map.
    pub label: String,
    /// Name and values of the horizontal parameter.
    pub columns: (String, Vec<String>),
    /// Name and values of the vertical parameter.
    pub rows: (String, Vec<String>),
    /// Cells in any order; a missing cell stays empty.
    pub cells: Vec<Cell>,
    /// Curves. A point (column, row) of two whole numbers is the centre of a cell.
    pub curves: Vec<Curve>,
    /// Width and height of a cell, pixels.
    pub cell: (f64, f64),
}

/// Margins for values and names, pixels: left, right, top, bottom.
const MARGINS: (f64, f64, f64, f64) = (76.0, 14.0, 26.0, 46.0);

impl HeatMap {
    /// Draws the map.
    pub fn draw(&self) -> Picture {
        let (w, h) = self.cell;
        let (left, top) = (MARGINS.0, MARGINS.2);
        let (right, bottom) = (left + w * self.columns.1.len() as f64, top + h * self.rows.1.len() as f64);
        let place = |column: f64, row: f64| (left + w * (column + 0.5), bottom - h * (row + 0.5));
        let cell = |cell: &Cell| {
            let (x, y) = place(cell.column as f64, cell.row as f64);
            let class = match cell.shade {
                Shade::Good => "cell good",
                Shade::Fair => "cell fair",
                Shade::Bad => "cell bad",
            };
            html! {
                (rectangle(class, (x - 0.5 * w + 1.0, y - 0.5 * h + 1.0), (w - 2.0, h - 2.0), &cell.title))
                @if !cell.text.is_empty() { (text("oncell", "middle", (x, y + 4.0), &cell.text)) }
            }
        };
        let curve = |(i, (name, places)): (usize, &Curve)| {
            let finite = places.iter().filter(|(column, row)| column.is_finite() && row.is_finite());
            let places = points(finite.map(|&(column, row)| place(column, row)));
            html! { polyline class={ "limit k" (i % COLOURS) } points=(places) { (title(name)) } "\n" }
        };
        let inner = html! {
            @for one in &self.cells { (cell(one)) }
            @for (column, name) in self.columns.1.iter().enumerate() {
                (text("", "middle", (place(column as f64, 0.0).0, bottom + 17.0), name))
            }
            @for (row, name) in self.rows.1.iter().enumerate() {
                (text("", "end", (left - 7.0, place(0.0, row as f64).1 + 4.0), name))
            }
            (line("axis", (left, bottom), (right, bottom)))
            (text("name", "end", (right, bottom + 36.0), &self.columns.0))
            (text("name", "start", (8.0, top - 10.0), &self.rows.0))
            (window((left, top), (right - left, bottom - top), html! { @for one in self.curves.iter().enumerate() { (curve(one)) } }))
        };
        let mark = |i: usize| html! { polyline class={ "limit k" (i % COLOURS) } points="-8,0 8,0" {} };
        let legend = self.curves.iter().enumerate().map(|(i, (name, _))| (name.clone(), mark(i))).collect();
        Picture { size: (right + MARGINS.1, bottom + MARGINS.3), label: self.label.clone(), inner, legend }
    }
}
