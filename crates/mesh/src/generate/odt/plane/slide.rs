//! Moves of vertices of the boundary along its curves.

use nalgebra::Vector2;

use super::{STILL, Smoothing};
use crate::generate::outline::{Curve, OnCurve};

impl<S: Fn(u32, Vector2<f64>) -> f64> Smoothing<'_, S> {
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
