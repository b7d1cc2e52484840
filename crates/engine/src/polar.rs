//! The polar decomposition F = R S within the plane: the rotation R nearest to F, in closed form.

use crate::number::{Number, constant};
use crate::tensor::Tensor;

/// The rotation R of the plane nearest to a deformation gradient.
#[derive(Clone, Copy)]
pub(crate) struct PlaneRotation<T> {
    /// cos θ
    pub cos: T,
    /// sin θ
    pub sin: T,
    /// cos θ − 1 with the digits of a small angle.
    pub cos_minus_1: T,
    /// r = tr(RᵀF)
    pub trace: T,
    /// r − 2, with the digits of a small strain.
    pub strain: T,
}

impl<T: Number> PlaneRotation<T> {
    /// The rotation nearest to 1 + G; no rotation where all are as near, F_11 + F_22 = F_21 − F_12 = 0.
    #[inline(always)]
    pub fn of(G: &Tensor<T>) -> Self {
        let (one, two) = (T::one(), constant::<T>(2.0));
        let g = G[0][0] + G[1][1];
        let (a, b) = (two + g, G[1][0] - G[0][1]);
        let square = b * b;
        let trace = (a * a + square).simd_sqrt();
        let is_turned = trace.simd_gt(T::zero());
        let inverse = one / trace.select(is_turned, one);
        let cos = (a * inverse).select(is_turned, one);
        let sin = b * inverse;
        let of_small_angle = -square * inverse / (trace + a);
        let cos_minus_1 = of_small_angle.select(a.simd_gt(T::zero()), cos - one);
        let strain = (g * (constant::<T>(4.0) + g) + square) / (trace + two);
        Self { cos, sin, cos_minus_1, trace, strain }
    }
}
