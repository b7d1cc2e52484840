//! Additive plasticity of the corotated law: with F = R S and ε = S − 1, ψ = μ |ε − εᵖ|² + λ/2 tr(ε − εᵖ)².
//!
//! If the elastic strain εᵉ = ε − εᵖ is larger than the yield strain y in the Frobenius norm, εᵖ flows at the rate
//! c (|εᵉ| − y) εᵉ/|εᵉ|, c in 1/s. At fixed ε this gives |εᵉ| = y + (|εᵉ₀| − y) e^(−c t). O'Brien, Bargteil and Hodgins, Graphical
//! Modeling and Animation of Ductile Fracture (2002), have a flow of this kind in Green's strain. εᵖ belongs to the undeformed
//! body and may change its volume; in the plane strain of a flat body it has no part along z.
//!
//! With σ̂ = 2μ εᵉ + λ tr(εᵉ) 1 in the basis of S and w_ij = σ_i/(σ_i + σ_j), P_ij = 2 w_ij σ̂_ij in that of F, because
//! δS_ij = (δF_ji σ_j + σ_i δF_ij)/(σ_i + σ_j).

use super::{Flow, Internal};
use crate::materials::{Law, derivative_in_basis, stretches, stretches_in_plane};
use crate::number::{Float, Number, constant};
use crate::svd::Svd;
use crate::tensor::{self, Tensor, Tensor4, dot, from_fn, half, map, trace};

/// Lamé's constants, Pa, and the plastic strain.
#[derive(Clone, Copy, Debug)]
pub struct Additive<T> {
    /// Shear modulus μ.
    pub mu: T,
    /// λ
    pub lambda: T,
    /// Plastic strain εᵖ.
    pub plastic: Tensor<T>,
    /// The body is flat: inverted elements are turned back within the plane.
    pub is_in_plane: bool,
}

/// Relative distance from `maximum` at which rounding error leaves the plastic strain below it.
const ROUNDING: f64 = 4.0 * f64::EPSILON;

/// The elastic strain in the basis of the principal directions of S.
struct Strained<T> {
    F: Svd<T>,
    elastic: Tensor<T>,
}

impl<T: Number> Additive<T> {
    #[inline(always)]
    fn strained(&self, G: &Tensor<T>) -> Strained<T> {
        let (F, e) = if self.is_in_plane { stretches_in_plane(G) } else { stretches(G) };
        let V = &F.V;
        let elastic = from_fn(
            #[inline(always)]
            |i, j| {
                let mut entry = if i == j { e[i] } else { T::zero() };
                for k in 0..3 {
                    for l in 0..3 {
                        entry -= V[i][k] * self.plastic[k][l] * V[j][l];
                    }
                }
                entry
            },
        );
        Strained { F, elastic }
    }

    /// Energy density of an elastic strain, J/m³.
    #[inline(always)]
    fn energy_of(&self, elastic: &Tensor<T>) -> T {
        let sum = trace(elastic);
        self.mu * dot(elastic, elastic) + half::<T>() * self.lambda * sum * sum
    }

    /// σ̂
    #[inline(always)]
    fn conjugate(&self, elastic: &Tensor<T>) -> Tensor<T> {
        let (two_mu, pressure) = (constant::<T>(2.0) * self.mu, self.lambda * trace(elastic));
        from_fn(
            #[inline(always)]
            |i, j| if i == j { two_mu * elastic[i][j] + pressure } else { two_mu * elastic[i][j] },
        )
    }

    #[inline(always)]
    fn stress_of(&self, at: &Strained<T>) -> Tensor<T> {
        let (w, conjugate) = (weights(&at.F.sigma), self.conjugate(&at.elastic));
        let two = constant::<T>(2.0);
        let P = from_fn(
            #[inline(always)]
            |i, j| if i == j { conjugate[i][j] } else { two * w[i][j] * conjugate[i][j] },
        );
        let (U, V) = (&at.F.U, &at.F.V);
        from_fn(
            #[inline(always)]
            |i, j| {
                let mut sum = T::zero();
                for k in 0..3 {
                    for l in 0..3 {
                        sum += P[k][l] * U[k][i] * V[l][j];
                    }
                }
                sum
            },
        )
    }

    /// ∂P/∂F in the basis u_k v_lᵀ. The direction kl changes S by w_kl (e_k e_lᵀ + e_l e_kᵀ), with w_kk = ½; of Z = σ̂_ij/(σ_i + σ_j), which
    /// the second variation has, the diagonal divides out.
    #[inline(always)]
    fn components(&self, at: &Strained<T>) -> Tensor4<T> {
        let (two, sigma) = (constant::<T>(2.0), &at.F.sigma);
        let (w, conjugate) = (weights(sigma), self.conjugate(&at.elastic));
        let Z = from_fn(
            #[inline(always)]
            |i, j| if i == j { T::zero() } else { conjugate[i][j] / sum(sigma, i, j) },
        );
        let mut H = [[T::zero(); 9]; 9];
        for row in 0..9 {
            for column in 0..9 {
                let (k, l, m, n) = (row / 3, row % 3, column / 3, column % 3);
                let both = w[k][l] * w[m][n];
                let mut entry = T::zero();
                // 2 tr(Z δS δ'S) of the second variation of S.
                for (a, b) in [(k, l), (l, k)] {
                    for (c, d) in [(m, n), (n, m)] {
                        if b == c {
                            entry -= two * both * Z[d][a];
                        }
                        if (a, b) == (c, d) {
                            entry += two * self.mu * both;
                        }
                    }
                }
                if k == m {
                    entry += two * Z[n][l];
                }
                if k == l && m == n {
                    entry += self.lambda;
                }
                H[row][column] = entry;
            }
        }
        for k in 0..3 {
            for l in (0..3).filter(|&l| l != k) {
                let square = sum(sigma, k, l) * sum(sigma, k, l);
                let (of_k, of_l) = (conjugate[k][k], conjugate[l][l]);
                H[3 * k + l][3 * k + l] += (of_l * (two * sigma[k] + sigma[l]) - of_k * sigma[k]) / square;
                H[3 * k + l][3 * l + k] -= (sigma[l] * of_k + sigma[k] * of_l) / square;
            }
        }
        H
    }
}

/// σ_i + σ_j. On the crease, where it is zero, the derivative is not finite; beside it, it is cut off.
#[inline(always)]
fn sum<T: Number>(sigma: &[T; 3], i: usize, j: usize) -> T {
    (sigma[i] + sigma[j]).max(constant::<T>(Float::as_f64(<T::Element as Float>::EPSILON).sqrt()))
}

/// σ_i/(σ_i + σ_j), and ½ on the diagonal.
#[inline(always)]
fn weights<T: Number>(sigma: &[T; 3]) -> Tensor<T> {
    from_fn(
        #[inline(always)]
        |i, j| if i == j { half() } else { sigma[i] / sum(sigma, i, j) },
    )
}

impl Additive<f64> {
    /// The flow of an accepted step that ends with the displacement gradient G. `relaxed` is 1 − e^(−c dt), the part of the strain beyond the
    /// yield strain that flows; |εᵖ| does not exceed `maximum`.
    pub fn flow(&self, G: &Tensor<f64>, yield_strain: f64, relaxed: f64, maximum: f64) -> Flow {
        let before = norm(&self.plastic);
        let unchanged = (Internal { plastic: self.plastic, strain: before.min(maximum) }, 0.0);
        let at = self.strained(G);
        let size = norm(&at.elastic);
        // NaN fails the comparison.
        if !(size > yield_strain) {
            return unchanged;
        }
        let V = &at.F.V;
        let part = relaxed * (1.0 - yield_strain / size);
        let elastic =
            from_fn(|i, j| (0..9).map(|kl| at.elastic[kl / 3][kl % 3] * V[kl / 3][i] * V[kl % 3][j]).sum::<f64>());
        let mut change = map(&elastic, |entry| part * entry);
        let reached = norm(&plus(&self.plastic, 1.0, &change));
        if reached > maximum {
            let bounded = maximum / reached * (1.0 - ROUNDING);
            let plastic = map(&plus(&self.plastic, 1.0, &change), |entry| bounded * entry);
            let way = plus(&plastic, -1.0, &self.plastic);
            // The projection may raise the energy where λ weighs volume more than shape; the part of the way that lowers it most does not.
            let descent = dot(&self.conjugate(&elastic), &way);
            let part = (descent / (2.0 * self.energy_of(&way))).clamp(0.0, 1.0);
            if part.is_nan() {
                return unchanged;
            }
            change = map(&way, |entry| part * entry);
        }
        let plastic = plus(&self.plastic, 1.0, &change);
        let dissipated = self.energy_of(&elastic) - self.energy_of(&plus(&elastic, -1.0, &change));
        (Internal { plastic, strain: norm(&plastic).min(maximum) }, dissipated.max(0.0))
    }
}

/// a + factor b
fn plus(a: &Tensor<f64>, factor: f64, b: &Tensor<f64>) -> Tensor<f64> {
    from_fn(|i, j| a[i][j] + factor * b[i][j])
}

/// The Frobenius norm.
fn norm(a: &Tensor<f64>) -> f64 {
    dot(a, a).sqrt()
}

impl<T: Number> Law<T> for Additive<T> {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        self.energy_of(&self.strained(G).elastic)
    }

    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        self.stress_of(&self.strained(G))
    }

    #[inline(always)]
    fn energy_and_stress(&self, G: &Tensor<T>) -> (T, Tensor<T>) {
        let at = self.strained(G);
        (self.energy_of(&at.elastic), self.stress_of(&at))
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let at = self.strained(G);
        derivative_in_basis(&at.F, &self.components(&at))
    }

    /// By the eigenvalues of the 9×9 matrix: the law is not isotropic, so that they have no closed form.
    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let at = self.strained(G);
        derivative_in_basis(&at.F, &raised(&self.components(&at)))
    }
}

/// A symmetric matrix with its negative eigenvalues raised to zero; as it is in a lane that is not finite.
fn raised<T: Number>(H: &Tensor4<T>) -> Tensor4<T> {
    let mut result = *H;
    for lane in 0..T::LANES {
        let entry = |i: usize, j: usize| Float::as_f64(H[i][j].lane(lane));
        let matrix = nalgebra::SMatrix::<f64, 9, 9>::from_fn(entry);
        let Some(raised) = tensor::raised(matrix) else { continue };
        for i in 0..9 {
            for j in 0..9 {
                result[i][j].set_lane(lane, <T::Element as Float>::of(raised[(i, j)]));
            }
        }
    }
    result
}
