//! ψ = Σ_p μ_p/α_p (λ̄_1^α_p + λ̄_2^α_p + λ̄_3^α_p − 3) + D (J − 1)², λ̄_i = J^(−1/3) σ_i, up to three terms: compressible Ogden, for rubber up to
//! several times its length.
//!
//! Ogden, Large Deformation Isotropic Elasticity: On the Correlation of Theory and Experiment for Incompressible Rubberlike Solids (1972), with the
//! energy of the volume that the other laws of rubber have here. With the strains ε_i = ln σ_i, their deviator e_i and b_i = exp(α e_i), so that
//! Σ e_i = 0 and the energy is a sum of e^x − 1 − x, Kirchhoff's principal stresses of a term are τ_i = μ (b_i − Σb/3), and
//! ∂τ_i/∂ε_j = μ α (b_i δ_ij − (b_i + b_j − Σb/3)/3).

use super::isotropic::{derivative_from, projected_derivative_from};
use super::logarithmic::{Kirchhoff, Logarithmic};
use super::{Law, NamedLaw};
use crate::number::{Number, constant, exp_m1};
use crate::tensor::{Tensor, Tensor4, half, volume_change};

/// Moduli, Pa, and exponents of the terms, of which those beyond the last have μ = 0. Small strain: shear modulus Σ μ α/2, bulk modulus 2D.
#[derive(Clone, Copy, Debug, PartialEq)]
#[allow(missing_docs)] // the names are those of the formula
pub struct Ogden<T> {
    pub mu: [T; 3],
    /// Not zero.
    pub alpha: [T; 3],
    /// Volume.
    pub D: T,
}

/// The state of an element.
#[derive(Clone, Copy)]
struct State<T> {
    stretches: Logarithmic<T>,
    /// e_i
    deviator: [T; 3],
    /// J − 1
    j: T,
}

impl<T: Number> State<T> {
    #[inline(always)]
    fn new(G: &Tensor<T>) -> Self {
        let stretches = Logarithmic::new(G);
        let e = &stretches.strains;
        let mean = constant::<T>(1.0 / 3.0) * (e[0] + e[1] + e[2]);
        Self { stretches, deviator: [e[0] - mean, e[1] - mean, e[2] - mean], j: volume_change(G).0 }
    }
}

impl<T: Number> Ogden<T> {
    /// μ and α of the terms.
    #[inline(always)]
    fn terms(&self) -> impl Iterator<Item = (T, T)> {
        let is_there = |term: &(T, T)| !T::all(term.0.eq(T::zero()));
        self.mu.into_iter().zip(self.alpha).filter(is_there)
    }

    #[inline(always)]
    fn energy_of(&self, at: &State<T>) -> T {
        let mut energy = self.D * at.j * at.j;
        for (mu, alpha) in self.terms() {
            let beyond = at.deviator.map(
                #[inline(always)]
                |e| exp_m1(alpha * e)[1],
            );
            energy += mu / alpha * (beyond[0] + beyond[1] + beyond[2]);
        }
        // Terms of opposite signs can both be out of range.
        let infinity = constant::<T>(f64::INFINITY);
        at.stretches.allowed(energy.select(energy.abs().lt(infinity), infinity))
    }

    /// τ_i
    #[inline(always)]
    fn tau(&self, at: &State<T>) -> [T; 3] {
        let mut tau = [constant::<T>(2.0) * self.D * at.j * (T::one() + at.j); 3];
        for (mu, alpha) in self.terms() {
            let (powers, mean) = powers(at, alpha);
            for i in 0..3 {
                tau[i] += mu * (powers[i] - mean);
            }
        }
        tau
    }

    #[inline(always)]
    fn kirchhoff(&self, at: &State<T>) -> Kirchhoff<T> {
        let (one, third) = (T::one(), constant::<T>(1.0 / 3.0));
        let J = one + at.j;
        let mut moduli = [[constant::<T>(2.0) * self.D * J * (J + at.j); 3]; 3];
        let mut ratios = [T::zero(); 3];
        for (mu, alpha) in self.terms() {
            let (powers, mean) = powers(at, alpha);
            let mu_alpha = mu * alpha;
            for k in 0..3 {
                let (i, j) = ((k + 1) % 3, (k + 2) % 3);
                // (b_i − b_j)/(α (e_i − e_j)) is the larger b times (1 − e^(−x))/x, of which the limit at x = 0 is 1.
                let minus_x = -(alpha * (at.deviator[i] - at.deviator[j])).abs();
                let slope = one.select(minus_x.eq(T::zero()), exp_m1(minus_x)[0] / minus_x);
                ratios[k] += mu_alpha * (one + powers[i].max(powers[j])) * slope;
                for l in 0..3 {
                    moduli[k][l] -= mu_alpha * third * (one + powers[k] + powers[l] - mean);
                }
                moduli[k][k] += mu_alpha * (one + powers[k]);
            }
        }
        Kirchhoff { tau: self.tau(at), ratios, moduli }
    }
}

/// b_i − 1 and their mean.
#[inline(always)]
fn powers<T: Number>(at: &State<T>, alpha: T) -> ([T; 3], T) {
    let powers = at.deviator.map(
        #[inline(always)]
        |e| exp_m1(alpha * e)[0],
    );
    (powers, constant::<T>(1.0 / 3.0) * (powers[0] + powers[1] + powers[2]))
}

impl<T: Number> Law<T> for Ogden<T> {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        self.energy_of(&State::new(G))
    }

    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        let at = State::new(G);
        at.stretches.stress(&self.tau(&at))
    }

    /// With one singular value decomposition for both.
    #[inline(always)]
    fn energy_and_stress(&self, G: &Tensor<T>) -> (T, Tensor<T>) {
        let at = State::new(G);
        (self.energy_of(&at), at.stretches.stress(&self.tau(&at)))
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let at = State::new(G);
        derivative_from(&at.stretches.F, &at.stretches.principal(&self.kirchhoff(&at)))
    }

    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let at = State::new(G);
        projected_derivative_from(&at.stretches.F, &at.stretches.principal(&self.kirchhoff(&at)))
    }
}

impl<T: Number> NamedLaw<T> for Ogden<T> {
    const NAME: &'static str = "ogden";
    const ALLOWS_INVERSION: bool = false;

    fn of(material: &fem_model::Material) -> Option<Self> {
        let fem_model::Law::Ogden { terms, D } = material.law else { return None };
        let terms = terms.map(|term| term.unwrap_or([0.0, 1.0]).map(constant));
        Some(Self { mu: terms.map(|[mu, _]| mu), alpha: terms.map(|[_, alpha]| alpha), D: constant(D) })
    }

    fn moduli(&self) -> [T; 2] {
        let mut twice = T::zero();
        for (mu, alpha) in self.terms() {
            twice += mu * alpha;
        }
        [half::<T>() * twice, self.D + self.D]
    }

    fn with_bulk_modulus(self, bulk: T) -> Option<Self> {
        Some(Self { D: half::<T>() * bulk, ..self })
    }
}
