//! Constitutive laws, one file each: energy, stress and stress derivative side by side.
//!
//! A law is asked with the displacement gradient G = F − 1, because energies computed from F cancel near rest: at strain
//! 1e-7 nothing would be left of their digits. Stresses are first Piola–Kirchhoff, derivatives are ∂P/∂F, flattened row by row.
//! A [`Material`] is one of the laws, chosen by a scene.

mod cauchy;
mod corotated;
mod invariants;
mod isotropic;
mod linear;
mod material;
mod neo_hookean;
mod st_venant_kirchhoff;
mod stable_neo_hookean;
#[cfg(test)]
mod tests;

pub use cauchy::{cauchy_stress, von_mises};
pub use corotated::Corotated;
pub use invariants::OfInvariants;
pub use linear::Linear;
pub(crate) use material::with_law;
pub use material::{Material, allows_inversion};
pub use neo_hookean::NeoHookean;
pub use st_venant_kirchhoff::StVenantKirchhoff;
pub use stable_neo_hookean::StableNeoHookean;

use crate::number::Number;
use crate::tensor::{Tensor, Tensor4};

/// A constitutive law, for one element or for a batch of them.
pub trait Law<T: Number>: Copy + Send + Sync {
    /// `ψ(G)` energy density, J/m³; zero at rest, not finite where the law does not allow the deformation.
    fn energy(&self, G: &Tensor<T>) -> T;

    /// `P(G) = ∂ψ/∂F`, Pa.
    fn stress(&self, G: &Tensor<T>) -> Tensor<T>;

    /// `∂P/∂F`, Pa, exact and symmetric.
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T>;

    /// What the derivative is made of, where it is that of a law of invariants: much less than its 81 entries.
    #[inline(always)]
    fn of_invariants(&self, _G: &Tensor<T>) -> Option<OfInvariants<T>> {
        None
    }
}

/// A law whose derivative can be made positive semi-definite, element by element.
pub trait Projected<T: Number> {
    /// `∂P/∂F` with its negative eigenvalues raised to zero, Pa.
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T>;
}

/// A law whose derivative is the projected one.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Definite<L>(pub L);

impl<T: Number, L: Law<T> + Projected<T>> Law<T> for Definite<L> {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        self.0.energy(G)
    }

    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        self.0.stress(G)
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.0.projected_derivative(G)
    }
}
