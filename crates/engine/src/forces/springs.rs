//! Springs between two nodes: ½ k (|x_b − x_a| − l)².

use fem_scene::Body;

use super::{Energy, HessianKind, Moment, Potential};
use crate::model::numbering::Numbering;
use crate::number::Real;
use crate::sparse::{Block, Pattern};

/// Key in the statistics.
pub const NAME: &str = "springs";

/// All springs of a body.
struct Springs<T>(Vec<Spring<T>>);

/// The springs of a body; `None` where it has none.
pub fn build<T: Real>(body: &Body, numbering: &Numbering) -> Option<Box<dyn Potential<T>>> {
    let springs: Vec<_> = body.springs.iter().map(|spring| Spring::new(body, spring, numbering)).collect();
    (!springs.is_empty()).then(|| Box::new(Springs(springs)) as Box<dyn Potential<T>>)
}

impl<T: Real> Potential<T> for Springs<T> {
    fn name(&self) -> &'static str {
        NAME
    }

    fn description(&self) -> String {
        format!("[[springs]]: {} of them", self.0.len())
    }

    fn bytes(&self) -> usize {
        size_of_val(&self.0[..])
    }

    fn is_internal(&self) -> bool {
        true
    }

    fn couplings(&self) -> Vec<[u32; 2]> {
        self.0.iter().map(|spring| spring.nodes.map(|node| node as u32)).collect()
    }

    fn energy(&self, u: &[[T; 3]], _: Moment) -> Energy {
        Energy::of(self.0.iter().map(|spring| spring.energy(u)).sum())
    }

    fn add_gradient(&self, u: &[[T; 3]], _: Moment, gradient: &mut [[T; 3]]) {
        self.0.iter().for_each(|spring| spring.add_gradient(u, gradient));
    }

    fn add_hessian(&self, factor: T, u: &[[T; 3]], kind: HessianKind, pattern: &Pattern, values: &mut [Block<T, 3>]) {
        self.0.iter().for_each(|spring| spring.add_hessian(factor, u, kind, pattern, values));
    }

    fn add_hessian_times(&self, factor: T, u: &[[T; 3]], d: &[[T; 3]], product: &mut [[T; 3]]) {
        self.0.iter().for_each(|spring| spring.add_hessian_times(factor, u, d, product));
    }

    /// The two forces of a spring are equal and opposite.
    fn resultant(&self, _: Moment) -> Option<[f64; 3]> {
        Some([0.0; 3])
    }

    fn out_of_range(&self) -> Option<(&'static str, &'static str)> {
        let is_representable = self.0.iter().all(|spring| crate::number::is_positive(spring.stiffness));
        (!is_representable).then_some(("springs", "a stiffness"))
    }
}

/// A spring between two nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Spring<T> {
    /// The engine's numbers of its ends a and b.
    nodes: [usize; 2],
    /// X_b − X_a at rest, m.
    edge: [T; 3],
    /// k, N/m
    stiffness: T,
    /// l, m
    length: T,
    /// |X_b − X_a|² − l², m²: zero where the spring is at rest with the body.
    excess: T,
}

impl<T: Real> Spring<T> {
    fn new(body: &Body, spring: &fem_scene::Spring, numbering: &Numbering) -> Self {
        let [a, b] = spring.nodes.map(|node| body.shape.mesh.vertices()[node]);
        let edge = b - a;
        let length = spring.rest_length;
        // Rounding of a length that is the undeformed distance must not stretch the spring.
        let excess = if spring.is_initially_relaxed { 0.0 } else { edge.norm_squared() - length * length };
        Self {
            nodes: spring.nodes.map(|node| numbering.engine_node[node] as usize),
            edge: [T::of(edge.x), T::of(edge.y), T::of(edge.z)],
            stiffness: T::of(spring.stiffness),
            length: T::of(length),
            excess: T::of(excess),
        }
    }

    /// Energy, J.
    fn energy(&self, u: &[[T; 3]]) -> f64 {
        let stretch = self.now(u).stretch.as_f64();
        0.5 * self.stiffness.as_f64() * stretch * stretch
    }

    /// Adds the gradient of its energy, k (1 − l/|d|) d at b and the opposite at a, N; zero where both ends meet.
    fn add_gradient(&self, u: &[[T; 3]], gradient: &mut [[T; 3]]) {
        let Now { d, length, stretch } = self.now(u);
        if length == T::zero() {
            return;
        }
        let factor = self.stiffness * stretch / length;
        let [a, b] = self.nodes;
        for i in 0..3 {
            gradient[a][i] -= factor * d[i];
            gradient[b][i] += factor * d[i];
        }
    }

    /// H of the Hessian (H, −H; −H, H): k (n nᵀ + (1 − l/|d|)(1 − n nᵀ)), N/m. A compressed spring pushes sideways, and its
    /// second part is negative; the projection leaves that out.
    fn hessian(&self, u: &[[T; 3]], kind: HessianKind) -> Block<T, 3> {
        let Now { d, length, stretch } = self.now(u);
        let (n, mut across) = if length == T::zero() {
            // Without a direction to be stiff along, the spring is equally stiff in all of them.
            ([T::zero(); 3], T::one())
        } else {
            (d.map(|d| d / length), stretch / length)
        };
        if kind == HessianKind::Projected && across < T::zero() {
            across = T::zero();
        }
        std::array::from_fn(|i| {
            std::array::from_fn(|j| {
                let one = if i == j { across } else { T::zero() };
                self.stiffness * (one + (T::one() - across) * n[i] * n[j])
            })
        })
    }

    /// Adds `factor` times its Hessian to a matrix.
    fn add_hessian(&self, factor: T, u: &[[T; 3]], kind: HessianKind, pattern: &Pattern, values: &mut [Block<T, 3>]) {
        let H = self.hessian(u, kind);
        for (row, column, sign) in self.pairs() {
            if let Some(block) = pattern.find(row, column) {
                for i in 0..3 {
                    for j in 0..3 {
                        values[block][i][j] += sign * factor * H[i][j];
                    }
                }
            }
        }
    }

    /// Adds `factor` times its Hessian times d.
    fn add_hessian_times(&self, factor: T, u: &[[T; 3]], d: &[[T; 3]], product: &mut [[T; 3]]) {
        let H = self.hessian(u, HessianKind::Exact);
        for (row, column, sign) in self.pairs() {
            for i in 0..3 {
                for j in 0..3 {
                    product[row][i] += sign * factor * H[i][j] * d[column][j];
                }
            }
        }
    }

    fn pairs(&self) -> [(usize, usize, T); 4] {
        let ([a, b], one) = (self.nodes, T::one());
        [(a, a, one), (b, b, one), (a, b, -one), (b, a, -one)]
    }

    /// With E = X_b − X_a and δ = u_b − u_a, |d| − l = (2 E·δ + δ·δ + |E|² − l²)/(|d| + l): it keeps its digits where the
    /// difference of the lengths cancels.
    fn now(&self, u: &[[T; 3]]) -> Now<T> {
        let [a, b] = self.nodes;
        let moved: [T; 3] = std::array::from_fn(|i| u[b][i] - u[a][i]);
        let d: [T; 3] = std::array::from_fn(|i| self.edge[i] + moved[i]);
        let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
        let mut difference = self.excess;
        for i in 0..3 {
            difference += (self.edge[i] + d[i]) * moved[i];
        }
        let sum = length + self.length;
        let stretch = if sum > T::zero() { difference / sum } else { T::zero() };
        Now { d, length, stretch }
    }
}

/// A deformed spring.
struct Now<T> {
    /// x_b − x_a, m.
    d: [T; 3],
    /// Its length, m.
    length: T,
    /// |d| − l, m.
    stretch: T,
}

#[cfg(test)]
mod tests {
    use super::{HessianKind, Spring};

    fn spring(length: f64) -> Spring<f64> {
        let edge = [1.0, 2.0, 2.0];
        Spring { nodes: [0, 1], edge, stiffness: 50.0, length, excess: 9.0 - length * length }
    }

    const U: [[f64; 3]; 2] = [[0.1, -0.2, 0.3], [-0.4, 0.2, 0.1]];

    /// U with one coordinate moved by h.
    fn moved(coordinate: usize, h: f64) -> [[f64; 3]; 2] {
        let mut u = U;
        u[coordinate / 3][coordinate % 3] += h;
        u
    }

    fn gradient(spring: &Spring<f64>, u: &[[f64; 3]; 2]) -> [[f64; 3]; 2] {
        let mut gradient = [[0.0; 3]; 2];
        spring.add_gradient(u, &mut gradient);
        gradient
    }

    #[test]
    fn gradient_and_hessian_are_those_of_the_energy() {
        for length in [0.0, 1.0, 3.0, 5.0] {
            let spring = spring(length);
            for c in 0..6 {
                let (ahead, behind) = (moved(c, 1e-6), moved(c, -1e-6));
                let slope = (spring.energy(&ahead) - spring.energy(&behind)) / 2e-6;
                assert!((slope - gradient(&spring, &U)[c / 3][c % 3]).abs() < 1e-6, "l = {length}, {c}");
                let (ahead, behind) = (gradient(&spring, &ahead), gradient(&spring, &behind));
                let mut direction = [[0.0; 3]; 2];
                direction[c / 3][c % 3] = 1.0;
                let mut product = [[0.0; 3]; 2];
                spring.add_hessian_times(1.0, &U, &direction, &mut product);
                for r in 0..6 {
                    let slope = (ahead[r / 3][r % 3] - behind[r / 3][r % 3]) / 2e-6;
                    assert!((slope - product[r / 3][r % 3]).abs() < 1e-5, "l = {length}, {r} {c}");
                }
            }
        }
    }

    #[test]
    fn a_compressed_spring_is_projected_by_leaving_out_what_is_negative() {
        let H = nalgebra::Matrix3::from_fn(|i, j| spring(5.0).hessian(&U, HessianKind::Projected)[i][j]);
        let values = H.symmetric_eigenvalues();
        assert!(values.min() > -1e-12 && (values.max() - 50.0).abs() < 1e-12, "{values}");
        let exact = nalgebra::Matrix3::from_fn(|i, j| spring(5.0).hessian(&U, HessianKind::Exact)[i][j]);
        assert!(exact.symmetric_eigenvalues().min() < -1.0);
    }

    #[test]
    fn a_spring_whose_ends_meet_has_no_force_and_a_finite_stiffness() {
        let u = [[1.0, 2.0, 2.0], [0.0; 3]];
        assert_eq!(gradient(&spring(3.0), &u), [[0.0; 3]; 2]);
        assert_eq!(spring(3.0).hessian(&u, HessianKind::Exact)[1], [0.0, 50.0, 0.0]);
    }

    #[test]
    fn a_small_stretch_keeps_its_digits() {
        let u = [[0.0; 3], [1e-12, 2e-12, 2e-12]];
        let energy = spring(3.0).energy(&u);
        assert!((energy / (0.5 * 50.0 * 9e-24) - 1.0).abs() < 1e-11, "{energy:e}");
    }
}
