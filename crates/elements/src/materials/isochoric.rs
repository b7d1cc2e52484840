//! Ī = J^(−2/3) tr(FᵀF), J = det F, with its derivatives: the invariant that a change of volume alone leaves at 3, the first
//! of laws of rubber. Near rest no term of first order cancels.
//!
//! With I = tr(FᵀF), g = J^(−2/3), cof = ∂J/∂F, i = I − 3, j = J − 1 and g − 1 = −j w, w = 2/3 + O(j):
//! ∂Ī/∂F = 2g F + I g' cof, ∂²Ī/∂F² = 2g 1 + 2g' (F⊗cof + cof⊗F) + I g'' cof⊗cof + I g' ∂cof/∂F.

use super::OfInvariants;
use crate::number::{Number, constant, inverse_cube_root};
use crate::tensor::{Tensor, cofactor, dot, from_fn, plus_identity, trace, volume_change};

/// J and the terms of Ī and its first derivative.
#[derive(Clone, Copy)]
pub(super) struct Isochoric<T> {
    /// J
    pub J: T,
    /// J − 1
    pub j: T,
    /// tr cof G + det G
    second_order: T,
    /// y = J^(−1/3)
    pub y: T,
    /// y² + y + 1
    sum: T,
    /// 1/(J (y² + y + 1))
    inverse: T,
    /// tr G
    trace: T,
    /// G:G
    squares: T,
}

impl<T: Number> Isochoric<T> {
    #[inline(always)]
    pub fn new(G: &Tensor<T>) -> Self {
        let (j, second_order) = volume_change(G);
        let J = T::one() + j;
        let y = inverse_cube_root(J);
        let sum = y.times_plus(y, y + T::one());
        let inverse = T::one() / (J * sum);
        Self { J, j, second_order, y, sum, inverse, trace: trace(G), squares: dot(G, G) }
    }

    /// The energy density if J > 0, else infinity. Without this check an inverted element would have a finite energy.
    #[inline(always)]
    pub fn allowed(&self, energy: T) -> T {
        energy.select(self.J.gt(T::zero()), constant(f64::INFINITY))
    }

    /// I − 3
    #[inline(always)]
    fn i(&self) -> T {
        constant::<T>(2.0) * self.trace + self.squares
    }

    #[inline(always)]
    fn w(&self) -> T {
        (self.y + T::one()) * self.inverse
    }

    /// Ī − 3 = G:G − 2 (tr cof G + det G) − 3j (w − 2/3) − j w i
    #[inline(always)]
    pub fn excess(&self) -> T {
        let (two, three) = (constant::<T>(2.0), constant::<T>(3.0));
        let Self { J, j, inverse, .. } = *self;
        let e = -j * inverse;
        let third = constant::<T>(1.0 / 3.0);
        let w_change = (three * e - constant::<T>(6.0) * (j + J * e) - two * J * e * e) * (third * inverse);
        self.squares - two * self.second_order - three * j * w_change - j * self.w() * self.i()
    }

    /// a ∂Ī/∂F + p cof, written as 2a (g − 1) F + (2a/3 (3J − I g)/J + p) cof + 2a (F − cof), where
    /// 3J − I g = 3j − i + I j w and F − cof = G + Gᵀ − tr G 1 − cof G.
    #[inline(always)]
    pub fn stress(&self, G: &Tensor<T>, a: T, p: T) -> Tensor<T> {
        let (two, three) = (constant::<T>(2.0), constant::<T>(3.0));
        let j = self.j;
        let over_3J = constant::<T>(1.0 / 3.0) * self.sum * self.inverse;
        let (i, w, two_a) = (self.i(), self.w(), two * a);
        let of_F = -two_a * j * w;
        let of_cof = two_a * (three * j - i + (three + i) * j * w) * over_3J + p;
        let F = plus_identity(G);
        let (cof, cof_G) = (cofactor(&F), cofactor(G));
        let mut P = from_fn(
            #[inline(always)]
            |r, c| of_F.times_plus(F[r][c], of_cof.times_plus(cof[r][c], two_a * (G[r][c] + G[c][r] - cof_G[r][c]))),
        );
        for r in 0..3 {
            P[r][r] -= two_a * self.trace;
        }
        P
    }

    /// Terms of the derivative of a ∂Ī/∂F + 2D j cof for constant a.
    #[inline(always)]
    pub fn terms(&self, G: &Tensor<T>, a: T, D: T) -> OfInvariants<T> {
        let (g, over_J) = (self.y * self.y, self.sum * self.inverse);
        let F = plus_identity(G);
        let aI = a * dot(&F, &F);
        let g1 = constant::<T>(-2.0 / 3.0) * g * over_J;
        let g2 = constant::<T>(-5.0 / 3.0) * g1 * over_J;
        let two = constant::<T>(2.0);
        OfInvariants {
            cof: cofactor(&F),
            F,
            a: two * a * g,
            b: aI * g1 + two * D * self.j,
            s: T::zero(),
            t: two * a * g1,
            r: aI * g2 + two * D,
        }
    }

    /// Those of the derivative of f'(Ī − 3) ∂Ī/∂F + 2D j cof, given f' and f'': with ∂Ī/∂F = p F + q cof the products of its terms too.
    #[inline(always)]
    pub fn terms_of(&self, G: &Tensor<T>, [slope, curvature]: [T; 2], D: T) -> OfInvariants<T> {
        let mut terms = self.terms(G, slope, D);
        let p = constant::<T>(2.0) * self.y * self.y;
        let q = constant::<T>(-1.0 / 3.0) * p * dot(&terms.F, &terms.F) / self.J;
        terms.s += curvature * p * p;
        terms.t += curvature * p * q;
        terms.r += curvature * q * q;
        terms
    }
}
