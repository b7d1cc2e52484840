//! Moves that raise the worst triangles.

use std::f64::consts::FRAC_PI_3;

use nalgebra::Vector2;

use super::{Smoothing, energy_and_shape};

/// Squared circumradius over shortest edge above which a triangle is polished.
const POLISHED: f64 = 0.5;
/// Share of the energy that an iteration gains, up to which polishing may spend it.
const SPENT: f64 = 0.5;

impl<S: Fn(u32, Vector2<f64>) -> f64> Smoothing<'_, S> {
    /// Moves inner vertices of the worst triangles to where the worst triangle around each is better, for part of the energy that this iteration
    /// has gained.
    pub fn polish(&mut self, iteration: usize) {
        let mut budget = SPENT * self.gained;
        let reach = 0.16 * 0.8_f64.powi(iteration as i32 % 8);
        for triangle in 0..self.mesh.triangles.len() as u32 {
            for corner in 0..3 {
                if energy_and_shape(self.mesh.corners(triangle)).1 <= POLISHED {
                    break;
                }
                budget -=
                    self.polish_vertex(self.mesh.triangles[triangle as usize][corner], reach, budget).unwrap_or(0.0);
            }
        }
    }

    /// Returns the energy that the best of six moves costs, if it improves the worst triangle and costs no more than the budget.
    fn polish_vertex(&mut self, vertex: u32, reach: f64, budget: f64) -> Option<f64> {
        if self.outline.place(vertex).is_some() {
            return None;
        }
        let mut star = std::mem::take(&mut self.star);
        let is_closed = self.mesh.star(vertex, &mut star);
        let (from, size) = (self.mesh.points[vertex as usize], self.sizes[vertex as usize]);
        let mut best = None;
        if is_closed && let Some((old, shape)) = self.energy_at(&star, from, size) {
            let mut least = 0.98 * shape;
            for sixth in 0..6 {
                let (sine, cosine) = (f64::from(sixth) * FRAC_PI_3).sin_cos();
                let point = from + reach * size * Vector2::new(cosine, sine);
                if let Some((energy, worst)) = self.energy_at(&star, point, size)
                    && worst < least
                    && energy - old <= budget
                {
                    least = worst;
                    best = Some(point);
                }
            }
        }
        self.star = star;
        let point = best?;
        // The density at the new place counts.
        let size = (self.size)(vertex, point);
        let star = std::mem::take(&mut self.star);
        let (old, new) = (self.energy_at(&star, from, self.sizes[vertex as usize]), self.energy_at(&star, point, size));
        self.star = star;
        let cost = new?.0 - old?.0;
        if cost > budget {
            return None;
        }
        self.mesh.points[vertex as usize] = point;
        self.sizes[vertex as usize] = size;
        Some(cost)
    }
}
