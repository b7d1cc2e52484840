//! Maps: a cell for each pair of two parameters, and curves over them.

use super::{COLOURS, Picture, escape, line, rectangle, text};

/// How a cell looks.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Shade {
    /// As it should be.
    Good,
    /// Between the two.
    Fair,
    /// As it should not be.
    Bad,
    /// Nothing is known of it.
    Empty,
    /// A value between 0 and 1, pale to strong.
    Strength(f64),
}

/// One pair of parameters.
#[derive(Clone, Debug, PartialEq)]
pub struct Cell {
    /// Counted from the left.
    pub column: usize,
    /// Counted from the bottom.
    pub row: usize,
    /// How it looks.
    pub shade: Shade,
    /// Written on it.
    pub text: String,
    /// Shown when a pointer rests on it.
    pub title: String,
}

/// A line over a map: its name, and its places.
pub type Curve = (String, Vec<(f64, f64)>);

/// Two parameters, a cell for each pair of their values.
#[derive(Clone, Debug, PartialEq)]
pub struct HeatMap {
    /// What it shows, for those who cannot see it.
    pub label: String,
    /// Name of what runs along, and its values.
    pub columns: (String, Vec<String>),
    /// Name of what runs up, and its values.
    pub rows: (String, Vec<String>),
    /// In any order; a pair without one stays empty.
    pub cells: Vec<Cell>,
    /// Lines over it, with their names; places are columns and rows, where a cell's middle is a whole number.
    pub curves: Vec<Curve>,
    /// Pixels of a cell.
    pub cell: (f64, f64),
}

/// Room for values and names: left, right, top, bottom.
const MARGINS: (f64, f64, f64, f64) = (76.0, 14.0, 26.0, 46.0);

impl HeatMap {
    /// The picture.
    pub fn draw(&self) -> Picture {
        let (left, top) = (MARGINS.0, MARGINS.2);
        let (w, h) = self.cell;
        let (columns, rows) = (self.columns.1.len() as f64, self.rows.1.len() as f64);
        let (right, bottom) = (left + w * columns, top + h * rows);
        let x = |column: f64| left + w * (column + 0.5);
        let y = |row: f64| bottom - h * (row + 0.5);
        let mut inner = String::new();
        for cell in &self.cells {
            let (at, size) =
                ((x(cell.column as f64) - 0.5 * w + 1.0, y(cell.row as f64) - 0.5 * h + 1.0), (w - 2.0, h - 2.0));
            inner.push_str(&shaded(cell.shade, at, size, &cell.title));
            let middle = (x(cell.column as f64), y(cell.row as f64) + 4.0);
            if !cell.text.is_empty() {
                inner.push_str(&text("oncell", "middle", middle, &cell.text));
            }
        }
        for (column, name) in self.columns.1.iter().enumerate() {
            inner.push_str(&text("", "middle", (x(column as f64), bottom + 17.0), name));
        }
        for (row, name) in self.rows.1.iter().enumerate() {
            inner.push_str(&text("", "end", (left - 7.0, y(row as f64) + 4.0), name));
        }
        inner.push_str(&line("axis", (left, bottom), (right, bottom)));
        inner.push_str(&text("name", "end", (right, bottom + 36.0), &self.columns.0));
        inner.push_str(&text("name", "start", (8.0, top - 10.0), &self.rows.0));
        inner.push_str(&format!(
            "<svg x=\"{left}\" y=\"{top}\" width=\"{}\" height=\"{}\" viewBox=\"{left} {top} {} {}\">\n",
            right - left,
            bottom - top,
            right - left,
            bottom - top
        ));
        for (i, (name, points)) in self.curves.iter().enumerate() {
            let finite = points.iter().filter(|(column, row)| column.is_finite() && row.is_finite());
            let places: Vec<String> = finite.map(|&(column, row)| format!("{:.1},{:.1}", x(column), y(row))).collect();
            inner.push_str(&format!(
                "<polyline class=\"limit k{}\" points=\"{}\"><title>{}</title></polyline>\n",
                i % COLOURS,
                places.join(" "),
                escape(name)
            ));
        }
        inner.push_str("</svg>\n");
        Picture {
            size: (right + MARGINS.1, bottom + MARGINS.3),
            label: self.label.clone(),
            inner,
            legend: self.legend(),
        }
    }

    fn legend(&self) -> Vec<(String, String)> {
        let mark = |i: usize| format!("<polyline class=\"limit k{}\" points=\"-8,0 8,0\"/>", i % COLOURS);
        self.curves.iter().enumerate().map(|(i, (name, _))| (name.clone(), mark(i))).collect()
    }
}

fn shaded(shade: Shade, at: (f64, f64), size: (f64, f64), title: &str) -> String {
    match shade {
        Shade::Good => rectangle("cell good", at, size, title),
        Shade::Fair => rectangle("cell fair", at, size, title),
        Shade::Bad => rectangle("cell bad", at, size, title),
        Shade::Empty => rectangle("cell none", at, size, title),
        Shade::Strength(value) => {
            let opacity = if value.is_finite() { 0.06 + 0.94 * value.clamp(0.0, 1.0) } else { 0.0 };
            format!("<g fill-opacity=\"{opacity:.3}\">{}</g>", rectangle("cell strong", at, size, title))
        }
    }
}
