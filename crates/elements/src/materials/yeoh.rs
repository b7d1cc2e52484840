//! ψ = C1 (Ī − 3) + C2 (Ī − 3)² + C3 (Ī − 3)³ + D (J − 1)², Ī = J^(−2/3) tr(FᵀF): compressible Yeoh, for filled rubber that
//! first softens and then stiffens.
//!
//! Yeoh, Some Forms of the Strain Energy Function for Rubber (1993). With f(Ī − 3) the first three terms,
//! P = f' ∂Ī/∂F + 2D (J − 1) cof and ∂P/∂F = f' ∂²Ī/∂F² + f'' ∂Ī/∂F⊗∂Ī/∂F + that of the last term.

use super::isochoric::Isochoric;
use super::{Law, NamedLaw, OfInvariants, Terms};
use crate::number::{Number, constant};
use crate::tensor::{Tensor, Tensor4, half};

/// Moduli, Pa. Small strain: μ = 2 C1, bulk modulus 2D; C2 is often negative. Where f' < 0, which negative C2 and C3 allow,
/// the law yields without resistance.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // the names are those of the formula
pub struct Yeoh<T> {
    pub C1: T,
    pub C2: T,
    pub C3: T,
    /// Volume.
    pub D: T,
}

impl<T: Number> Yeoh<T> {
    /// f'
    #[inline(always)]
    fn slope(&self, e: T) -> T {
        self.C1 + e * (constant::<T>(2.0) * self.C2 + constant::<T>(3.0) * self.C3 * e)
    }

    #[inline(always)]
    fn of_invariants(&self, G: &Tensor<T>) -> OfInvariants<T> {
        let at = Isochoric::new(G);
        let e = at.excess();
        let curvature = constant::<T>(2.0) * self.C2 + constant::<T>(6.0) * self.C3 * e;
        at.terms_of(G, [self.slope(e), curvature], self.D)
    }
}

impl<T: Number> Law<T> for Yeoh<T> {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        let at = Isochoric::new(G);
        let e = at.excess();
        at.allowed(e * (self.C1 + e * (self.C2 + e * self.C3)) + self.D * at.j * at.j)
    }

    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        let at = Isochoric::new(G);
        at.stress(G, self.slope(at.excess()), constant::<T>(2.0) * self.D * at.j)
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

impl<T: Number> NamedLaw<T> for Yeoh<T> {
    const NAME: &'static str = "yeoh";
    const ALLOWS_INVERSION: bool = false;

    fn of(material: &fem_model::Material) -> Option<Self> {
        let fem_model::Law::Yeoh { C1, C2, C3, D } = material.law else { return None };
        let [C1, C2, C3, D] = [C1, C2, C3, D].map(constant);
        Some(Self { C1, C2, C3, D })
    }

    fn moduli(&self) -> [T; 2] {
        [self.C1 + self.C1, self.D + self.D]
    }

    fn with_bulk_modulus(self, bulk: T) -> Option<Self> {
        Some(Self { D: half::<T>() * bulk, ..self })
    }
}
