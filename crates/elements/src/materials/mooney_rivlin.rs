//! ψ = C10 (Ī1 − 3) + C01 (Ī2 − 3) + D (J − 1)²: compressible Mooney–Rivlin, for rubber up to about twice its length.
//!
//! Mooney, A Theory of Large Elastic Deformation (1940); Rivlin, Large Elastic Deformations of Isotropic Materials IV (1948).
//! Ī1 = J^(−2/3) tr(FᵀF) and Ī2 = J^(−4/3) I2, I2 = ½ (tr(FᵀF)² − tr((FᵀF)²)) = tr(cofᵀcof), cof = ∂J/∂F.
//!
//! Because det cof = J², Ī2 of F is Ī1 of cof: with S = ∂Ī1/∂F at cof, ∂Ī2/∂F = S × F, where × is the tensor cross product
//! (Bonet, Gil and Ortigosa 2016) with ∂cof/∂F : X = X × F. Energy and stress have all digits of Ī1's near rest.
//! With N = ∂I2/∂F = 2 (tr(FᵀF) F − F FᵀF) and h = J^(−4/3),
//! ∂²Ī2/∂F² = h ∂N/∂F + h' (N⊗cof + cof⊗N) + h'' I2 cof⊗cof + h' I2 ∂cof/∂F.

use super::isochoric::Isochoric;
use super::isotropic::projected_derivative_from;
use super::{Law, NamedLaw, OfInvariants};
use crate::number::{Number, constant};
use crate::svd::svd;
use crate::tensor::{Tensor, Tensor4, cofactor, dot, from_fn, half, plus_identity, product, trace, transpose};

/// Moduli, Pa. Small strain: μ = 2 (C10 + C01), which must be positive, bulk modulus 2D.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MooneyRivlin<T> {
    /// Of the first invariant.
    pub C10: T,
    /// Of the second invariant.
    pub C01: T,
    /// Volume.
    pub D: T,
}

/// cof F − 1 = tr G 1 − Gᵀ + cof G
#[inline(always)]
fn cofactor_change<T: Number>(G: &Tensor<T>) -> Tensor<T> {
    let cof = cofactor(G);
    from_fn(
        #[inline(always)]
        |i, j| {
            let (k, l) = ((i + 1) % 3, (i + 2) % 3);
            if i == j { G[k][k] + G[l][l] + cof[i][i] } else { cof[i][j] - G[j][i] }
        },
    )
}

/// A × B, symmetric in A and B, with cof(A + B) = cof A + A × B + cof B.
#[inline(always)]
fn cross<T: Number>(A: &Tensor<T>, B: &Tensor<T>) -> Tensor<T> {
    from_fn(
        #[inline(always)]
        |i, j| {
            let (k, l, m, n) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
            A[k][m] * B[l][n] - A[k][n] * B[l][m] + A[l][n] * B[k][m] - A[l][m] * B[k][n]
        },
    )
}

impl<T: Number> MooneyRivlin<T> {
    /// All terms of the derivative that have this form, C01 h and C01 h'.
    #[inline(always)]
    fn invariants_and_slopes(&self, G: &Tensor<T>) -> (OfInvariants<T>, T, T) {
        let at = Isochoric::new(G);
        let mut terms = at.terms(G, self.C10, self.D);
        let (I2, over_J, squared) = (dot(&terms.cof, &terms.cof), T::one() / at.J, at.y * at.y);
        let h = self.C01 * squared * squared;
        let h1 = constant::<T>(-4.0 / 3.0) * h * over_J;
        terms.b += h1 * I2;
        terms.r += constant::<T>(-7.0 / 3.0) * h1 * over_J * I2;
        (terms, h, h1)
    }
}

impl<T: Number> Law<T> for MooneyRivlin<T> {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        let (at, at_cof) = (Isochoric::new(G), Isochoric::new(&cofactor_change(G)));
        at.allowed(self.C10 * at.excess() + self.C01 * at_cof.excess() + self.D * at.j * at.j)
    }

    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        let (at, A) = (Isochoric::new(G), cofactor_change(G));
        let P = at.stress(G, self.C10, constant::<T>(2.0) * self.D * at.j);
        let of_second = cross(&Isochoric::new(&A).stress(&A, self.C01, T::zero()), &plus_identity(G));
        from_fn(
            #[inline(always)]
            |i, j| P[i][j] + of_second[i][j],
        )
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let (terms, h, h1) = self.invariants_and_slopes(G);
        let (F, cof, two) = (&terms.F, &terms.cof, constant::<T>(2.0));
        let (right, left) = (product(&transpose(F), F), product(F, &transpose(F)));
        let (I, FC) = (trace(&right), product(F, &right));
        let N = from_fn(
            #[inline(always)]
            |i, j| two * (I * F[i][j] - FC[i][j]),
        );
        let mut H = terms.derivative();
        for row in 0..9 {
            for column in 0..9 {
                let (i, j, k, l) = (row / 3, row % 3, column / 3, column % 3);
                let mut entry = two * F[i][j] * F[k][l] - F[i][l] * F[k][j];
                if i == k {
                    entry -= right[j][l];
                }
                if j == l {
                    entry += if i == k { I - left[i][k] } else { -left[i][k] };
                }
                H[row][column] += two * h * entry + h1 * (N[i][j] * cof[k][l] + cof[i][j] * N[k][l]);
            }
        }
        H
    }

    /// Requires J > 0. Of I2 = Σ σ_i² σ_j², the ratios of `isotropic.rs` are 2 (σ_k² ± σ_i σ_j).
    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let (terms, h, h1) = self.invariants_and_slopes(G);
        let F = svd(&terms.F);
        let (sigma, two_h) = (&F.sigma, constant::<T>(2.0) * h);
        let mut principal = terms.principal(sigma);
        let (mut n, mut cof, mut others) = ([T::zero(); 3], [T::zero(); 3], [T::zero(); 3]);
        for k in 0..3 {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            cof[k] = sigma[i] * sigma[j];
            others[k] = sigma[i] * sigma[i] + sigma[j] * sigma[j];
            n[k] = constant::<T>(2.0) * sigma[k] * others[k];
            principal.twist[k] += two_h * (sigma[k] * sigma[k] + cof[k]);
            principal.flip[k] += two_h * (sigma[k] * sigma[k] - cof[k]);
        }
        for i in 0..3 {
            for j in 0..3 {
                let second = if i == j { others[i] } else { constant::<T>(2.0) * sigma[i] * sigma[j] };
                principal.scaling[i][j] += two_h * second + h1 * (n[i] * cof[j] + cof[i] * n[j]);
            }
        }
        projected_derivative_from(&F, &principal)
    }
}

impl<T: Number> NamedLaw<T> for MooneyRivlin<T> {
    const NAME: &'static str = "mooney_rivlin";
    const ALLOWS_INVERSION: bool = false;

    fn of(material: &fem_model::Material) -> Option<Self> {
        let fem_model::Law::MooneyRivlin { C10, C01, D } = material.law else { return None };
        Some(Self { C10: constant(C10), C01: constant(C01), D: constant(D) })
    }

    fn moduli(&self) -> [T; 2] {
        let two = constant::<T>(2.0);
        [two * (self.C10 + self.C01), two * self.D]
    }

    fn with_bulk_modulus(self, bulk: T) -> Option<Self> {
        Some(Self { D: half::<T>() * bulk, ..self })
    }
}
