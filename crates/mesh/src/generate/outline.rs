//! The outline of a region in the plane: closed curves, and the places of boundary vertices on them.

use std::collections::HashMap;

use nalgebra::Vector2;

use super::triangulation::{OUTSIDE, Triangulation, edge_opposite};

/// A closed polyline with its arc length. The region lies to its left.
#[derive(Clone, Debug)]
pub struct Curve {
    points: Vec<Vector2<f64>>,
    /// Arc length from the first point to each, and the whole length at the end, m.
    lengths: Vec<f64>,
}

impl Curve {
    pub fn new(points: Vec<Vector2<f64>>) -> Self {
        let mut lengths = vec![0.0];
        for (i, x) in points.iter().enumerate() {
            let next = points[(i + 1) % points.len()];
            lengths.push(lengths[i] + (next - x).norm());
        }
        Self { points, lengths }
    }

    pub fn points(&self) -> &[Vector2<f64>] {
        &self.points
    }

    /// Arc length at each point.
    pub fn lengths(&self) -> &[f64] {
        &self.lengths[..self.points.len()]
    }

    /// Whole length.
    pub fn length(&self) -> f64 {
        self.lengths[self.points.len()]
    }

    /// Signed area, positive for a counter-clockwise curve.
    pub fn area(&self) -> f64 {
        let origin = self.points[0];
        let corner = |i: usize| self.points[i % self.points.len()] - origin;
        (0..self.points.len()).map(|i| 0.5 * corner(i).perp(&corner(i + 1))).sum()
    }

    /// The point at an arc length, which counts on from the start beyond the end.
    pub fn at(&self, s: f64) -> Vector2<f64> {
        let s = if (0.0..self.length()).contains(&s) { s } else { s.rem_euclid(self.length()) };
        let i = self.segment(s);
        let step = self.lengths[i + 1] - self.lengths[i];
        let share = if step > 0.0 { (s - self.lengths[i]) / step } else { 0.0 };
        self.points[i].lerp(&self.points[(i + 1) % self.points.len()], share)
    }

    /// The segment at an arc length within the curve.
    fn segment(&self, s: f64) -> usize {
        self.lengths.partition_point(|&start| start <= s).saturating_sub(1).min(self.points.len() - 1)
    }

    /// Largest distance of the curve's points from the chord between two arc lengths, the first the smaller; the second may lie beyond the end.
    pub fn deviation(&self, from: f64, to: f64) -> f64 {
        self.deviation_from([self.at(from), self.at(to)], [from, to])
    }

    /// The same for a chord whose ends are known.
    pub fn deviation_from(&self, [start, end]: [Vector2<f64>; 2], [from, to]: [f64; 2]) -> f64 {
        let chord = (end - start).try_normalize(0.0).unwrap_or_default();
        let points = self.points.len();
        let (begin, to) = if from < self.length() {
            (self.segment(from), to)
        } else {
            (self.segment(from - self.length()), to - self.length())
        };
        let mut largest: f64 = 0.0;
        let mut visit = |points: &[Vector2<f64>], lengths: &[f64], to: f64| {
            for (x, length) in points.iter().zip(lengths) {
                if !(*length < to) {
                    return false;
                }
                largest = largest.max(chord.perp(&(x - start)).abs());
            }
            true
        };
        let mut rest = to;
        let mut goes_on = visit(&self.points[begin + 1..], &self.lengths[begin + 1..points], rest);
        while goes_on {
            rest -= self.length();
            goes_on = visit(&self.points, &self.lengths[..points], rest);
        }
        largest
    }
}

/// A place on a curve.
#[derive(Clone, Copy, Debug)]
pub struct OnCurve {
    pub curve: usize,
    /// Arc length, m.
    pub s: f64,
    /// The vertex must not be moved.
    pub is_fixed: bool,
}

/// Curves, and the place of each boundary vertex.
#[derive(Clone, Debug, Default)]
pub struct Outline {
    pub curves: Vec<Curve>,
    /// Place of each vertex of the boundary; `None` for inner ones. Vertices beyond the end of the list are inner ones.
    pub places: Vec<Option<OnCurve>>,
    /// Distance that chords may have from the curve, m.
    pub tolerance: f64,
}

impl Outline {
    /// The place of a vertex, if it is on the boundary.
    pub fn place(&self, vertex: u32) -> Option<OnCurve> {
        self.places.get(vertex as usize).copied().flatten()
    }

    /// The middle of the curve between two vertices of the boundary that follow one another.
    pub fn between(&self, from: u32, to: u32) -> Option<(Vector2<f64>, OnCurve)> {
        let (from, to) = (self.place(from)?, self.place(to)?);
        let curve = &self.curves[from.curve];
        let end = if to.s > from.s { to.s } else { to.s + curve.length() };
        let s = (0.5 * (from.s + end)).rem_euclid(curve.length());
        Some((curve.at(s), OnCurve { curve: from.curve, s, is_fixed: false }))
    }

    pub fn set(&mut self, vertex: u32, place: OnCurve) {
        if self.places.len() <= vertex as usize {
            self.places.resize(vertex as usize + 1, None);
        }
        self.places[vertex as usize] = Some(place);
    }

    /// The boundary of a triangulation as its own outline. Vertices on its straight runs may slide, corners are fixed, as are vertices where
    /// more than two edges of the boundary meet and ends of constrained edges.
    pub fn of(triangulation: &Triangulation) -> Self {
        let mut next: HashMap<u32, u32> = HashMap::new();
        let mut is_fixed = vec![false; triangulation.points.len()];
        for (triangle, corners) in triangulation.triangles.iter().enumerate() {
            for i in 0..3 {
                let [from, to] = edge_opposite(*corners, i);
                if triangulation.neighbours[triangle][i] == OUTSIDE {
                    // Where boundaries touch in a vertex, either may go on.
                    is_fixed[from as usize] |= next.insert(from, to).is_some();
                } else if triangulation.constrained[triangle] >> i & 1 == 1 {
                    is_fixed[from as usize] = true;
                }
            }
        }
        let mut outline = Self::default();
        for start in 0..triangulation.points.len() as u32 {
            let mut run = Vec::new();
            let mut at = start;
            while let Some(to) = next.remove(&at) {
                run.push(at);
                at = to;
            }
            if !run.is_empty() {
                outline.add_polygon(triangulation, &run, &is_fixed);
            }
        }
        outline.tolerance = 0.0;
        (0..is_fixed.len()).filter(|&vertex| is_fixed[vertex]).for_each(|vertex| outline.fix(vertex as u32));
        outline
    }

    /// Keeps a vertex where it is.
    pub fn fix(&mut self, vertex: u32) {
        let place = self.place(vertex).unwrap_or(OnCurve { curve: 0, s: 0.0, is_fixed: true });
        self.set(vertex, OnCurve { is_fixed: true, ..place });
    }

    fn add_polygon(&mut self, triangulation: &Triangulation, run: &[u32], is_fixed: &[bool]) {
        let at = |i: usize| triangulation.points[run[i % run.len()] as usize];
        let curve = Curve::new((0..run.len()).map(at).collect());
        for (i, &vertex) in run.iter().enumerate() {
            let (before, after) = (at(i) - at(i + run.len() - 1), at(i + 1) - at(i));
            let is_straight = before.perp(&after).abs() <= STRAIGHT * before.norm() * after.norm();
            let is_fixed = is_fixed[vertex as usize] || !is_straight || before.dot(&after) <= 0.0;
            self.set(vertex, OnCurve { curve: self.curves.len(), s: curve.lengths()[i], is_fixed });
        }
        self.curves.push(curve);
    }
}

/// Sine of the turn up to which a boundary is straight: the rounding of coordinates that are written with 12 digits.
const STRAIGHT: f64 = 1e-9;
