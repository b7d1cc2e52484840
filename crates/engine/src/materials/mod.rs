//! Constitutive laws, one file each: energy, stress and stress derivative side by side, and the facts about the law.
//!
//! A law takes the displacement gradient G = F − 1, because energies computed from F cancel near rest: at strain 1e-7
//! they would lose all their digits. Stresses are first Piola–Kirchhoff, derivatives are ∂P/∂F, flattened row by row.
//! [`AnyLaw`] is one of the laws, chosen by a scene.

mod any;
mod cauchy;
mod corotated;
mod hencky;
mod invariants;
mod isochoric;
mod isotropic;
mod linear;
mod logarithmic;
mod mooney_rivlin;
mod neo_hookean;
mod plane_corotated;
mod quadratic_form;
mod st_venant_kirchhoff;
mod stable_neo_hookean;
#[cfg(test)]
mod tests;
mod vectorized;
mod yeoh;

pub use cauchy::{cauchy_stress, plane_cauchy_stress, pushed_forward};
pub use invariants::OfInvariants;
pub use plane_corotated::PlaneCorotated;
pub use quadratic_form::QuadraticForm;
pub use vectorized::Vectorized;

use crate::number::Number;
use crate::tensor::{Tensor, Tensor4};
use any::laws;
pub(crate) use any::{match_law, with_law};
pub use corotated::OfRotation;
pub(crate) use corotated::{stretches, stretches_in_plane};
pub(crate) use isotropic::{derivative_from, derivative_in_basis, projected_derivative_from};
pub(crate) use logarithmic::{Kirchhoff, Logarithmic};

/// Hands the list of all laws, each as `file::Law`, to another macro.
macro_rules! law_list {
    ($callback:ident $arguments:tt) => {
        $callback! { $arguments
            linear::Linear,
            corotated::Corotated,
            st_venant_kirchhoff::StVenantKirchhoff,
            neo_hookean::NeoHookean,
            stable_neo_hookean::StableNeoHookean,
            hencky::Hencky,
            mooney_rivlin::MooneyRivlin,
            yeoh::Yeoh,
        }
    };
}
pub(crate) use law_list;

law_list! { laws () }

/// A constitutive law, for one element or for a batch of them. The loops that take most of a step's time are compiled for each law
/// (`with_law`); the others call it by reference, once per batch.
pub trait Law<T: Number>: Send + Sync {
    /// `ψ(G)` energy density, J/m³; zero at rest, not finite where the law does not allow the deformation.
    fn energy(&self, G: &Tensor<T>) -> T;

    /// `P(G) = ∂ψ/∂F`, Pa.
    fn stress(&self, G: &Tensor<T>) -> Tensor<T>;

    /// Energy density and stress in one call. The compiler shares their common terms, apart from calls that it does not inline.
    #[inline(always)]
    fn energy_and_stress(&self, G: &Tensor<T>) -> (T, Tensor<T>) {
        (self.energy(G), self.stress(G))
    }

    /// `∂P/∂F`, Pa, exact and symmetric.
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T>;

    /// The terms of [`derivative`](Self::derivative), if the law has no invariants but tr(FᵀF) and det F: far fewer
    /// numbers than its 81 entries.
    fn of_invariants(&self, _G: &Tensor<T>) -> Option<OfInvariants<T>> {
        None
    }

    /// The terms of [`derivative`](Self::derivative) of a law of the rotation nearest to F, where it is well-conditioned.
    fn of_rotation(&self, _G: &Tensor<T>) -> Option<OfRotation<T>> {
        None
    }

    /// `∂P/∂F` with its negative eigenvalues raised to zero, Pa: the positive semi-definite projection.
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T>;
}

/// A law that scene files name, and the facts that methods ask for.
pub trait NamedLaw<T: Number>: Law<T> + Copy {
    /// The name in scene files.
    const NAME: &'static str;

    /// Whether the stress is a linear function of the displacement gradient.
    const IS_LINEAR: bool = false;

    /// Whether the energy is finite for J = det F ≤ 0 too. If it is not, a step must keep J > 0 in every element.
    const ALLOWS_INVERSION: bool = true;

    /// The law with a scene's parameters; `None` if the table lacks them, as a checked table never does.
    fn from_scene(table: &fem_scene::Material) -> Option<Self>;

    /// Shear modulus and bulk modulus of small strain, Pa.
    fn moduli(&self) -> [T; 2];
}

impl<T: Number, L: Law<T> + ?Sized> Law<T> for &L {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        (**self).energy(G)
    }

    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        (**self).stress(G)
    }

    #[inline(always)]
    fn energy_and_stress(&self, G: &Tensor<T>) -> (T, Tensor<T>) {
        (**self).energy_and_stress(G)
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        (**self).derivative(G)
    }

    #[inline(always)]
    fn of_invariants(&self, G: &Tensor<T>) -> Option<OfInvariants<T>> {
        (**self).of_invariants(G)
    }

    #[inline(always)]
    fn of_rotation(&self, G: &Tensor<T>) -> Option<OfRotation<T>> {
        (**self).of_rotation(G)
    }

    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        (**self).projected_derivative(G)
    }
}

/// A law whose derivative is the positive semi-definite projection of another's; likewise for the laws of several batches.
#[derive(Clone, Copy)]
pub struct Projected<L>(pub L);

impl<T: Number, L: Law<T>> Law<T> for Projected<L> {
    fn energy(&self, G: &Tensor<T>) -> T {
        self.0.energy(G)
    }

    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        self.0.stress(G)
    }

    fn energy_and_stress(&self, G: &Tensor<T>) -> (T, Tensor<T>) {
        self.0.energy_and_stress(G)
    }

    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.0.projected_derivative(G)
    }

    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.0.projected_derivative(G)
    }
}
