//! ψ = −C Jm ln(1 − (Ī − 3)/Jm) + D (J − 1)², Ī = J^(−2/3) tr(FᵀF): compressible Gent, for rubber whose chains cannot be longer than
//! they are. The stress grows without bound as Ī − 3 comes near to Jm.
//!
//! Gent, A New Constitutive Relation for Rubber (1996), eq. 3. With f(e) the first term, f' = C/(1 − e/Jm) and f'' = f'²/(C Jm).

use super::isochoric::Isochoric;
use super::{Law, NamedLaw, OfInvariants, Terms};
use crate::number::{Number, constant, minus_ln_1p};
use crate::tensor::{Tensor, Tensor4, half};

/// Moduli, Pa, and the limit of the chains. Small strain: μ = 2C, bulk modulus 2D.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // the names are those of the formula
pub struct Gent<T> {
    pub C: T,
    /// Ī − 3 where the chains are stretched out.
    pub Jm: T,
    /// Volume.
    pub D: T,
}

impl<T: Number> Gent<T> {
    /// f'
    #[inline(always)]
    fn slope(&self, e: T) -> T {
        self.C * self.Jm / (self.Jm - e)
    }

    #[inline(always)]
    fn of_invariants(&self, G: &Tensor<T>) -> OfInvariants<T> {
        let at = Isochoric::new(G);
        let slope = self.slope(at.excess());
        at.terms_of(G, [slope, slope * slope / (self.C * self.Jm)], self.D)
    }
}

impl<T: Number> Law<T> for Gent<T> {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        let at = Isochoric::new(G);
        let e = at.excess();
        // −ln(1 + x) = (x − ln(1 + x)) − x with x = −e/Jm, in which near rest nothing cancels.
        let energy = self.C * (e + self.Jm * minus_ln_1p(-e / self.Jm));
        let allowed = at.allowed(energy + self.D * at.j * at.j);
        allowed.select(e.lt(self.Jm), constant(f64::INFINITY))
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

    /// Requires J > 0 and Ī − 3 < Jm.
    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.of_invariants(G).projected_derivative()
    }
}

impl<T: Number> NamedLaw<T> for Gent<T> {
    const NAME: &'static str = "gent";
    const ALLOWS_INVERSION: bool = false;

    fn of(material: &fem_model::Material) -> Option<Self> {
        let fem_model::Law::Gent { C, Jm, D } = material.law else { return None };
        let [C, Jm, D] = [C, Jm, D].map(constant);
        Some(Self { C, Jm, D })
    }

    fn moduli(&self) -> [T; 2] {
        [self.C + self.C, self.D + self.D]
    }

    fn with_bulk_modulus(self, bulk: T) -> Option<Self> {
        Some(Self { D: half::<T>() * bulk, ..self })
    }
}
