//! ψ = C (Ī − 3) + D (J − 1)², Ī = J^(−2/3) tr(FᵀF): compressible neo-Hookean, Ogden, Non-Linear Elastic Deformations (1984),
//! ch. 7; Bonet and Wood, Nonlinear Continuum Mechanics for Finite Element Analysis (2008), §6.5.

use super::isochoric::Isochoric;
use super::{Law, NamedLaw, OfInvariants, Terms};
use crate::number::{Number, constant};
use crate::tensor::{Tensor, Tensor4, half};

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
    fn of_invariants(&self, G: &Tensor<T>) -> OfInvariants<T> {
        Isochoric::new(G).terms(G, self.C, self.D)
    }
}

impl<T: Number> Law<T> for NeoHookean<T> {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        let at = Isochoric::new(G);
        at.allowed(self.C * at.excess() + self.D * at.j * at.j)
    }

    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        let at = Isochoric::new(G);
        at.stress(G, self.C, constant::<T>(2.0) * self.D * at.j)
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.of_invariants(G).derivative()
    }

    #[inline(always)]
    fn terms(&self, G: &Tensor<T>) -> Terms<T> {
        Terms::Invariants(self.of_invariants(G))
    }

    /// Requires J > 0.
    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.of_invariants(G).projected_derivative()
    }
}

impl<T: Number> NamedLaw<T> for NeoHookean<T> {
    const NAME: &'static str = "neo_hookean";
    const ALLOWS_INVERSION: bool = false;

    fn of(material: &fem_model::Material) -> Option<Self> {
        let fem_model::Law::NeoHookean(law) = material.law else { return None };
        let [C, D] = law.moduli().map(constant);
        Some(Self { C, D })
    }

    fn moduli(&self) -> [T; 2] {
        [self.C + self.C, self.D + self.D]
    }

    fn with_bulk_modulus(self, bulk: T) -> Option<Self> {
        Some(Self { D: half::<T>() * bulk, ..self })
    }
}
