//! The stress derivative of a law of the invariants I = tr(FᵀF) and J = det F.

use super::isotropic::{from_invariants, projected_derivative_from};
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
    pub fn projected_derivative(&self) -> Tensor4<T> {
        let F = svd(&self.F);
        projected_derivative_from(&F, &from_invariants(&F.sigma, self.a, self.b, [self.s, self.t, self.r]))
    }
}
