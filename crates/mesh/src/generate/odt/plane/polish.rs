//! Moves that raise the worst triangles.

use nalgebra::Vector2;

use super::Smoothing;

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
}
