//! Springs between two nodes: ½ k (|x_b − x_a| − l)².

use crate::number::Real;
use crate::sparse::{Block, Pattern};

/// A spring between two nodes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Spring<T> {
    /// The engine's numbers of its ends a and b.
    pub nodes: [usize; 2],
    /// X_b − X_a at rest, m.
    pub edge: [T; 3],
    /// k, N/m
    pub stiffness: T,
    /// l, m
    pub length: T,
    /// |X_b − X_a|² − l², m²: zero where the spring is at rest with the body.
    pub excess: T,
}

impl<T: Real> Spring<T> {
    /// Its energy, J.
    pub fn energy(&self, u: &[[T; 3]]) -> f64 {
        let stretch = self.now(u).stretch.as_f64();
        0.5 * self.stiffness.as_f64() * stretch * stretch
    }

    /// Adds the gradient of its energy, k (1 − l/|d|) d at b and the opposite at a, N; zero where both ends meet.
    pub fn add_gradient(&self, u: &[[T; 3]], gradient: &mut [[T; 3]]) {
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
    /// second part is negative; `projected` leaves that out.
    pub fn hessian(&self, u: &[[T; 3]], projected: bool) -> Block<T, 3> {
        let Now { d, length, stretch } = self.now(u);
        let (n, mut across) = if length == T::zero() {
            // There is no direction to be stiff along; that in all of them is the nearest.
            ([T::zero(); 3], T::one())
        } else {
            (d.map(|d| d / length), stretch / length)
        };
        if projected && across < T::zero() {
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
    pub fn add_stiffness(
        &self,
        factor: T,
        u: &[[T; 3]],
        projected: bool,
        pattern: &Pattern,
        values: &mut [Block<T, 3>],
    ) {
        let H = self.hessian(u, projected);
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
    pub fn add_stiffness_times(&self, factor: T, u: &[[T; 3]], d: &[[T; 3]], product: &mut [[T; 3]]) {
        let H = self.hessian(u, false);
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
    /// difference of the lengths has none.
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

/// A spring as it is.
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
    use super::Spring;

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
                spring.add_stiffness_times(1.0, &U, &direction, &mut product);
                for r in 0..6 {
                    let slope = (ahead[r / 3][r % 3] - behind[r / 3][r % 3]) / 2e-6;
                    assert!((slope - product[r / 3][r % 3]).abs() < 1e-5, "l = {length}, {r} {c}");
                }
            }
        }
    }

    #[test]
    fn a_compressed_spring_is_projected_by_leaving_out_what_is_negative() {
        let H = nalgebra::Matrix3::from_fn(|i, j| spring(5.0).hessian(&U, true)[i][j]);
        let values = H.symmetric_eigenvalues();
        assert!(values.min() > -1e-12 && (values.max() - 50.0).abs() < 1e-12, "{values}");
        let exact = nalgebra::Matrix3::from_fn(|i, j| spring(5.0).hessian(&U, false)[i][j]);
        assert!(exact.symmetric_eigenvalues().min() < -1.0);
    }

    #[test]
    fn a_spring_whose_ends_meet_has_no_force_and_a_finite_stiffness() {
        let u = [[1.0, 2.0, 2.0], [0.0; 3]];
        assert_eq!(gradient(&spring(3.0), &u), [[0.0; 3]; 2]);
        assert_eq!(spring(3.0).hessian(&u, false)[1], [0.0, 50.0, 0.0]);
    }

    #[test]
    fn a_small_stretch_keeps_its_digits() {
        let u = [[0.0; 3], [1e-12, 2e-12, 2e-12]];
        let energy = spring(3.0).energy(&u);
        assert!((energy / (0.5 * 50.0 * 9e-24) - 1.0).abs() < 1e-11, "{energy:e}");
    }
}
