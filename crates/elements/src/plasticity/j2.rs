//! Von Mises plasticity with linear isotropic hardening at finite strain: F = Fᵉ Fᵖ, Hencky's law in Fᵉ, radial return.
//!
//! Simo, Algorithms for Static and Dynamic Multiplicative Plasticity that Preserve the Classical Return Mapping Schemes of the
//! Infinitesimal Theory (1992). From the trial strains ε of F Fᵖ⁻¹ with their deviator e and q = √6 μ |e|, the material yields where
//! q > σ_y + H α, by Δα = (q − σ_y − H α)/(3μ + H), and e becomes (1 − 3μ Δα/q) e. This minimizes
//! μ |e|² + K/2 tr(ε)² + H/2 (α + Δα)² + σ_y Δα, stored and dissipated energy: Ortiz and Stainier, The Variational Formulation of
//! Viscoplastic Constitutive Updates (1999). So the minimum is the energy density of a step, its derivative is the stress after the
//! return, and its second derivative the consistent tangent.

use super::{Flow, Internal};
use crate::materials::{Kirchhoff, Law, Logarithmic, derivative_from, projected_derivative_from};
use crate::number::{Float, Number, constant};
use crate::tensor::{Tensor, Tensor4, from_fn, half, plus_identity, product, transpose};

/// The parameters, Pa, and the internal variables at the start of a step.
#[derive(Clone, Copy, Debug)]
pub struct J2<T> {
    /// Shear modulus μ.
    pub mu: T,
    /// Bulk modulus K.
    pub bulk: T,
    /// Yield stress in tension σ_y.
    pub yield_stress: T,
    /// Hardening modulus H.
    pub hardening: T,
    /// Fᵖ⁻¹ − 1
    pub plastic: Tensor<T>,
    /// Accumulated equivalent plastic strain α.
    pub strain: T,
}

/// Distance from the yield surface that counts as rounding error, as a multiple of the yield stress and the machine epsilon.
const ON_SURFACE: f64 = 1e4;

/// A trial state and its return to the yield surface.
struct Returned<T> {
    trial: Logarithmic<T>,
    /// Deviator of the trial strains, and its norm.
    deviator: [T; 3],
    norm: T,
    /// ε_1 + ε_2 + ε_3
    volume: T,
    /// Increase of α.
    flow: T,
    /// Part of the deviator that stays elastic, 1 − 3μ Δα/q.
    elastic: T,
    /// Slope of the stress along the flow over that without flow: H/(3μ + H), or 1.
    slope: T,
}

impl<T: Number> J2<T> {
    #[inline(always)]
    fn returned(&self, G: &Tensor<T>) -> Returned<T> {
        let trial = Logarithmic::new(&trial(&self.plastic, G));
        let e = &trial.strains;
        let volume = e[0] + e[1] + e[2];
        let mean = constant::<T>(1.0 / 3.0) * volume;
        let deviator = [e[0] - mean, e[1] - mean, e[2] - mean];
        let norm = (deviator[0] * deviator[0] + deviator[1] * deviator[1] + deviator[2] * deviator[2]).sqrt();
        let three_mu = constant::<T>(3.0) * self.mu;
        let q = constant::<T>(6f64.sqrt()) * self.mu * norm;
        let excess = q - (self.yield_stress + self.hardening * self.strain);
        let yields = excess.gt(T::zero());
        let flow = (excess / (three_mu + self.hardening)).select(yields, T::zero());
        let elastic = (T::one() - three_mu * flow / q).select(yields, T::one());
        // A flow ends on the yield surface, where rounding errors choose the side; the derivative there is that of unloading.
        let on_surface = constant::<T>(ON_SURFACE * Float::as_f64(<T::Element as Float>::EPSILON));
        let is_beyond = excess.gt(on_surface * (self.yield_stress + self.hardening * self.strain));
        let slope = (self.hardening / (three_mu + self.hardening)).select(is_beyond, T::one());
        Returned { trial, deviator, norm, volume, flow, elastic, slope }
    }

    #[inline(always)]
    fn energy_of(&self, at: &Returned<T>) -> T {
        let norm = at.elastic * at.norm;
        let strain = self.strain + at.flow;
        let stored = self.mu * norm * norm
            + half::<T>() * (self.bulk * at.volume * at.volume + self.hardening * strain * strain);
        at.trial.allowed(stored + self.yield_stress * at.flow)
    }

    #[inline(always)]
    fn kirchhoff(&self, at: &Returned<T>) -> Kirchhoff<T> {
        let two_mu = constant::<T>(2.0) * self.mu;
        let (ratio, pressure) = (two_mu * at.elastic, self.bulk * at.volume);
        // A state of no deviator does not yield, and has no direction.
        let over_norm = (T::one() / at.norm).select(at.norm.gt(T::zero()), T::zero());
        let n = [at.deviator[0] * over_norm, at.deviator[1] * over_norm, at.deviator[2] * over_norm];
        let along = two_mu * (at.slope - at.elastic);
        let beside = self.bulk - constant::<T>(1.0 / 3.0) * ratio;
        let mut moduli = [[T::zero(); 3]; 3];
        let mut tau = [T::zero(); 3];
        for k in 0..3 {
            tau[k] = pressure + ratio * at.deviator[k];
            for l in 0..3 {
                moduli[k][l] = beside + along * n[k] * n[l];
            }
            moduli[k][k] += ratio;
        }
        Kirchhoff { tau, ratios: [ratio; 3], moduli }
    }

    /// The stress of F from that of F Fᵖ⁻¹: P Fᵖ⁻ᵀ.
    #[inline(always)]
    fn stress_of(&self, at: &Returned<T>) -> Tensor<T> {
        product(&at.trial.stress(&self.kirchhoff(at).tau), &transpose(&plus_identity(&self.plastic)))
    }
}

/// The displacement gradient of F Fᵖ⁻¹.
#[inline(always)]
pub(super) fn trial<T: Number>(plastic: &Tensor<T>, G: &Tensor<T>) -> Tensor<T> {
    let of_both = product(G, plastic);
    from_fn(
        #[inline(always)]
        |i, j| G[i][j] + plastic[i][j] + of_both[i][j],
    )
}

/// The derivative by F from that by F Fᵖ⁻¹.
#[inline(always)]
pub(super) fn pulled_back<T: Number>(plastic: &Tensor<T>, H: &Tensor4<T>) -> Tensor4<T> {
    let A = plus_identity(plastic);
    let mut result = [[T::zero(); 9]; 9];
    for i in 0..3 {
        for k in 0..3 {
            let block = from_fn(
                #[inline(always)]
                |m, n| H[3 * i + m][3 * k + n],
            );
            let block = product(&product(&A, &block), &transpose(&A));
            for j in 0..3 {
                result[3 * i + j][3 * k..3 * k + 3].copy_from_slice(&block[j]);
            }
        }
    }
    result
}

impl J2<f64> {
    /// The flow of an accepted step that ends with the displacement gradient G: Fᵖ⁻¹ becomes Fᵖ⁻¹ exp(−Δεᵖ).
    pub fn flow(&self, G: &Tensor<f64>) -> Flow {
        let at = self.returned(G);
        if at.flow == 0.0 {
            return (Internal { plastic: self.plastic, strain: self.strain }, 0.0);
        }
        // exp(−Δεᵖ) − 1 keeps the digits of a small flow.
        let change = at.deviator.map(|e| ((at.elastic - 1.0) * e).exp_m1());
        let V = &at.trial.F.V;
        let change = from_fn(|i, j| (0..3).map(|k| change[k] * V[k][i] * V[k][j]).sum::<f64>());
        let of_both = product(&self.plastic, &change);
        let plastic = from_fn(|i, j| self.plastic[i][j] + change[i][j] + of_both[i][j]);
        (Internal { plastic, strain: self.strain + at.flow }, self.yield_stress * at.flow)
    }
}

impl<T: Number> Law<T> for J2<T> {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        self.energy_of(&self.returned(G))
    }

    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        self.stress_of(&self.returned(G))
    }

    #[inline(always)]
    fn energy_and_stress(&self, G: &Tensor<T>) -> (T, Tensor<T>) {
        let at = self.returned(G);
        (self.energy_of(&at), self.stress_of(&at))
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let at = self.returned(G);
        pulled_back(&self.plastic, &derivative_from(&at.trial.F, &at.trial.principal(&self.kirchhoff(&at))))
    }

    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let at = self.returned(G);
        pulled_back(&self.plastic, &projected_derivative_from(&at.trial.F, &at.trial.principal(&self.kirchhoff(&at))))
    }
}
