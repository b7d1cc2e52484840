//! ψ = C (J^(−2/3) tr(FᵀF) − 3) + D (J − 1)²: compressible neo-Hookean, Ogden, Non-Linear Elastic Deformations (1984), ch. 7.
//!
//! With g = J^(−2/3), I = tr(FᵀF) and cof = ∂J/∂F:
//! P = a F + b cof, a = 2Cg, b = C I g' + 2D (J − 1), and
//! ∂P/∂F = a 1 + 2Cg' (F⊗cof + cof⊗F) + (C I g'' + 2D) cof⊗cof + b ∂cof/∂F.

use super::{Law, NamedLaw, OfInvariants};
use crate::number::{Number, constant, inverse_cube_root};
use crate::tensor::{Tensor, Tensor4, cofactor, dot, from_fn, plus_identity, trace, volume_change};

/// Moduli, Pa. Small strain: μ = 2C, bulk modulus 2D.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NeoHookean<T> {
    /// Shear.
    pub C: T,
    /// Volume.
    pub D: T,
}

impl<T: Number> NeoHookean<T> {
    #[inline(always)]
    fn terms(&self, G: &Tensor<T>) -> OfInvariants<T> {
        let (j, _) = volume_change(G);
        let J = T::one() + j;
        let y = inverse_cube_root(J);
        let (g, over_J) = (y * y, T::one() / J);
        let F = plus_identity(G);
        let CI = self.C * dot(&F, &F);
        let g1 = constant::<T>(-2.0 / 3.0) * g * over_J;
        let g2 = constant::<T>(-5.0 / 3.0) * g1 * over_J;
        let two = constant::<T>(2.0);
        OfInvariants {
            cof: cofactor(&F),
            F,
            a: two * self.C * g,
            b: CI * g1 + two * self.D * j,
            s: T::zero(),
            t: two * self.C * g1,
            r: CI * g2 + two * self.D,
        }
    }
}

/// w = (1 − g)/(J − 1), from J and its power −1/3.
#[inline(always)]
fn power_slope<T: Number>(J: T, y: T) -> T {
    (y + T::one()) / (J * (y * y + y + T::one()))
}

impl<T: Number> Law<T> for NeoHookean<T> {
    /// Written in terms of second order only, nothing of first order to cancel: with j = J − 1, i = I − 3 and
    /// g − 1 = −j w, w = 2/3 + O(j), ψ = C (G:G − 2 (tr cof G + det G) − 3j (w − 2/3) − j w i) + D j².
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        let (one, two, three) = (T::one(), constant::<T>(2.0), constant::<T>(3.0));
        let (j, second_order) = volume_change(G);
        let J = one + j;
        let y = inverse_cube_root(J);
        let denominator = J * (y * y + y + one);
        let w = power_slope(J, y);
        let e = -j / denominator;
        let w_change = (three * e - constant::<T>(6.0) * (j + J * e) - two * J * e * e) / (three * denominator);
        let squares = dot(G, G);
        let i = two * trace(G) + squares;
        let energy = self.C * (squares - two * second_order - three * j * w_change - j * w * i) + self.D * j * j;
        // Inside out, the formula would still give a number.
        energy.select(J.simd_gt(T::zero()), constant(f64::INFINITY))
    }

    /// Likewise without what cancels: P = 2C (g − 1) F + (2C/3 (3J − I g)/J + 2D j) cof + 2C (F − cof), where
    /// 3J − I g = 3j − i + I j w and F − cof = G + Gᵀ − tr G 1 − cof G.
    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        let (two, three) = (constant::<T>(2.0), constant::<T>(3.0));
        let (j, _) = volume_change(G);
        let J = T::one() + j;
        let w = power_slope(J, inverse_cube_root(J));
        let (F, trace_G) = (plus_identity(G), trace(G));
        let i = two * trace_G + dot(G, G);
        let two_C = two * self.C;
        let of_F = -two_C * j * w;
        let of_cof = two_C * (three * j - i + (three + i) * j * w) / (three * J) + two * self.D * j;
        let (cof, cof_G) = (cofactor(&F), cofactor(G));
        let mut P = from_fn(
            #[inline(always)]
            |r, c| of_F * F[r][c] + of_cof * cof[r][c] + two_C * (G[r][c] + G[c][r] - cof_G[r][c]),
        );
        for r in 0..3 {
            P[r][r] -= two_C * trace_G;
        }
        P
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.terms(G).derivative()
    }

    #[inline(always)]
    fn of_invariants(&self, G: &Tensor<T>) -> Option<OfInvariants<T>> {
        Some(self.terms(G))
    }

    /// For J > 0.
    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.terms(G).projected_derivative()
    }
}

impl<T: Number> NamedLaw<T> for NeoHookean<T> {
    const NAME: &'static str = "neo_hookean";
    const ALLOWS_INVERSION: bool = false;

    fn from_scene(table: &fem_scene::Material) -> Option<Self> {
        let (C, D) = table.neo_hookean()?;
        Some(Self { C: constant(C), D: constant(D) })
    }

    fn moduli(&self) -> [T; 2] {
        [self.C + self.C, self.D + self.D]
    }
}
