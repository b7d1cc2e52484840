//! Corners of a contour, which the grid of pixels rounds, and steps of pictures that are not antialiased.

use nalgebra::Vector2;

use crate::generate::outline::Curve;

/// Arc lengths over which the direction of a contour is measured, in pixels; shorter ones see the pixels, longer ones miss small corners.
const WINDOWS: [f64; 2] = [3.0, 5.0];
/// Turn of the contour over both windows from which on it has a corner, degrees.
const TURNS: [f64; 2] = [42.0, 38.0];
/// Windows, and least turn over the shorter, for obtuse corners: all of the turn over the longer window lies in the shorter, where an arc has half.
const OBTUSE_WINDOWS: [f64; 2] = [4.0, 8.0];
const OBTUSE_TURN: f64 = 18.0;
const OBTUSE_SHARE: f64 = 0.8;
/// Distance from the contour up to which the intersection of its two sides is taken as the corner, in pixels.
const NEAR: f64 = 0.4;
/// Arc length beside a corner that the pixels round, in pixels.
const ROUNDED: f64 = 1.2;

/// Arc lengths of the corners of a curve: places where `sharpness` is at least 1, and larger than near them.
pub fn corners(curve: &Curve, sharpness: impl Fn(&Curve, f64) -> f64) -> Vec<f64> {
    let turns: Vec<f64> = curve.lengths().iter().map(|&s| sharpness(curve, s)).collect();
    let mut by_turn: Vec<usize> = (0..turns.len()).filter(|&i| turns[i] >= 1.0).collect();
    by_turn.sort_by(|&i, &j| turns[j].total_cmp(&turns[i]));
    let lengths = curve.lengths();
    let mut is_near = vec![false; lengths.len()];
    let mut corners: Vec<f64> = Vec::new();
    for i in by_turn {
        if is_near[i] {
            continue;
        }
        corners.push(lengths[i]);
        let distance = |j: usize| (lengths[j] - lengths[i]).abs().min(curve.length() - (lengths[j] - lengths[i]).abs());
        let ahead = (1..lengths.len()).map(|step| (i + step) % lengths.len());
        ahead.take_while(|&j| distance(j) < WINDOWS[0]).for_each(|j| is_near[j] = true);
        let back = (1..lengths.len()).map(|step| (i + lengths.len() - step) % lengths.len());
        back.take_while(|&j| distance(j) < WINDOWS[0]).for_each(|j| is_near[j] = true);
    }
    corners.sort_by(f64::total_cmp);
    corners
}

/// Arc lengths from the corner before a place and to the one behind it, at most the curve's length. `corners` are ascending.
pub fn nearest(curve: &Curve, corners: &[f64], s: f64) -> [f64; 2] {
    let length = curve.length();
    let next = corners.partition_point(|&corner| corner < s);
    let ahead = corners.get(next).map(|corner| corner - s);
    let ahead = ahead.or(corners.first().map(|corner| corner + length - s)).unwrap_or(length);
    let last = corners.partition_point(|&corner| corner <= s);
    let behind = last.checked_sub(1).map(|last| s - corners[last]);
    let behind = behind.or(corners.last().map(|corner| s + length - corner)).unwrap_or(length);
    [behind, ahead]
}

/// The smaller of the turns over the two windows, relative to what makes a corner.
pub fn acute_corner(curve: &Curve, s: f64) -> f64 {
    (turn(curve, s, WINDOWS[0]) / TURNS[0]).min(turn(curve, s, WINDOWS[1]) / TURNS[1])
}

/// As [`acute_corner`], or for an obtuse corner the turn relative to what makes one.
pub fn any_corner(curve: &Curve, s: f64) -> f64 {
    let [near, far] = OBTUSE_WINDOWS.map(|window| turn(curve, s, window));
    let obtuse = if near >= OBTUSE_SHARE * far { near / OBTUSE_TURN } else { 0.0 };
    acute_corner(curve, s).max(obtuse)
}

/// Turn of a curve at a place, from the chord before it to the one behind, degrees.
fn turn(curve: &Curve, s: f64, window: f64) -> f64 {
    let window = window.min(curve.length() / 8.0);
    let x = curve.at(s);
    let (before, after) = (x - curve.at(s - window), curve.at(s + window) - x);
    before.perp(&after).atan2(before.dot(&after)).abs().to_degrees()
}

/// The curve with its corners sharpened to where their two sides meet, and the arc lengths of the corners on it.
pub fn sharpen(curve: &Curve, corners: &[f64]) -> (Curve, Vec<f64>) {
    if corners.is_empty() {
        return (curve.clone(), Vec::new());
    }
    let length = curve.length();
    let mut points = Vec::new();
    let mut places = Vec::new();
    for (i, &corner) in corners.iter().enumerate() {
        let next = corners.get(i + 1).copied().unwrap_or(corners[0] + length);
        places.push(points.len());
        points.push(sharpened(curve, corner));
        let (from, to) = (corner + ROUNDED, next - ROUNDED);
        let mut kept: Vec<(f64, Vector2<f64>)> = Vec::new();
        for (s, point) in curve.lengths().iter().zip(curve.points()) {
            // The last stretch goes on beyond the start of the curve.
            let s = if *s < corner { s + length } else { *s };
            if from < s && s < to {
                kept.push((s, *point));
            }
        }
        kept.sort_by(|a, b| a.0.total_cmp(&b.0));
        points.extend(kept.into_iter().map(|(_, point)| point));
    }
    let sharp = Curve::new(points);
    let places = places.into_iter().map(|i| sharp.lengths()[i]).collect();
    (sharp, places)
}

/// The intersection of the lines along both sides of a corner, or the point near the contour on the way to it.
fn sharpened(curve: &Curve, corner: f64) -> Vector2<f64> {
    let at = curve.at(corner);
    let (a, b) = (curve.at(corner - 4.0), curve.at(corner - ROUNDED));
    let (c, d) = (curve.at(corner + ROUNDED), curve.at(corner + 4.0));
    let (before, after) = (b - a, c - d);
    let sine = before.perp(&after);
    if !(sine.abs() > 0.2 * before.norm() * after.norm()) {
        return at;
    }
    let meeting = a + before * ((c - a).perp(&after) / sine);
    let way = meeting - at;
    if way.norm() > NEAR { at + way * (NEAR / way.norm()) } else { meeting }
}

/// The curve as an average along its arc with a bell curve of this standard deviation (pixels), moved by no more than `most`: the steps of a
/// picture that is not antialiased vanish. Corners stay.
pub fn smoothed(curve: &Curve, corners: &[f64], deviation: f64, most: f64) -> Curve {
    let length = curve.length();
    let reach = 3.0 * deviation;
    let points = curve.lengths().iter().zip(curve.points()).map(|(&s, &point)| {
        let [behind, ahead] = nearest(curve, corners, s);
        // The window shrinks to a corner, so that it averages over one side alone.
        let reach = reach.min(ahead).min(behind).min(length / 8.0);
        let steps = (2.0 * reach).ceil() as i32;
        let (mut sum, mut weights) = (Vector2::zeros(), 0.0);
        for step in -steps..=steps {
            let distance = reach * f64::from(step) / f64::from(steps.max(1));
            let weight = (-0.5 * (distance / deviation).powi(2)).exp();
            sum += weight * curve.at(s + distance);
            weights += weight;
        }
        let way = sum / weights - point;
        if way.norm() > most { point + way * (most / way.norm()) } else { point + way }
    });
    Curve::new(points.collect())
}
