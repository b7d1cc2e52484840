//! A region of the plane.

use maud::html;

use crate::Picture;
use crate::svg::points;

/// Width of the drawing, pixels.
const SIZE: f64 = 696.0;

/// Space around the region, pixels.
const MARGIN: f64 = 4.0;

/// The region inside closed lines, filled: the points that they enclose an odd number of times. y points up.
pub fn region(label: &str, lines: &[Vec<[f64; 2]>]) -> Picture {
    let range = |axis: usize| {
        let values = lines.iter().flatten().map(|x| x[axis]).filter(|x| x.is_finite());
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(a, b), x| (a.min(x), b.max(x)))
    };
    let ((left, right), (low, high)) = (range(0), range(1));
    let size = (right - left).max(high - low);
    let scale = if size > 0.0 && size.is_finite() { (SIZE - 2.0 * MARGIN) / size } else { 0.0 };
    let place = |x: &[f64; 2]| (0.5 * SIZE + scale * (x[0] - 0.5 * (left + right)), MARGIN + scale * (high - x[1]));
    let finite = |line: &Vec<[f64; 2]>| points(line.iter().filter(|x| x.iter().all(|x| x.is_finite())).map(place));
    let path: String = lines.iter().filter(|line| !line.is_empty()).map(|line| format!("M{}Z", finite(line))).collect();
    let inner = html! { path class="share k8" fill-rule="evenodd" d=(path) {} "\n" };
    let height = if scale > 0.0 { (high - low) * scale } else { 0.0 } + 2.0 * MARGIN;
    Picture { size: (SIZE, height), label: label.to_owned(), inner, legend: Vec::new() }
}
