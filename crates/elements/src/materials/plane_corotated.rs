//! ψ = μ ‖F − R‖² + λ/2 (tr(RᵀF) − 2)²: the corotated law of a flat body, with the rotation in closed form.
//!
//! Within the plane the rotation nearest to F turns by the angle θ = atan2(F_21 − F_12, F_11 + F_22), and tr(RᵀF) is
//! r = √((F_11 + F_22)² + (F_21 − F_12)²): Higham, Functions of Matrices (2008), §8; ∂θ/∂F = T/r with T = ∂R/∂θ. So
//! P = 2μ (F − R) + λ (r − 2) R and ∂P/∂F = 2μ 1 + λ R⊗R + ((λ (r − 2) − 2μ)/r) T⊗T, of which the last term alone may be negative.
//!
//! An inverted triangle is turned back within the plane. The law in space would turn it about an axis of the plane if it is stretched in both
//! directions, because its smallest stretch is that across the plane.

use super::{AnyLaw, Law};
use crate::number::{Float, Number, constant};
use crate::polar::PlaneRotation;
use crate::tensor::{Tensor, Tensor4, half, zero};

/// Lamé's constants of small strain, Pa. Displacement gradients have zeros in the third row and column; derivatives are those within
/// the plane, with zeros elsewhere.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct PlaneCorotated<T> {
    /// Shear modulus μ.
    pub mu: T,
    /// λ; that of plane stress for a body in plane stress.
    pub lambda: T,
}

impl<T: Number> PlaneCorotated<T> {
    #[inline(always)]
    fn energy_of(&self, R: &PlaneRotation<T>, D: &[[T; 2]; 2]) -> T {
        let squares = D[0][0] * D[0][0] + D[0][1] * D[0][1] + D[1][0] * D[1][0] + D[1][1] * D[1][1];
        self.mu * squares + half::<T>() * self.lambda * R.strain * R.strain
    }

    #[inline(always)]
    fn stress_of(&self, R: &PlaneRotation<T>, D: &[[T; 2]; 2]) -> Tensor<T> {
        let two_mu = constant::<T>(2.0) * self.mu;
        let pressure = self.lambda * R.strain;
        let (along, across) = (pressure * R.cos, pressure * R.sin);
        let mut P = zero();
        P[0][0] = two_mu * D[0][0] + along;
        P[0][1] = two_mu * D[0][1] - across;
        P[1][0] = two_mu * D[1][0] + across;
        P[1][1] = two_mu * D[1][1] + along;
        P[2][2] = pressure;
        P
    }

    /// The factor of T⊗T. Where r = 0 the derivative is not finite; beside it, it is cut off.
    #[inline(always)]
    fn of_rotation(&self, R: &PlaneRotation<T>) -> T {
        let floor = constant::<T>(Float::as_f64(<T::Element as Float>::EPSILON).sqrt());
        (self.lambda * R.strain - constant::<T>(2.0) * self.mu) / R.trace.max(floor)
    }

    /// 2μ 1 + λ R⊗R + `of_rotation` T⊗T
    #[inline(always)]
    fn derivative_of(&self, R: &PlaneRotation<T>, of_rotation: T) -> Tensor4<T> {
        let (c, s) = (R.cos, R.sin);
        let (rotation, turned) = ([c, -s, s, c], [-s, -c, c, -s]);
        let mut H = [[T::zero(); 9]; 9];
        for (i, row) in IN_PLANE.into_iter().enumerate() {
            for (j, column) in IN_PLANE.into_iter().enumerate() {
                H[row][column] = self.lambda * rotation[i] * rotation[j] + of_rotation * turned[i] * turned[j];
            }
            H[row][row] += constant::<T>(2.0) * self.mu;
        }
        H
    }
}

/// The entries of a flattened tensor within the plane.
const IN_PLANE: [usize; 4] = [0, 1, 3, 4];

/// F − R within the plane.
#[inline(always)]
fn difference<T: Number>(G: &Tensor<T>, R: &PlaneRotation<T>) -> [[T; 2]; 2] {
    [[G[0][0] - R.cos_minus_1, G[0][1] + R.sin], [G[1][0] - R.sin, G[1][1] - R.cos_minus_1]]
}

impl<T: Number> Law<T> for PlaneCorotated<T> {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        let R = PlaneRotation::of(G);
        self.energy_of(&R, &difference(G, &R))
    }

    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        let R = PlaneRotation::of(G);
        self.stress_of(&R, &difference(G, &R))
    }

    #[inline(always)]
    fn energy_and_stress(&self, G: &Tensor<T>) -> (T, Tensor<T>) {
        let R = PlaneRotation::of(G);
        let D = difference(G, &R);
        (self.energy_of(&R, &D), self.stress_of(&R, &D))
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let R = PlaneRotation::of(G);
        self.derivative_of(&R, self.of_rotation(&R))
    }

    /// T⊗T has the norm 2, so that its eigenvalue is zero where its factor is −μ; that of R⊗R is 2 (μ + λ) > 0.
    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let R = PlaneRotation::of(G);
        self.derivative_of(&R, self.of_rotation(&R).max(-self.mu))
    }
}

impl<T: Number> AnyLaw<T> {
    /// The same law for flat bodies where it has a form of its own.
    pub fn in_plane(&self) -> Option<PlaneCorotated<T>> {
        match self {
            Self::Corotated(law) => Some(PlaneCorotated { mu: law.mu, lambda: law.lambda }),
            _ => None,
        }
    }
}
