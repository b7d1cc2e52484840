//! Constitutive laws, one file each: energy, stress and stress derivative side by side, and the facts about the law.
//!
//! A law takes the displacement gradient G = F − 1, because energies computed from F cancel near rest: at strain 1e-7
//! they would lose all their digits. Stresses are first Piola–Kirchhoff, derivatives are ∂P/∂F, flattened row by row.
//! [`AnyLaw`] is one of the laws, chosen at run time.

mod any;
mod cauchy;
mod corotated;
mod gent;
mod hencky;
mod invariants;
mod isochoric;
mod isotropic;
mod kelvin_voigt;
mod linear;
mod logarithmic;
mod mooney_rivlin;
mod neo_hookean;
mod ogden;
mod plane_corotated;
mod quadratic_form;
mod st_venant_kirchhoff;
mod stable_neo_hookean;
mod stretches;
mod vectorized;
mod yeoh;

pub use cauchy::{cauchy_stress, in_plane_stress};
pub use invariants::OfInvariants;
pub use kelvin_voigt::KelvinVoigt;
pub use plane_corotated::PlaneCorotated;
pub use quadratic_form::QuadraticForm;
pub use vectorized::Vectorized;

use crate::number::Number;
use crate::tensor::{Tensor, Tensor4, contracted};
use any::laws;
pub(crate) use any::{match_inlined_law, with_inlined_law};
pub use corotated::OfRotation;
pub(crate) use isotropic::{derivative_from, derivative_in_basis, projected_derivative_from};
pub(crate) use logarithmic::{Kirchhoff, Logarithmic};
pub(crate) use stretches::{stretches, stretches_in_plane};

/// Hands the list of all laws, each as `file::Law`, to another macro: first those for which the loops over tetrahedra are compiled, then
/// those that they call by reference. A law of the first kind costs the build three kernels for each number type and instruction set,
/// and saves a tenth to a quarter of the time of its forces and stiffness.
macro_rules! law_list {
    ($callback:ident $arguments:tt) => {
        $callback! { $arguments
            inlined {
                linear::Linear,
                corotated::Corotated,
                st_venant_kirchhoff::StVenantKirchhoff,
                neo_hookean::NeoHookean,
                stable_neo_hookean::StableNeoHookean,
            }
            by_reference {
                hencky::Hencky,
                mooney_rivlin::MooneyRivlin,
                yeoh::Yeoh,
                gent::Gent,
                ogden::Ogden,
            }
        }
    };
}
pub(crate) use law_list;

law_list! { laws () }

/// A constitutive law, for one element or for a batch of them. The loops that take most of a step's time are compiled for the laws that
/// are used most (`with_inlined_law`); all others call it by reference, once per batch.
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

    /// The terms of [`derivative`](Self::derivative) where they are far fewer numbers than its 81 entries.
    #[inline(always)]
    fn terms(&self, _G: &Tensor<T>) -> Terms<T> {
        Terms::Entries
    }

    /// `∂P/∂F : Ḟ` for a rate Ḟ of F.
    #[inline(always)]
    fn derivative_times(&self, G: &Tensor<T>, rate: &Tensor<T>) -> Tensor<T> {
        contracted(&self.derivative(G), rate)
    }

    /// `∂P/∂F` with its negative eigenvalues raised to zero, Pa: the positive semi-definite projection.
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T>;
}

/// The terms of ∂P/∂F.
pub enum Terms<T> {
    /// Those of a law that has no invariants but tr(FᵀF) and det F.
    Invariants(OfInvariants<T>),
    /// Those of a law of the rotation nearest to F, where it is well-conditioned.
    Rotation(OfRotation<T>),
    /// No terms but all entries of [`Law::derivative`].
    Entries,
}

/// A law that scene files name, with the properties that methods need.
pub trait NamedLaw<T: Number>: Law<T> + Copy {
    /// The name in scene files.
    const NAME: &'static str;

    /// True if the stress is a linear function of the displacement gradient.
    const IS_LINEAR: bool = false;

    /// True if the energy is finite for J = det F ≤ 0 too. If not, a step must keep J > 0 in every element.
    const ALLOWS_INVERSION: bool = true;

    /// The law with its parameters; `None` if the material has another law.
    fn of(material: &fem_model::Material) -> Option<Self>;

    /// Shear modulus and bulk modulus of small strain, Pa.
    fn moduli(&self) -> [T; 2];

    /// The law with another bulk modulus, Pa; `None` if it is not the sum of an energy of the volume and of one that does not depend on it.
    fn with_bulk_modulus(self, _bulk: T) -> Option<Self> {
        None
    }
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
    fn terms(&self, G: &Tensor<T>) -> Terms<T> {
        (**self).terms(G)
    }

    #[inline(always)]
    fn derivative_times(&self, G: &Tensor<T>, rate: &Tensor<T>) -> Tensor<T> {
        (**self).derivative_times(G, rate)
    }

    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        (**self).projected_derivative(G)
    }
}
