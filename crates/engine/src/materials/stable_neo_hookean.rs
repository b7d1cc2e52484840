//! ψ = μ'/2 (I − 3) + λ'/2 (J − α)² − μ'/2 ln(I + 1) + constant, I = tr(FᵀF): stable neo-Hookean.
//!
//! Smith, de Goes and Kim, Stable Neo-Hookean Flesh Simulation (2018), eq. 14, with α = 1 + 3μ'/(4λ'), which frees the rest
//! state of stress, and (§3.4) μ' = 4μ/3, λ' = λ + 5μ/6, where μ and λ are Lamé's constants of small strain. The constant makes
//! the energy zero at rest. It is finite and smooth for every F, flattened and inside out too.
//!
//! With i = I − 3 and j = J − 1, P = a F + b cof, a = μ' I/(I + 1), b = λ' j − μ, and
//! ∂P/∂F = a 1 + 2μ'/(I + 1)² F⊗F + λ' cof⊗cof + b ∂cof/∂F.

use super::isotropic::{derivative_from, from_invariants, projected};
use super::{Law, Projected, singular};
use crate::number::{Number, constant, minus_ln_1p};
use crate::tensor::{
    Tensor, Tensor4, add_cofactor_derivative, add_diagonal, cofactor, dot, from_fn, half, outer_products,
    plus_identity, trace, volume_change,
};

/// Lamé's constants of small strain, Pa: μ and λ of the formulas above, not μ' and λ'.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StableNeoHookean<T> {
    /// Shear modulus μ.
    pub mu: T,
    /// λ
    pub lambda: T,
}

/// Factors in the derivative.
struct Terms<T> {
    a: T,
    b: T,
    /// 2μ'/(I + 1)²
    of_F: T,
    /// λ'
    of_cof: T,
}

impl<T: Number> StableNeoHookean<T> {
    /// λ'
    #[inline(always)]
    fn lambda_prime(&self) -> T {
        self.lambda + constant::<T>(5.0 / 6.0) * self.mu
    }

    #[inline(always)]
    fn terms(&self, G: &Tensor<T>) -> Terms<T> {
        let (j, _) = volume_change(G);
        let F = plus_identity(G);
        let I = dot(&F, &F);
        let mu_prime = constant::<T>(4.0 / 3.0) * self.mu;
        let inverse = T::one() / (I + T::one());
        let of_cof = self.lambda_prime();
        Terms {
            a: mu_prime * I * inverse,
            b: of_cof * j - self.mu,
            of_F: constant::<T>(2.0) * mu_prime * inverse * inverse,
            of_cof,
        }
    }
}

impl<T: Number> Law<T> for StableNeoHookean<T> {
    /// Written in terms of second order only: with x = i/4,
    /// ψ = μ/2 (G:G − 2 (tr cof G + det G)) + 2μ/3 (x − ln(1 + x)) + λ'/2 j².
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        let (j, second_order) = volume_change(G);
        let squares = dot(G, G);
        let x = half::<T>() * trace(G) + constant::<T>(0.25) * squares;
        self.mu * (half::<T>() * squares - second_order + constant::<T>(2.0 / 3.0) * minus_ln_1p(x))
            + half::<T>() * self.lambda_prime() * j * j
    }

    /// Likewise without what cancels: P = μ i/(3 (I + 1)) F + λ' j cof + μ (F − cof), F − cof = G + Gᵀ − tr G 1 − cof G.
    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        let (j, _) = volume_change(G);
        let (F, cof_G, trace_G) = (plus_identity(G), cofactor(G), trace(G));
        let i = constant::<T>(2.0) * trace_G + dot(G, G);
        let of_F = self.mu * i / (constant::<T>(3.0) * (i + constant(4.0)));
        let of_cof = self.lambda_prime() * j;
        let cof = cofactor(&F);
        let mut P = from_fn(
            #[inline(always)]
            |r, c| of_F * F[r][c] + of_cof * cof[r][c] + self.mu * (G[r][c] + G[c][r] - cof_G[r][c]),
        );
        for r in 0..3 {
            P[r][r] -= self.mu * trace_G;
        }
        P
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let (terms, F) = (self.terms(G), plus_identity(G));
        let mut H = outer_products(terms.of_F, T::zero(), terms.of_cof, &F, &cofactor(&F));
        add_diagonal(&mut H, terms.a);
        add_cofactor_derivative(&mut H, terms.b, &F);
        H
    }
}

impl<T: Number> Projected<T> for StableNeoHookean<T> {
    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let (terms, F) = (self.terms(G), singular(&plus_identity(G)));
        let principal = from_invariants(&F.sigma, terms.a, terms.b, [terms.of_F, T::zero(), terms.of_cof]);
        derivative_from(&F, &projected(&principal))
    }
}
