//! Laws of the logarithmic strains ε_i = ln σ_i: their stress and its derivative from Kirchhoff's principal stresses τ_i = ∂ψ/∂ε_i.
//!
//! P_i = τ_i/σ_i; Simo, Algorithms for Static and Dynamic Multiplicative Plasticity (1992), §2. The terms of the derivative divide
//! out the differences of stretches, so that equal stretches give no 0/0.

use super::isotropic::Principal;
use super::stretches::stretches;
use crate::number::{Number, constant, minus_ln_1p};
use crate::svd::Svd;
use crate::tensor::{Tensor, half};

/// Principal stretches and their logarithms.
#[derive(Clone, Copy)]
pub(crate) struct Logarithmic<T> {
    /// F = U diag(σ) Vᵀ
    pub F: Svd<T>,
    /// ln σ_i, to full relative accuracy also near rest; meaningless where σ_i ≤ 0.
    pub strains: [T; 3],
}

/// Kirchhoff's principal stresses of a law and their slopes, Pa.
#[derive(Clone, Copy)]
pub(crate) struct Kirchhoff<T> {
    /// τ_i
    pub tau: [T; 3],
    /// (τ_i − τ_j)/(ε_i − ε_j) of two axes, with the index of the third: twice a shear modulus of Hooke's law.
    pub ratios: [T; 3],
    /// ∂τ_i/∂ε_j
    pub moduli: Tensor<T>,
}

impl<T: Number> Logarithmic<T> {
    /// The strains of a displacement gradient.
    #[inline(always)]
    pub fn new(G: &Tensor<T>) -> Self {
        let (F, e) = stretches(G);
        Self { F, strains: [e[0] - minus_ln_1p(e[0]), e[1] - minus_ln_1p(e[1]), e[2] - minus_ln_1p(e[2])] }
    }

    /// The energy, which is infinite where an element is flat or inverted.
    #[inline(always)]
    pub fn allowed(&self, energy: T) -> T {
        energy.select(self.F.sigma[2].gt(T::zero()), constant(f64::INFINITY))
    }

    /// P = U diag(τ_i/σ_i) Vᵀ
    #[inline(always)]
    pub fn stress(&self, tau: &[T; 3]) -> Tensor<T> {
        let sigma = &self.F.sigma;
        self.F.with_values(&[tau[0] / sigma[0], tau[1] / sigma[1], tau[2] / sigma[2]])
    }

    /// The terms of ∂P/∂F. With m_i = τ_i/σ_i, (m_i − m_j)/(σ_i − σ_j) is (L (σ_i + σ_j)/2 − (τ_i + τ_j)/2)/(σ_i σ_j), where
    /// L = (τ_i − τ_j)/(σ_i − σ_j) is the ratio times ln(σ_i/σ_j)/(σ_i − σ_j).
    #[inline(always)]
    pub fn principal(&self, stress: &Kirchhoff<T>) -> Principal<T> {
        let (sigma, tau) = (&self.F.sigma, &stress.tau);
        let mut principal = Principal::zero();
        for k in 0..3 {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let (sum, product) = (sigma[i] + sigma[j], sigma[i] * sigma[j]);
            let x = (sigma[i] - sigma[j]) / sigma[j];
            // 1 − ln(1 + x)/x, of which the limit at x = 0 is zero.
            let lost = T::zero().select(x.eq(T::zero()), minus_ln_1p(x) / x);
            let slope = stress.ratios[k] * (T::one() - lost) / sigma[j];
            principal.twist[k] = (tau[i] / sigma[i] + tau[j] / sigma[j]) / sum;
            principal.flip[k] = half::<T>() * (slope * sum - (tau[i] + tau[j])) / product;
            for l in 0..3 {
                principal.scaling[k][l] = stress.moduli[k][l] / (sigma[k] * sigma[l]);
            }
            principal.scaling[k][k] -= tau[k] / (sigma[k] * sigma[k]);
        }
        principal
    }
}
