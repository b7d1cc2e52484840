//! Sizes that the contour asks for: by its curvature and by the width of the region.

use nalgebra::Vector2;

use super::Picture;
use super::corners::nearest;
use crate::generate::outline::Curve;

/// Edges across the thinnest place: their length over its width.
const ACROSS: f64 = 1.2;

/// Longest edge around each point of a curve whose chord stays within `tolerance` of the curve and does not pass a corner, between `shortest` and
/// `longest`.
pub fn chord_lengths(curve: &Curve, corners: &[f64], tolerance: f64, [shortest, longest]: [f64; 2]) -> Vec<f64> {
    let mut sizes = Vec::with_capacity(curve.points().len());
    let mut last: f64 = longest;
    for &s in curve.lengths() {
        let [behind, ahead] = nearest(curve, corners, s).map(|distance| distance.min(curve.length() / 3.0));
        let fits = |length: f64| {
            let (from, to) = (s - behind.min(0.5 * length), s + ahead.min(0.5 * length));
            let turn = if from < 0.0 { curve.length() } else { 0.0 };
            curve.deviation(from + turn, to + turn) <= tolerance
        };
        // The length at the point before is a good guess.
        let mut length = (1.3 * last).clamp(shortest, longest);
        while length > shortest && !fits(length) {
            length = (0.87 * length).max(shortest);
        }
        last = length;
        sizes.push(length);
    }
    sizes
}

/// Bounds sizes at a point of the contour by the width of the region there, as the ray along its inward normal meets the opposite side.
pub fn width_bound(picture: &Picture, x: Vector2<f64>, inward: Vector2<f64>, longest: f64) -> Option<f64> {
    let steps = (2.0 * longest / ACROSS) as usize;
    for step in 3..steps {
        let distance = 0.5 * step as f64;
        let at = x + inward * distance;
        if !picture.is_inside(at.x.floor() as isize, at.y.floor() as isize) {
            let opposite = outward(picture, at);
            // Sides that are not nearly parallel belong to a corner.
            return (opposite.dot(&inward) > 0.75).then_some(ACROSS * distance);
        }
    }
    None
}

/// Direction in which the coverage falls, by differences over five pixels.
fn outward(picture: &Picture, x: Vector2<f64>) -> Vector2<f64> {
    let (i, j) = (x.x.floor() as isize, x.y.floor() as isize);
    let mut sum = Vector2::zeros();
    for dy in -2..=2_isize {
        for dx in -2..=2_isize {
            sum -= f64::from(picture.at(i + dx, j + dy)) * Vector2::new(dx as f64, dy as f64);
        }
    }
    sum.try_normalize(0.0).unwrap_or_default()
}
