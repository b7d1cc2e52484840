//! ψ = μ ε:ε + λ/2 tr(ε)², ε = ln √(FᵀF): Hencky's law, Hooke's law in the logarithmic strain.
//!
//! Hencky, Über die Form des Elastizitätsgesetzes bei ideal elastischen Stoffen (1928). Kirchhoff's principal stresses are
//! τ_i = 2μ ε_i + λ Σε. Stretched beyond e = 2.7 of its length, an element resists further stretch less and less.

use super::isotropic::{derivative_from, projected_derivative_from};
use super::logarithmic::{Kirchhoff, Logarithmic};
use super::{Law, NamedLaw};
use crate::number::{Number, constant};
use crate::tensor::{Tensor, Tensor4, half};

/// Lamé's constants of small strain, Pa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hencky<T> {
    /// Shear modulus μ.
    pub mu: T,
    /// λ
    pub lambda: T,
}

impl<T: Number> Hencky<T> {
    #[inline(always)]
    fn energy_of(&self, at: &Logarithmic<T>) -> T {
        let e = &at.strains;
        let sum = e[0] + e[1] + e[2];
        at.allowed(self.mu * (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) + half::<T>() * self.lambda * sum * sum)
    }

    #[inline(always)]
    fn kirchhoff(&self, e: &[T; 3]) -> Kirchhoff<T> {
        let two_mu = constant::<T>(2.0) * self.mu;
        let pressure = self.lambda * (e[0] + e[1] + e[2]);
        let mut moduli = [[self.lambda; 3]; 3];
        for k in 0..3 {
            moduli[k][k] += two_mu;
        }
        let tau = [two_mu * e[0] + pressure, two_mu * e[1] + pressure, two_mu * e[2] + pressure];
        Kirchhoff { tau, ratios: [two_mu; 3], moduli }
    }
}

impl<T: Number> Law<T> for Hencky<T> {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        self.energy_of(&Logarithmic::new(G))
    }

    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        let at = Logarithmic::new(G);
        at.stress(&self.kirchhoff(&at.strains).tau)
    }

    /// With one singular value decomposition for both.
    #[inline(always)]
    fn energy_and_stress(&self, G: &Tensor<T>) -> (T, Tensor<T>) {
        let at = Logarithmic::new(G);
        (self.energy_of(&at), at.stress(&self.kirchhoff(&at.strains).tau))
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let at = Logarithmic::new(G);
        derivative_from(&at.F, &at.principal(&self.kirchhoff(&at.strains)))
    }

    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let at = Logarithmic::new(G);
        projected_derivative_from(&at.F, &at.principal(&self.kirchhoff(&at.strains)))
    }
}

impl<T: Number> NamedLaw<T> for Hencky<T> {
    const NAME: &'static str = "hencky";
    const ALLOWS_INVERSION: bool = false;

    fn of(material: &fem_model::Material) -> Option<Self> {
        let fem_model::Law::Hencky(elastic) = material.law else { return None };
        let [mu, lambda] = elastic.lame(material.plane).map(constant);
        Some(Self { mu, lambda })
    }

    fn moduli(&self) -> [T; 2] {
        [self.mu, self.lambda + constant::<T>(2.0 / 3.0) * self.mu]
    }

    fn with_bulk_modulus(self, bulk: T) -> Option<Self> {
        Some(Self { lambda: bulk - constant::<T>(2.0 / 3.0) * self.mu, ..self })
    }
}
