//! The stress derivative of a law of the invariants I = tr(FᵀF) and J = det F.

use super::isotropic::{Principal, projected_derivative_from};
use crate::number::Number;
use crate::svd::svd;
use crate::tensor::{Tensor, Tensor4, add_cofactor_derivative, add_diagonal, outer_products};

/// P = a F + b cof and ∂P/∂F = a 1 + s F⊗F + t (F⊗cof + cof⊗F) + r cof⊗cof + b ∂cof/∂F, where cof = ∂J/∂F.
#[derive(Clone, Copy, Debug)]
#[allow(missing_docs)] // the names are those of the formula
pub struct OfInvariants<T> {
    pub F: Tensor<T>,
    pub cof: Tensor<T>,
    pub a: T,
    pub b: T,
    pub s: T,
    pub t: T,
    pub r: T,
}

impl<T: Number> OfInvariants<T> {
    /// ∂P/∂F, entry by entry.
    #[inline(always)]
    pub fn derivative(&self) -> Tensor4<T> {
        let mut H = outer_products(self.s, self.t, self.r, &self.F, &self.cof);
        add_diagonal(&mut H, self.a);
        add_cofactor_derivative(&mut H, self.b, &self.F);
        H
    }

    /// ∂P/∂F with its negative eigenvalues raised to zero.
    #[inline(always)]
    pub fn projected_derivative(&self) -> Tensor4<T> {
        let F = svd(&self.F);
        projected_derivative_from(&F, &self.principal(&F.sigma))
    }

    /// ∂P/∂F in the basis of the principal stretches.
    #[inline(always)]
    pub(super) fn principal(&self, sigma: &[T; 3]) -> Principal<T> {
        let Self { a, b, s, t, r, .. } = *self;
        let cof = [sigma[1] * sigma[2], sigma[2] * sigma[0], sigma[0] * sigma[1]];
        let mut principal = Principal::zero();
        for i in 0..3 {
            principal.twist[i] = a + b * sigma[i];
            principal.flip[i] = a - b * sigma[i];
            for j in 0..3 {
                let other = if i == j { a } else { b * sigma[3 - i - j] };
                principal.scaling[i][j] =
                    s * sigma[i] * sigma[j] + t * (sigma[i] * cof[j] + cof[i] * sigma[j]) + r * cof[i] * cof[j] + other;
            }
        }
        principal
    }
}
