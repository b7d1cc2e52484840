//! Points and lines on two axes.

use super::axis::Placed;
use super::{Axis, COLOURS, Picture, escape, line, mark, text};

/// A point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dot {
    /// Value along.
    pub x: f64,
    /// Value up.
    pub y: f64,
    /// Shown when a pointer rests on it.
    pub title: String,
    /// Least and largest x of it, where it has a spread.
    pub spread: Option<(f64, f64)>,
    /// Whether it stands out.
    pub is_best: bool,
}

/// Points that belong together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// For the legend; empty for none.
    pub name: String,
    /// Number of its colour; see [`COLOURS`].
    pub colour: usize,
    /// Number of its shape; see [`SHAPES`](super::SHAPES).
    pub shape: usize,
    /// Whether a line joins its points, in their order.
    pub is_joined: bool,
    /// Whether its points are drawn; a smooth curve is a line alone.
    pub has_dots: bool,
    /// In the order of the line.
    pub dots: Vec<Dot>,
}

/// A line that measures the others.
#[derive(Clone, Debug, PartialEq)]
pub enum Guide {
    /// At this x.
    Vertical(f64, String),
    /// At this y.
    Horizontal(f64, String),
    /// Through a point, y ∝ x^slope where both axes are logarithmic.
    Slope {
        /// The point.
        through: (f64, f64),
        /// Decades up for each decade along.
        slope: f64,
        /// Written beside it.
        name: String,
    },
}

/// Two axes and what is between them.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// What it shows, for those who cannot see it.
    pub label: String,
    /// Along.
    pub x: Axis,
    /// Up.
    pub y: Axis,
    /// From back to front.
    pub series: Vec<Series>,
    /// Behind the series.
    pub guides: Vec<Guide>,
    /// Pixels.
    pub size: (f64, f64),
}

/// Room for the numbers and names of the axes: left, right, top, bottom.
const MARGINS: (f64, f64, f64, f64) = (62.0, 14.0, 26.0, 46.0);

impl Chart {
    /// An empty chart of the usual size.
    pub fn new(label: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self { label: label.into(), x, y, series: Vec::new(), guides: Vec::new(), size: (600.0, 420.0) }
    }

    /// The picture.
    pub fn draw(&self) -> Picture {
        let (width, height) = self.size;
        let (left, right, top, bottom) = (MARGINS.0, width - MARGINS.1, MARGINS.2, height - MARGINS.3);
        let dots = || self.series.iter().flat_map(|series| &series.dots).filter(|dot| self.shows(dot));
        let spreads = dots().flat_map(|dot| dot.spread.into_iter().flat_map(|(a, b)| [a, b]));
        let x = self.x.between(left, right, dots().map(|dot| dot.x).chain(spreads));
        let y = self.y.between(bottom, top, dots().map(|dot| dot.y));
        let mut inner = self.frame(x, y);
        // A window of its own cuts off what leads beyond the axes.
        let (w, h) = (right - left, bottom - top);
        inner.push_str(&format!(
            "<svg x=\"{left}\" y=\"{top}\" width=\"{w}\" height=\"{h}\" viewBox=\"{left} {top} {w} {h}\">\n"
        ));
        inner.extend(self.guides.iter().map(|guide| self.guide(guide, x, y)));
        inner.extend(self.series.iter().map(|series| self.curve(series, x, y)));
        inner.push_str("</svg>\n");
        inner.extend(self.series.iter().map(|series| self.dots(series, x, y)));
        let named = self.series.iter().filter(|series| !series.name.is_empty());
        let legend = named.map(|series| (series.name.clone(), sample(series))).collect();
        Picture { size: self.size, label: self.label.clone(), inner, legend }
    }

    fn shows(&self, dot: &Dot) -> bool {
        self.x.shows(dot.x) && self.y.shows(dot.y)
    }

    /// Grid, numbers and names.
    fn frame(&self, x: Placed, y: Placed) -> String {
        let (width, height) = self.size;
        let (left, right, top, bottom) = (MARGINS.0, width - MARGINS.1, MARGINS.2, height - MARGINS.3);
        let mut inner = String::new();
        for (value, name) in x.ticks() {
            let at = x.at(value);
            inner.push_str(&line("grid", (at, top), (at, bottom)));
            inner.push_str(&text("", "middle", (at, bottom + 17.0), &name));
        }
        for (value, name) in y.ticks() {
            let at = y.at(value);
            inner.push_str(&line("grid", (left, at), (right, at)));
            inner.push_str(&text("", "end", (left - 7.0, at + 4.0), &name));
        }
        inner.push_str(&line("axis", (left, bottom), (right, bottom)));
        inner.push_str(&text("name", "end", (right, bottom + 36.0), &self.x.name));
        inner.push_str(&text("name", "start", (8.0, top - 10.0), &self.y.name));
        inner
    }

    fn guide(&self, guide: &Guide, x: Placed, y: Placed) -> String {
        let ((x0, x1), (y0, y1)) = (x.ends(), y.ends());
        match guide {
            Guide::Vertical(at, name) if self.x.shows(*at) => {
                let at = x.at(*at);
                let label = format!("<g transform=\"translate({:.1} {:.1}) rotate(90)\">", at + 4.0, y.at(y1) + 6.0);
                line("guide", (at, y.at(y0)), (at, y.at(y1)))
                    + &label
                    + &text("note", "start", (0.0, 0.0), name)
                    + "</g>\n"
            }
            Guide::Horizontal(at, name) if self.y.shows(*at) => {
                let at = y.at(*at);
                line("guide", (x.at(x0), at), (x.at(x1), at)) + &text("note", "end", (x.at(x1) - 6.0, at - 5.0), name)
            }
            Guide::Slope { through: (px, py), slope, name } if self.x.shows(*px) && self.y.shows(*py) => {
                let at = |x: f64| py * (x / px).powf(*slope);
                // A quarter of a decade each way is enough to compare with.
                let (a, b) = (px / 10f64.powf(0.25), px * 10f64.powf(0.25));
                let (from, to) = ((x.at(a), y.at(at(a))), (x.at(b), y.at(at(b))));
                line("slope", from, to) + &text("note", "end", (from.0 - 4.0, from.1 + 4.0), name)
            }
            _ => String::new(),
        }
    }

    fn curve(&self, series: &Series, x: Placed, y: Placed) -> String {
        let colour = series.colour % COLOURS;
        let shown = || series.dots.iter().filter(|dot| self.shows(dot));
        let mut inner = String::new();
        if series.is_joined {
            let points: Vec<String> = shown().map(|dot| format!("{:.1},{:.1}", x.at(dot.x), y.at(dot.y))).collect();
            inner.push_str(&format!("<polyline class=\"curve k{colour}\" points=\"{}\"/>\n", points.join(" ")));
        }
        for dot in shown() {
            if let Some((a, b)) = dot.spread.filter(|(a, b)| self.x.shows(*a) && self.x.shows(*b)) {
                let at = y.at(dot.y);
                inner.push_str(&line(&format!("spread k{colour}"), (x.at(a), at), (x.at(b), at)));
            }
        }
        inner
    }

    fn dots(&self, series: &Series, x: Placed, y: Placed) -> String {
        if !series.has_dots {
            return String::new();
        }
        let colour = series.colour % COLOURS;
        let draw = |dot: &Dot| {
            let at = (x.at(dot.x), y.at(dot.y));
            let halo = if dot.is_best {
                format!("<circle class=\"halo\" cx=\"{:.1}\" cy=\"{:.1}\" r=\"8.5\"/>", at.0, at.1)
            } else {
                String::new()
            };
            let title =
                if dot.title.is_empty() { String::new() } else { format!("<title>{}</title>", escape(&dot.title)) };
            format!("<g class=\"dot k{colour}\">{halo}{}{title}</g>\n", mark(series.shape, at, 4.2))
        };
        let inside = |dot: &&Dot| {
            let ((x0, x1), (y0, y1)) = (x.ends(), y.ends());
            self.shows(dot) && (x0..=x1).contains(&dot.x) && (y0..=y1).contains(&dot.y)
        };
        series.dots.iter().filter(inside).map(draw).collect()
    }
}

/// What stands for a series in the legend.
fn sample(series: &Series) -> String {
    let colour = series.colour % COLOURS;
    let curve = if series.is_joined {
        format!("<polyline class=\"curve k{colour}\" points=\"-8,0 8,0\"/>")
    } else {
        String::new()
    };
    let dot = if series.has_dots {
        format!("<g class=\"dot k{colour}\">{}</g>", mark(series.shape, (0.0, 0.0), 4.2))
    } else {
        String::new()
    };
    curve + &dot
}
