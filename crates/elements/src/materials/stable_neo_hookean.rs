//! ψ = μ'/2 (I − 3) + λ'/2 (J − α)² − μ'/2 ln(I + 1) + constant, I = tr(FᵀF): stable neo-Hookean.
//!
//! Smith, de Goes and Kim, Stable Neo-Hookean Flesh Simulation (2018), eq. 14, with α = 1 + 3μ'/(4λ'), so that the rest
//! state is free of stress, and (§3.4) μ' = 4μ/3, λ' = λ + 5μ/6, where μ and λ are Lamé's constants of small strain. The constant makes
//! the energy zero at rest. The energy is finite and smooth for every F, flat and inverted elements included.
//!
//! With i = I − 3 and j = J − 1, P = a F + b cof, a = μ' I/(I + 1), b = λ' j − μ, and
//! ∂P/∂F = a 1 + 2μ'/(I + 1)² F⊗F + λ' cof⊗cof + b ∂cof/∂F.

use super::{Law, NamedLaw, OfInvariants, Terms};
use crate::number::{Number, constant, minus_ln_1p};
use crate::tensor::{Tensor, Tensor4, cofactor, dot, from_fn, half, plus_identity, trace, volume_change};

/// Lamé's constants of small strain, Pa: μ and λ of the formulas above, not μ' and λ'.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StableNeoHookean<T> {
    /// Shear modulus μ.
    pub mu: T,
    /// λ
    pub lambda: T,
}

impl<T: Number> StableNeoHookean<T> {
    /// λ'
    #[inline(always)]
    fn lambda_prime(&self) -> T {
        self.lambda + constant::<T>(5.0 / 6.0) * self.mu
    }

    #[inline(always)]
    fn of_invariants(&self, G: &Tensor<T>) -> OfInvariants<T> {
        let (j, _) = volume_change(G);
        let F = plus_identity(G);
        let I = dot(&F, &F);
        let mu_prime = constant::<T>(4.0 / 3.0) * self.mu;
        let inverse = T::one() / (I + T::one());
        let lambda_prime = self.lambda_prime();
        OfInvariants {
            cof: cofactor(&F),
            F,
            a: mu_prime * I * inverse,
            b: lambda_prime * j - self.mu,
            s: constant::<T>(2.0) * mu_prime * inverse * inverse,
            t: T::zero(),
            r: lambda_prime,
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

    /// Likewise without cancellation: P = μ i/(3 (I + 1)) F + λ' j cof + μ (F − cof), F − cof = G + Gᵀ − tr G 1 − cof G.
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
            |r, c| of_F.times_plus(F[r][c], of_cof.times_plus(cof[r][c], self.mu * (G[r][c] + G[c][r] - cof_G[r][c]))),
        );
        for r in 0..3 {
            P[r][r] -= self.mu * trace_G;
        }
        P
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.of_invariants(G).derivative()
    }

    #[inline(always)]
    fn terms(&self, G: &Tensor<T>) -> Terms<T> {
        Terms::Invariants(self.of_invariants(G))
    }

    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.of_invariants(G).projected_derivative()
    }
}

impl<T: Number> NamedLaw<T> for StableNeoHookean<T> {
    const NAME: &'static str = "stable_neo_hookean";

    fn of(material: &fem_model::Material) -> Option<Self> {
        let fem_model::Law::StableNeoHookean(elastic) = material.law else { return None };
        let [mu, lambda] = elastic.lame(material.plane).map(constant);
        Some(Self { mu, lambda })
    }

    fn moduli(&self) -> [T; 2] {
        [self.mu, self.lambda + constant::<T>(2.0 / 3.0) * self.mu]
    }
}
