//! Points and lines on two axes.

use maud::{Markup, html};

use crate::axis::Placed;
use crate::svg::{Px, line, mark, points, text, title, window};
use crate::{Axis, COLOURS, Picture};

/// A point.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Dot {
    /// Abscissa.
    pub x: f64,
    /// Ordinate.
    pub y: f64,
    /// Shown under the pointer.
    pub title: String,
    /// Least and largest x, drawn as an error bar.
    pub spread: Option<(f64, f64)>,
    /// A ring marks the dot.
    pub is_best: bool,
}

impl Dot {
    /// A point with the text that it shows under the pointer.
    pub fn new(x: f64, y: f64, title: impl Into<String>) -> Self {
        Self { x, y, title: title.into(), ..Self::default() }
    }
}

impl From<(f64, f64)> for Dot {
    fn from((x, y): (f64, f64)) -> Self {
        Self { x, y, ..Self::default() }
    }
}

/// Points of one kind.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// Entry of the legend; an empty name has none.
    pub name: String,
    /// Number of the colour, from 0 to [`COLOURS`] − 1.
    pub colour: usize,
    /// Number of the shape, from 0 to [`SHAPES`](crate::SHAPES) − 1.
    pub shape: usize,
    /// A line joins the points.
    pub is_joined: bool,
    /// The points are drawn. A smooth curve is a line alone.
    pub has_dots: bool,
    /// The points are outlines.
    pub is_hollow: bool,
    /// Points in the order of the line.
    pub dots: Vec<Dot>,
}

impl Series {
    /// A smooth curve: a line without points.
    pub fn line(name: impl Into<String>, colour: usize, dots: impl IntoIterator<Item = impl Into<Dot>>) -> Self {
        let dots = dots.into_iter().map(Into::into).collect();
        Self { name: name.into(), colour, is_joined: true, dots, ..Self::default() }
    }

    /// Points of a shape, joined by a line.
    pub fn joined(
        name: impl Into<String>,
        (colour, shape): (usize, usize),
        dots: impl IntoIterator<Item = impl Into<Dot>>,
    ) -> Self {
        Self { shape, has_dots: true, ..Self::line(name, colour, dots) }
    }
}

/// A line to compare the series with.
#[derive(Clone, Debug, PartialEq)]
pub enum Guide {
    /// A vertical line at an x, with its name.
    Vertical(f64, String),
    /// A horizontal line at a y, with its name.
    Horizontal(f64, String),
    /// A short line through a point, y ∝ x^slope on logarithmic axes.
    Slope {
        /// The point.
        through: (f64, f64),
        /// Decades of y for each decade of x.
        slope: f64,
        /// Written beside the line.
        name: String,
    },
}

/// Series and guides on two axes.
#[derive(Clone, Debug, PartialEq)]
pub struct Chart {
    /// A description for readers who cannot see the chart.
    pub label: String,
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Series, from back to front.
    pub series: Vec<Series>,
    /// Guides, behind the series.
    pub guides: Vec<Guide>,
    /// Width and height, pixels.
    pub size: (f64, f64),
}

/// Margins for the numbers and names of the axes, pixels: left, right, top, bottom.
const MARGINS: (f64, f64, f64, f64) = (62.0, 14.0, 26.0, 46.0);

impl Chart {
    /// An empty chart of the usual size.
    pub fn new(label: impl Into<String>, x: Axis, y: Axis) -> Self {
        Self { label: label.into(), x, y, series: Vec::new(), guides: Vec::new(), size: (600.0, 420.0) }
    }

    /// Draws the chart.
    pub fn draw(&self) -> Picture {
        let (left, right, top, bottom) = self.edges();
        let dots = || self.series.iter().flat_map(|series| &series.dots).filter(|dot| self.shows(dot));
        let spreads = dots().flat_map(|dot| dot.spread.into_iter().flat_map(|(a, b)| [a, b]));
        let x = self.x.between(left, right, dots().map(|dot| dot.x).chain(spreads));
        let y = self.y.between(bottom, top, dots().map(|dot| dot.y));
        let lines = html! {
            @for guide in &self.guides { (self.guide(guide, x, y)) }
            @for series in &self.series { (self.curve(series, x, y)) }
        };
        let inner = html! {
            (self.frame(x, y))
            (window((left, top), (right - left, bottom - top), lines))
            @for series in &self.series { (self.dots(series, x, y)) }
        };
        let named = self.series.iter().filter(|series| !series.name.is_empty());
        let legend = named.map(|series| (series.name.clone(), sample(series))).collect();
        Picture { size: self.size, label: self.label.clone(), inner, legend }
    }

    /// Edges of the area between the axes, pixels: left, right, top, bottom.
    fn edges(&self) -> (f64, f64, f64, f64) {
        let (width, height) = self.size;
        (MARGINS.0, width - MARGINS.1, MARGINS.2, height - MARGINS.3)
    }

    fn shows(&self, dot: &Dot) -> bool {
        self.x.shows(dot.x) && self.y.shows(dot.y)
    }

    /// Grid, numbers and names.
    fn frame(&self, x: Placed, y: Placed) -> Markup {
        let (left, right, top, bottom) = self.edges();
        html! {
            @for (value, name) in x.ticks() {
                @let at = x.at(value);
                (line("grid", (at, top), (at, bottom)))
                (text("", "middle", (at, bottom + 17.0), &name))
            }
            @for (value, name) in y.ticks() {
                @let at = y.at(value);
                (line("grid", (left, at), (right, at)))
                (text("", "end", (left - 7.0, at + 4.0), &name))
            }
            (line("axis", (left, bottom), (right, bottom)))
            (text("name", "end", (right, bottom + 36.0), &self.x.name))
            (text("name", "start", (8.0, top - 10.0), &self.y.name))
        }
    }

    fn guide(&self, guide: &Guide, x: Placed, y: Placed) -> Markup {
        let ((x0, x1), (y0, y1)) = (x.ends(), y.ends());
        match guide {
            Guide::Vertical(at, name) if self.x.shows(*at) => {
                let at = x.at(*at);
                html! {
                    (line("guide", (at, y.at(y0)), (at, y.at(y1))))
                    g transform={ "translate(" (Px(at + 4.0)) " " (Px(y.at(y1) + 6.0)) ") rotate(90)" } {
                        (text("note", "start", (0.0, 0.0), name))
                    }
                }
            }
            Guide::Horizontal(at, name) if self.y.shows(*at) => {
                let at = y.at(*at);
                html! {
                    (line("guide", (x.at(x0), at), (x.at(x1), at)))
                    (text("note", "end", (x.at(x1) - 6.0, at - 5.0), name))
                }
            }
            Guide::Slope { through: (px, py), slope, name } if self.x.shows(*px) && self.y.shows(*py) => {
                let at = |x: f64| py * (x / px).powf(*slope);
                // A quarter of a decade to each side is enough to compare with.
                let (a, b) = (px / 10f64.powf(0.25), px * 10f64.powf(0.25));
                let (from, to) = ((x.at(a), y.at(at(a))), (x.at(b), y.at(at(b))));
                html! { (line("slope", from, to)) (text("note", "end", (from.0 - 4.0, from.1 + 4.0), name)) }
            }
            _ => html! {},
        }
    }

    fn curve(&self, series: &Series, x: Placed, y: Placed) -> Markup {
        let colour = series.colour % COLOURS;
        let shown = || series.dots.iter().filter(|dot| self.shows(dot));
        let spread = |dot: &Dot| dot.spread.filter(|(a, b)| self.x.shows(*a) && self.x.shows(*b));
        html! {
            @if series.is_joined {
                polyline class={ "curve k" (colour) } points=(points(shown().map(|dot| (x.at(dot.x), y.at(dot.y))))) {} "\n"
            }
            @for dot in shown() {
                @if let Some((a, b)) = spread(dot) {
                    (line(&format!("spread k{colour}"), (x.at(a), y.at(dot.y)), (x.at(b), y.at(dot.y))))
                }
            }
        }
    }

    fn dots(&self, series: &Series, x: Placed, y: Placed) -> Markup {
        let ((x0, x1), (y0, y1)) = (x.ends(), y.ends());
        let is_inside = |dot: &&Dot| self.shows(dot) && (x0..=x1).contains(&dot.x) && (y0..=y1).contains(&dot.y);
        html! {
            @for dot in series.dots.iter().filter(|_| series.has_dots).filter(is_inside) {
                @let at = (x.at(dot.x), y.at(dot.y));
                g class=(class(series)) {
                    @if dot.is_best { circle class="halo" cx=(Px(at.0)) cy=(Px(at.1)) r="8.5" {} }
                    (mark(series.shape, at, 4.2)) (title(&dot.title))
                } "\n"
            }
        }
    }
}

/// Classes of the dots of a series.
fn class(series: &Series) -> String {
    format!("dot{} k{}", if series.is_hollow { " hollow" } else { "" }, series.colour % COLOURS)
}

/// The mark of a series in the legend.
fn sample(series: &Series) -> Markup {
    html! {
        @if series.is_joined { polyline class={ "curve k" (series.colour % COLOURS) } points="-8,0 8,0" {} }
        @if series.has_dots { g class=(class(series)) { (mark(series.shape, (0.0, 0.0), 4.2)) } }
    }
}
