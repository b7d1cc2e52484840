//! Moves that raise the worst triangles, and moves of vertices of the boundary along its curves.

use nalgebra::Vector2;

use super::{STILL, Smoothing};
use crate::generate::outline::{Curve, OnCurve};

/// Squared circumradius over shortest edge above which a triangle is polished.
const POLISHED: f64 = 0.5;
/// Share of the energy that an iteration gains, up to which polishing may spend it.
const SPENT: f64 = 0.5;

/// Directions of the moves that are tried: multiples of 60°.
const DIRECTIONS: [Vector2<f64>; 6] = [
    Vector2::new(1.0, 0.0),
    Vector2::new(0.5, SINE),
    Vector2::new(-0.5, SINE),
    Vector2::new(-1.0, 0.0),
    Vector2::new(-0.5, -SINE),
    Vector2::new(0.5, -SINE),
];
const SINE: f64 = 0.866_025_403_784_438_6;

impl<S: Fn(u32, Vector2<f64>) -> f64> Smoothing<'_, S> {
    /// Moves inner vertices of the worst triangles to where the worst triangle around each is better, for part of the energy that this iteration
    /// has gained.
    pub fn polish(&mut self, iteration: usize) {
        let mut budget = SPENT * self.gained;
        let reach = 0.16 * 0.8_f64.powi(iteration as i32 % 8);
        for triangle in 0..self.shares.len() {
            for corner in 0..3 {
                if self.shares[triangle][1] <= POLISHED {
                    break;
                }
                let vertex = self.mesh.triangles[triangle][corner];
                if self.outline.place(vertex).is_none() {
                    let mut star = std::mem::take(&mut self.star);
                    if self.mesh.star(vertex, &mut star) {
                        budget -= self.polish_vertex(vertex, &star, reach, budget).unwrap_or(0.0);
                    }
                    self.star = star;
                }
            }
        }
    }

    /// Returns the energy that the best of six moves costs, if it improves the worst triangle and costs no more than the budget.
    fn polish_vertex(&mut self, vertex: u32, star: &[(u32, usize)], reach: f64, budget: f64) -> Option<f64> {
        let (from, size) = (self.mesh.points[vertex as usize], self.sizes[vertex as usize]);
        let (old, shape) = self.energy_around(star);
        let (mut best, mut least) = (None, 0.98 * shape);
        for direction in DIRECTIONS {
            let point = from + reach * size * direction;
            if let Some((energy, worst)) = self.energy_at(star, point, size, least)
                && worst < least
                && energy - old <= budget
            {
                least = worst;
                best = Some(point);
            }
        }
        let point = best?;
        // The density at the new place counts.
        let size = (self.size)(vertex, point);
        let cost = self.energy_at(star, point, size, f64::INFINITY)?.0 - old;
        if cost > budget {
            return None;
        }
        self.move_to(vertex, star, point, size);
        Some(cost)
    }

    /// Moves a vertex of the boundary along its curve, by the move towards the circumcentres' average as far as it goes along the curve.
    pub fn slide(&mut self, vertex: u32, place: OnCurve, star: &[(u32, usize)]) -> bool {
        let (first, last) = (star[0], star[star.len() - 1]);
        let after = self.mesh.triangles[first.0 as usize][(first.1 + 1) % 3];
        let before = self.mesh.triangles[last.0 as usize][(last.1 + 2) % 3];
        let (Some(at_before), Some(at_after)) = (self.outline.place(before), self.outline.place(after)) else {
            return false;
        };
        let curves = std::mem::take(&mut self.outline.curves);
        let near = [(before, at_before), (after, at_after)];
        let has_moved = self.slide_on(&curves[place.curve], vertex, place, near, star);
        self.outline.curves = curves;
        has_moved
    }

    /// Slides a vertex on its curve, between its two neighbours there.
    fn slide_on(
        &mut self,
        curve: &Curve,
        vertex: u32,
        place: OnCurve,
        [before, after]: [(u32, OnCurve); 2],
        star: &[(u32, usize)],
    ) -> bool {
        let ahead = |s: f64| if s < place.s { s - place.s + curve.length() } else { s - place.s };
        let (to_after, to_before) = (ahead(after.1.s), curve.length() - ahead(before.1.s));
        let [from, start, end] = [vertex, before.0, after.0].map(|vertex| self.mesh.points[vertex as usize]);
        let Some(along) = (end - start).try_normalize(0.0) else { return false };
        let wanted = (self.average_of_circumcentres(vertex, star) - from).dot(&along);
        let wanted = wanted.clamp(-0.5 * to_before, 0.5 * to_after);
        if !(wanted.abs() > STILL * self.sizes[vertex as usize]) {
            return false;
        }
        // Arc lengths from before the start of the curve count from the turn before.
        let turn = if place.s < to_before { curve.length() } else { 0.0 };
        let s = place.s + turn;
        let (first, last) = (s - to_before, s + to_after);
        let deviation = |s: f64, x: Vector2<f64>| {
            curve.deviation_from([start, x], [first, s]).max(curve.deviation_from([x, end], [s, last]))
        };
        let tolerance = self.outline.tolerance;
        let nth = |share: f64| {
            let moved = s + wanted * share;
            let point = curve.at(moved);
            let largest = deviation(moved, point);
            let is_allowed = largest <= tolerance || largest <= deviation(s, from);
            is_allowed.then(|| (point, Some(OnCurve { s: moved.rem_euclid(curve.length()), ..place })))
        };
        self.try_moves(vertex, star, nth, wanted.abs())
    }
}
