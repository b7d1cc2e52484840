//! A spring between two nodes, ½ k (|x_b − x_a| − l)², and the damper beside it, whose force is c (v_b − v_a)·n along its direction n.

use fem_model::{Body, DampingForm};

use crate::forces::{Energy, HessianKind};
use fem_elements::sparse::{Block, Pattern};
use fem_elements::vector::triple;
use fem_solvers::Real;
use fem_solvers::numbering::Numbering;

/// A spring between two nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring<T> {
    /// The engine's numbers of its ends a and b.
    pub nodes: [u32; 2],
    /// X_b − X_a at rest, m.
    edge: [T; 3],
    /// k, N/m
    pub stiffness: T,
    /// l, m
    length: T,
    /// |X_b − X_a|² − l², m²: zero where the spring is at rest with the body.
    excess: T,
    /// c, N s/m
    pub(super) damping: T,
}

impl<T: Real> Spring<T> {
    /// A spring of 1 N/m between two nodes, at rest where they are.
    pub fn at_rest(nodes: [u32; 2], [a, b]: [nalgebra::Vector3<f64>; 2]) -> Self {
        let edge = b - a;
        Self {
            nodes,
            edge: [T::of(edge.x), T::of(edge.y), T::of(edge.z)],
            stiffness: T::one(),
            length: T::of(edge.norm()),
            excess: T::default(),
            damping: T::default(),
        }
    }

    /// Adds (k 1, −k 1; −k 1, k 1) to a matrix, N/m: Liu, Bargteil, O'Brien and Kavan, Fast simulation of mass-spring systems (2013), eq. 12.
    pub fn add_metric(&self, pattern: &Pattern, values: &mut [Block<T, 3>]) {
        let ([a, b], one) = (self.ends(), T::one());
        for (row, column, sign) in [(a, a, one), (b, b, one), (a, b, -one), (b, a, -one)] {
            if let Some(block) = pattern.find(row, column) {
                for i in 0..3 {
                    values[block][i][i] += sign * self.stiffness;
                }
            }
        }
    }

    pub(super) fn new(body: &Body, spring: &fem_model::Spring, numbering: &Numbering) -> Self {
        let [a, b] = spring.nodes.map(|node| body.shape.mesh.vertices()[node]);
        let edge = b - a;
        let length = spring.rest_length;
        // Rounding of a length that is the undeformed distance must not stretch the spring.
        let viscosity =
            body.damping.filter(|damping| damping.form == DampingForm::KelvinVoigt).map_or(0.0, |of| of.beta);
        let excess = if spring.is_initially_relaxed { 0.0 } else { edge.norm_squared() - length * length };
        Self {
            nodes: spring.nodes.map(|node| numbering.engine_node[node]),
            edge: [T::of(edge.x), T::of(edge.y), T::of(edge.z)],
            stiffness: T::of(spring.stiffness),
            length: T::of(length),
            excess: T::of(excess),
            damping: T::of(spring.damping + viscosity * spring.stiffness),
        }
    }

    /// Energy, J. Its terms include the rounding error of a stretch whose terms cancel, as in a rotated spring.
    pub(super) fn energy(&self, u: &[[T; 3]]) -> Energy {
        let Now { stretch, cancelled, .. } = self.now(u);
        let (stretch, k) = (stretch.as_f64(), self.stiffness.as_f64());
        let value = 0.5 * k * stretch * stretch;
        Energy { value, terms: value + k * stretch.abs() * cancelled.as_f64() }
    }

    /// Adds the gradient of its energy, k (1 − l/|d|) d at b and the opposite at a, N; zero where both ends meet.
    pub(super) fn add_gradient(&self, u: &[[T; 3]], gradient: &mut [[T; 3]]) {
        let Now { d, length, stretch, .. } = self.now(u);
        if length == T::zero() {
            return;
        }
        let factor = self.stiffness * stretch / length;
        let [a, b] = self.ends();
        for i in 0..3 {
            gradient[a][i] -= factor * d[i];
            gradient[b][i] += factor * d[i];
        }
    }

    /// H of the Hessian (H, −H; −H, H): k (n nᵀ + (1 − l/|d|)(1 − n nᵀ)), N/m. A compressed spring pushes sideways, and its
    /// second part is negative; the projection leaves that out.
    pub fn hessian(&self, u: &[[T; 3]], kind: HessianKind) -> Block<T, 3> {
        let Now { d, length, stretch, .. } = self.now(u);
        let (n, mut across) = if length == T::zero() {
            // A spring of length zero has no direction, and is equally stiff in all directions.
            ([T::zero(); 3], T::one())
        } else {
            (d.map(|d| d / length), stretch / length)
        };
        if kind == HessianKind::Projected && across < T::zero() {
            across = T::zero();
        }
        triple(|i| {
            triple(|j| {
                let one = if i == j { across } else { T::zero() };
                self.stiffness * (one + (T::one() - across) * n[i] * n[j])
            })
        })
    }

    /// Adds `factor` times its Hessian times d.
    pub(super) fn add_hessian_times(&self, factor: T, u: &[[T; 3]], d: &[[T; 3]], product: &mut [[T; 3]]) {
        let H = self.hessian(u, HessianKind::Exact);
        let [a, b] = self.ends();
        let apart: [T; 3] = triple(|i| d[b][i] - d[a][i]);
        for i in 0..3 {
            let force = factor * (H[i][0] * apart[0] + H[i][1] * apart[1] + H[i][2] * apart[2]);
            product[a][i] -= force;
            product[b][i] += force;
        }
    }

    /// Adds `factor` D(u) v, N: c (v_b − v_a)·n n at b and the opposite at a. A spring whose ends meet has no direction n to damp.
    pub(super) fn add_damping_times(&self, factor: T, u: &[[T; 3]], v: &[[T; 3]], product: &mut [[T; 3]]) {
        let Some(n) = self.direction(u) else { return };
        let [a, b] = self.ends();
        let rate = (0..3).fold(T::zero(), |rate, i| rate + (v[b][i] - v[a][i]) * n[i]);
        for i in 0..3 {
            let force = factor * self.damping * rate * n[i];
            product[a][i] -= force;
            product[b][i] += force;
        }
    }

    /// c n nᵀ, N s/m: the block D of its damping matrix (D, −D; −D, D), which is positive semi-definite.
    pub(super) fn damping_matrix(&self, u: &[[T; 3]]) -> Block<T, 3> {
        let n = self.direction(u).unwrap_or([T::zero(); 3]);
        triple(|i| triple(|j| self.damping * n[i] * n[j]))
    }

    /// (x_b − x_a)/|x_b − x_a|; `None` where both ends meet.
    fn direction(&self, u: &[[T; 3]]) -> Option<[T; 3]> {
        let Now { d, length, .. } = self.now(u);
        (length > T::zero()).then(|| d.map(|d| d / length))
    }

    /// The engine's numbers of its ends.
    pub fn ends(&self) -> [usize; 2] {
        self.nodes.map(|node| node as usize)
    }

    /// With E = X_b − X_a and δ = u_b − u_a, |d| − l = (2 E·δ + δ·δ + |E|² − l²)/(|d| + l): it keeps its digits where the
    /// difference of the lengths cancels.
    pub fn now(&self, u: &[[T; 3]]) -> Now<T> {
        let [a, b] = self.ends();
        let moved: [T; 3] = triple(|i| u[b][i] - u[a][i]);
        let d: [T; 3] = triple(|i| self.edge[i] + moved[i]);
        let length = (d[0] * d[0] + d[1] * d[1] + d[2] * d[2]).sqrt();
        let (mut difference, mut size) = (self.excess, self.excess.abs());
        for i in 0..3 {
            let term = (self.edge[i] + d[i]) * moved[i];
            difference += term;
            size += term.abs();
        }
        let sum = length + self.length;
        let over = if sum > T::zero() { T::one() / sum } else { T::zero() };
        Now { d, length, stretch: difference * over, cancelled: size * over }
    }
}

/// A deformed spring.
pub struct Now<T> {
    /// x_b − x_a, m.
    pub d: [T; 3],
    /// Its length, m.
    pub length: T,
    /// |d| − l, m.
    pub stretch: T,
    /// Magnitude of the terms whose sum the stretch is, m.
    cancelled: T,
}

#[cfg(test)]
mod tests {
    use super::{HessianKind, Spring};

    fn spring(length: f64) -> Spring<f64> {
        let edge = [1.0, 2.0, 2.0];
        Spring { nodes: [0, 1], edge, stiffness: 50.0, length, excess: 9.0 - length * length, damping: 3.0 }
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
                let slope = (spring.energy(&ahead).value - spring.energy(&behind).value) / 2e-6;
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
        let energy = spring(3.0).energy(&u).value;
        assert!((energy / (0.5 * 50.0 * 9e-24) - 1.0).abs() < 1e-11, "{energy:e}");
    }

    #[test]
    fn the_damping_matrix_is_the_derivative_of_the_damping_force_along_the_spring() {
        let spring = Spring { edge: [3.0, 0.0, 0.0], ..spring(3.0) };
        let v = [[1.0, 5.0, -2.0], [3.0, -4.0, 7.0]];
        let mut force = [[0.0; 3]; 2];
        spring.add_damping_times(2.0, &[[0.0; 3]; 2], &v, &mut force);
        // The ends go apart by 2 m/s, the damper has 3 N s/m.
        assert_eq!(force, [[-12.0, 0.0, 0.0], [12.0, 0.0, 0.0]]);
        let D = spring.damping_matrix(&U);
        let mut product = [[0.0; 3]; 2];
        spring.add_damping_times(1.0, &U, &v, &mut product);
        for i in 0..3 {
            let expected: f64 = (0..3).map(|j| D[i][j] * (v[1][j] - v[0][j])).sum();
            assert!((product[1][i] - expected).abs() < 1e-14 && product[0][i] == -product[1][i]);
        }
        assert_eq!(spring.damping_matrix(&[[3.0, 0.0, 0.0], [0.0; 3]]), [[0.0; 3]; 3]);
    }
}
