//! Elements of a drawing. Text is escaped; coordinates are pixels, written to a tenth.

use std::fmt::Write;

use maud::{Markup, Render, html};

use crate::SHAPES;

/// A length or a coordinate, pixels.
pub(crate) struct Px(pub f64);

impl Render for Px {
    fn render_to(&self, buffer: &mut String) {
        // Writing to a String never fails.
        let _ = write!(buffer, "{:.1}", self.0);
    }
}

/// The attribute `points` of a polygon or polyline.
pub(crate) fn points(places: impl IntoIterator<Item = (f64, f64)>) -> String {
    let places: Vec<String> = places.into_iter().map(|(x, y)| format!("{x:.1},{y:.1}")).collect();
    places.join(" ")
}

pub(crate) fn line(class: &str, (x1, y1): (f64, f64), (x2, y2): (f64, f64)) -> Markup {
    html! { line class=(class) x1=(Px(x1)) y1=(Px(y1)) x2=(Px(x2)) y2=(Px(y2)) {} "\n" }
}

pub(crate) fn text(class: &str, anchor: &str, (x, y): (f64, f64), content: &str) -> Markup {
    html! { text class=(class) text-anchor=(anchor) x=(Px(x)) y=(Px(y)) { (content) } "\n" }
}

pub(crate) fn rectangle(class: &str, (x, y): (f64, f64), (width, height): (f64, f64), tip: &str) -> Markup {
    html! { rect class=(class) x=(Px(x)) y=(Px(y)) width=(Px(width)) height=(Px(height)) { (title(tip)) } "\n" }
}

/// The text that a browser shows under the pointer; an empty text has no element.
pub(crate) fn title(tip: &str) -> Markup {
    html! { @if !tip.is_empty() { title { (tip) } } }
}

/// A nested drawing that clips its contents to a rectangle.
pub(crate) fn window((x, y): (f64, f64), (width, height): (f64, f64), contents: Markup) -> Markup {
    html! {
        svg x=(x) y=(y) width=(width) height=(height) viewBox={ (x) " " (y) " " (width) " " (height) } { (contents) } "\n"
    }
}

/// The outline of a dot: circle, square, triangle, diamond, cross.
pub(crate) fn mark(shape: usize, (x, y): (f64, f64), r: f64) -> Markup {
    let (a, b) = (0.4, 1.15);
    let path: &[(f64, f64)] = match shape % SHAPES {
        0 => return html! { circle cx=(Px(x)) cy=(Px(y)) r=(Px(r)) {} },
        1 => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
        2 => &[(0.0, -b), (1.1, 0.8), (-1.1, 0.8)],
        3 => &[(0.0, -1.25), (1.25, 0.0), (0.0, 1.25), (-1.25, 0.0)],
        _ => {
            let corner = [(-a, -b), (a, -b), (a, -a), (b, -a), (b, a), (a, a), (a, b), (-a, b), (-a, a), (-b, a)];
            let last = [(-b, -a), (-a, -a)];
            let places = corner.into_iter().chain(last).map(|(dx, dy)| (x + r * dx, y + r * dy));
            return html! { polygon points=(points(places)) {} };
        }
    };
    html! { polygon points=(points(path.iter().map(|(dx, dy)| (x + r * dx, y + r * dy)))) {} }
}
