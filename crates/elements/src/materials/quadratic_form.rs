//! ψ = k/2 G:G, the metric of projective dynamics: no material, but the quadratic form whose Hessian is a Laplacian.

use super::Law;
use crate::number::Number;
use crate::tensor::{Tensor, Tensor4, add_diagonal, dot, half, map};

/// The form with this k, Pa.
#[derive(Clone, Copy, Debug)]
pub struct QuadraticForm<T>(pub T);

impl<T: Number> Law<T> for QuadraticForm<T> {
    fn energy(&self, G: &Tensor<T>) -> T {
        half::<T>() * self.0 * dot(G, G)
    }

    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        map(
            G,
            #[inline(always)]
            |entry| self.0 * entry,
        )
    }

    fn derivative(&self, _: &Tensor<T>) -> Tensor4<T> {
        let mut H = [[T::zero(); 9]; 9];
        add_diagonal(&mut H, self.0);
        H
    }

    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.derivative(G)
    }
}
