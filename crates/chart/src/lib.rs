//! Charts as SVG that needs nothing but itself: points and lines on two axes, maps of cells, bars of shares.
//!
//! A [`Picture`] goes into a page, whose style colours it, or into a file of its own, which then carries that style. What is not
//! finite, or not positive on a logarithmic axis, is left out: no picture holds a NaN.

#![deny(missing_docs)]

mod axis;
mod bars;
mod chart;
mod heat;
pub mod page;

pub use axis::{Axis, Scale};
pub use bars::{Bar, bars};
pub use chart::{Chart, Dot, Guide, Series};
pub use heat::{Cell, Curve, HeatMap, Shade};

/// Colours of all pictures, light and dark.
pub const STYLE: &str = include_str!("picture.css");

/// Colours that follow each other in a chart; further series begin anew.
pub const COLOURS: usize = 9;

/// Shapes of dots that follow each other in a chart.
pub const SHAPES: usize = 5;

/// A finished drawing.
#[derive(Clone, Debug, PartialEq)]
pub struct Picture {
    /// Pixels that it is drawn in, before it is scaled.
    pub size: (f64, f64),
    /// What it shows, for those who cannot see it.
    pub label: String,
    /// What is inside the element.
    pub inner: String,
    /// Name and mark of what it shows; empty where there is nothing to tell apart.
    pub legend: Vec<(String, String)>,
}

impl Picture {
    /// For a page that has [`STYLE`].
    pub fn inline(&self) -> String {
        let (width, height) = self.size;
        let label = escape(&self.label);
        format!("<svg viewBox=\"0 0 {width} {height}\" role=\"img\" aria-label=\"{label}\">\n{}</svg>\n", self.inner)
    }

    /// Its legend for a page.
    pub fn legend_html(&self) -> String {
        let entry = |(name, mark): &(String, String)| {
            let svg = format!("<svg viewBox=\"-9 -7 18 14\" aria-hidden=\"true\">{mark}</svg>");
            format!("<span class=\"entry\">{svg}{}</span>\n", escape(name))
        };
        let entries: String = self.legend.iter().map(entry).collect();
        if entries.is_empty() { entries } else { format!("<div class=\"legend\">\n{entries}</div>\n") }
    }

    /// A file of its own, with its title above and its legend below.
    pub fn standalone(&self) -> String {
        let (width, height) = self.size;
        let (columns, row) = (3, 18.0);
        let top = 30.0;
        let rows = self.legend.len().div_ceil(columns);
        let whole = top + height + row * rows as f64 + 14.0;
        let mut legend = String::new();
        for (i, (name, mark)) in self.legend.iter().enumerate() {
            let x = 60.0 + (width - 70.0) / columns as f64 * (i % columns) as f64;
            let y = top + height + 6.0 + row * (i / columns) as f64;
            legend.push_str(&format!("<g transform=\"translate({x:.1} {y:.1})\">{mark}</g>\n"));
            legend.push_str(&text("", "start", (x + 12.0, y + 4.0), name));
        }
        let title = text("title", "start", (10.0, 20.0), &self.label);
        format!(
            "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {whole}\" width=\"{width}\" height=\"{whole}\" \
             class=\"alone\">\n<style>\n{STYLE}</style>\n<rect class=\"paper\" width=\"{width}\" height=\"{whole}\"/>\n{title}\
             <g transform=\"translate(0 {top})\">\n{}</g>\n{legend}</svg>\n",
            self.inner
        )
    }
}

/// Text in which the signs of markup are spelt out.
pub fn escape(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for character in text.chars() {
        match character {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            other => safe.push(other),
        }
    }
    safe
}

fn line(class: &str, (x1, y1): (f64, f64), (x2, y2): (f64, f64)) -> String {
    format!("<line class=\"{class}\" x1=\"{x1:.1}\" y1=\"{y1:.1}\" x2=\"{x2:.1}\" y2=\"{y2:.1}\"/>\n")
}

fn text(class: &str, anchor: &str, (x, y): (f64, f64), content: &str) -> String {
    let content = escape(content);
    format!("<text class=\"{class}\" text-anchor=\"{anchor}\" x=\"{x:.1}\" y=\"{y:.1}\">{content}</text>\n")
}

fn rectangle(class: &str, (x, y): (f64, f64), (width, height): (f64, f64), title: &str) -> String {
    let title = if title.is_empty() { String::new() } else { format!("<title>{}</title>", escape(title)) };
    format!(
        "<rect class=\"{class}\" x=\"{x:.1}\" y=\"{y:.1}\" width=\"{width:.1}\" height=\"{height:.1}\">{title}</rect>\n"
    )
}

/// The outline of a dot at a place: circle, square, triangle, diamond, cross.
fn mark(shape: usize, (x, y): (f64, f64), r: f64) -> String {
    let path = match shape % SHAPES {
        0 => return format!("<circle cx=\"{x:.1}\" cy=\"{y:.1}\" r=\"{r:.1}\"/>"),
        1 => vec![(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
        2 => vec![(0.0, -1.15), (1.1, 0.8), (-1.1, 0.8)],
        3 => vec![(0.0, -1.25), (1.25, 0.0), (0.0, 1.25), (-1.25, 0.0)],
        _ => {
            let (a, b) = (0.4, 1.15);
            vec![
                (-a, -b),
                (a, -b),
                (a, -a),
                (b, -a),
                (b, a),
                (a, a),
                (a, b),
                (-a, b),
                (-a, a),
                (-b, a),
                (-b, -a),
                (-a, -a),
            ]
        }
    };
    let points: Vec<String> = path.iter().map(|(dx, dy)| format!("{:.1},{:.1}", x + r * dx, y + r * dy)).collect();
    format!("<polygon points=\"{}\"/>", points.join(" "))
}

#[cfg(test)]
mod tests;
