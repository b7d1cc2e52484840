//! Points along a contour, at distances that a size field gives.

use nalgebra::Vector2;

use crate::generate::outline::{Curve, OnCurve};

/// Points on a curve between its corners, which are points as well, so that every edge has about the length that `size` gives. At least three.
pub fn resample(
    curve: &Curve,
    index: usize,
    corners: &[f64],
    size: impl Fn(Vector2<f64>) -> f64,
) -> Vec<(Vector2<f64>, OnCurve)> {
    let counts = edge_counts(curve, size);
    let whole = counts[counts.len() - 1];
    let ends = if corners.is_empty() { &[0.0][..] } else { corners };
    let fewest = match ends.len() {
        1 => 3,
        2 => 2,
        _ => 1,
    };
    let mut places = Vec::new();
    for (i, &from) in ends.iter().enumerate() {
        let start = count_at(curve, &counts, from);
        let end = ends.get(i + 1).map_or(whole + count_at(curve, &counts, ends[0]), |&to| count_at(curve, &counts, to));
        let edges = ((end - start).round() as usize).max(fewest);
        for edge in 0..edges {
            let s = if edge == 0 {
                from
            } else {
                length_at(curve, &counts, start + (end - start) * edge as f64 / edges as f64)
            };
            let is_fixed = edge == 0 && !corners.is_empty();
            places.push((curve.at(s), OnCurve { curve: index, s: s.rem_euclid(curve.length()), is_fixed }));
        }
    }
    places
}

/// Number of edges from the start of the curve to each of its points and to its end: the integral of the arc length over the size.
fn edge_counts(curve: &Curve, size: impl Fn(Vector2<f64>) -> f64) -> Vec<f64> {
    let points = curve.points();
    let inverse: Vec<f64> = points.iter().map(|&x| 1.0 / size(x)).collect();
    let mut counts = vec![0.0];
    for i in 0..points.len() {
        let next = (i + 1) % points.len();
        let step = (points[next] - points[i]).norm();
        counts.push(counts[i] + 0.5 * step * (inverse[i] + inverse[next]));
    }
    counts
}

/// Number of edges from the start to an arc length.
fn count_at(curve: &Curve, counts: &[f64], s: f64) -> f64 {
    between(curve.lengths(), curve.length(), counts, s)
}

/// Arc length at a number of edges from the start, which may count on beyond the end.
fn length_at(curve: &Curve, counts: &[f64], count: f64) -> f64 {
    let whole = counts[counts.len() - 1];
    let turn = (count / whole).floor();
    let rest = count - turn * whole;
    let i = counts.partition_point(|&start| start <= rest).saturating_sub(1).min(counts.len() - 2);
    let end = curve.lengths().get(i + 1).copied().unwrap_or(curve.length());
    let share = (rest - counts[i]) / (counts[i + 1] - counts[i]);
    turn * curve.length() + curve.lengths()[i] + share * (end - curve.lengths()[i])
}

/// Linear interpolation of values at increasing lengths, the last of which is `length`.
fn between(lengths: &[f64], length: f64, values: &[f64], s: f64) -> f64 {
    let i = lengths.partition_point(|&start| start <= s).saturating_sub(1);
    let end = lengths.get(i + 1).copied().unwrap_or(length);
    let share = if end > lengths[i] { (s - lengths[i]) / (end - lengths[i]) } else { 0.0 };
    values[i] + share * (values[i + 1] - values[i])
}
