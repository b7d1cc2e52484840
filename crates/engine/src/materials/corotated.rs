//! ψ = μ ‖F − R‖² + λ/2 (tr(RᵀF) − 3)², R the rotation nearest to F: corotated linear elasticity.
//!
//! Sifakis and Barbič, FEM Simulation of 3D Deformable Solids (2012), part one, §3.4; eigenvalues: Smith, de Goes and Kim,
//! Analytic Eigensystems for Isotropic Distortion Energies (2019).
//!
//! With F = U diag(σ) Vᵀ, R = U Vᵀ and e = σ − 1: ψ = μ Σe² + λ/2 (Σe)², P = U diag(2μ e + λ Σe) Vᵀ. R is always proper: an
//! inverted element has σ_3 < 0 and is pushed back. Where σ_i + σ_j = 0, R jumps and ψ has a crease.

use super::isotropic::{Principal, derivative_from, projected_derivative_from};
use super::{Law, NamedLaw};
use crate::number::{Number, Real, constant};
use crate::svd::{Svd, svd, svd_in_plane};
use crate::tensor::{Tensor, Tensor4, dot, green_strain, half, plus_identity};

/// Lamé's constants of small strain, Pa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Corotated<T> {
    /// Shear modulus μ.
    pub mu: T,
    /// λ
    pub lambda: T,
}

/// F = U diag(1 + e) Vᵀ and e.
#[inline(always)]
pub(crate) fn stretches<T: Number>(G: &Tensor<T>) -> (Svd<T>, [T; 3]) {
    with_strains(svd(&plus_identity(G)), G)
}

/// The same of a flat body, whose third row and column of G are zero, with rotations within the plane.
#[inline(always)]
pub(crate) fn stretches_in_plane<T: Number>(G: &Tensor<T>) -> (Svd<T>, [T; 3]) {
    with_strains(svd_in_plane(G), G)
}

#[inline(always)]
fn with_strains<T: Number>(F: Svd<T>, G: &Tensor<T>) -> (Svd<T>, [T; 3]) {
    let strain = green_strain(G);
    let is_small = dot(&strain, &strain).simd_lt(constant(0.0625));
    let mut e = F.sigma;
    for k in 0..3 {
        let v = &F.V[k];
        let mut green = T::zero();
        for i in 0..3 {
            green += v[i] * (strain[i][0] * v[0] + strain[i][1] * v[1] + strain[i][2] * v[2]);
        }
        // σ² − 1 = 2 vᵀEv has the digits that σ − 1 loses near rest. A mirror image is without strain, too.
        let keeps_digits = is_small & F.sigma[k].simd_gt(T::zero());
        let from_strain = constant::<T>(2.0) * green / (F.sigma[k] + T::one());
        e[k] = from_strain.select(keeps_digits, F.sigma[k] - T::one());
    }
    (F, e)
}

impl<T: Number> Corotated<T> {
    #[inline(always)]
    fn energy_of(&self, e: &[T; 3]) -> T {
        let sum = e[0] + e[1] + e[2];
        self.mu * (e[0] * e[0] + e[1] * e[1] + e[2] * e[2]) + half::<T>() * self.lambda * sum * sum
    }

    #[inline(always)]
    fn stress_of(&self, F: &Svd<T>, e: &[T; 3]) -> Tensor<T> {
        let (two_mu, pressure) = (constant::<T>(2.0) * self.mu, self.lambda * (e[0] + e[1] + e[2]));
        F.with_values(&[two_mu * e[0] + pressure, two_mu * e[1] + pressure, two_mu * e[2] + pressure])
    }

    #[inline(always)]
    fn principal(&self, F: &Svd<T>, e: &[T; 3]) -> Principal<T> {
        let two = constant::<T>(2.0);
        let pressure = two * self.lambda * (e[0] + e[1] + e[2]);
        // On the crease the derivative is not finite; beside it, it is cut off.
        let floor = constant::<T>(Real::as_f64(<T::Element as Real>::EPSILON).sqrt());
        let mut principal = Principal::zero();
        for k in 0..3 {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let sum = (F.sigma[i] + F.sigma[j]).simd_max(floor);
            principal.twist[k] = (two * self.mu * (e[i] + e[j]) + pressure) / sum;
            principal.flip[k] = two * self.mu;
            principal.scaling[k] = [self.lambda; 3];
            principal.scaling[k][k] += two * self.mu;
        }
        principal
    }
}

impl<T: Number> Law<T> for Corotated<T> {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        self.energy_of(&stretches(G).1)
    }

    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        let (F, e) = stretches(G);
        self.stress_of(&F, &e)
    }

    /// With one singular value decomposition for both.
    #[inline(always)]
    fn energy_and_stress(&self, G: &Tensor<T>) -> (T, Tensor<T>) {
        let (F, e) = stretches(G);
        (self.energy_of(&e), self.stress_of(&F, &e))
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let (F, e) = stretches(G);
        derivative_from(&F, &self.principal(&F, &e))
    }

    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let (F, e) = stretches(G);
        projected_derivative_from(&F, &self.principal(&F, &e))
    }
}

impl<T: Number> NamedLaw<T> for Corotated<T> {
    const NAME: &'static str = "corotated";

    fn from_scene(table: &fem_scene::Material) -> Option<Self> {
        let (mu, lambda) = table.lame()?;
        Some(Self { mu: constant(mu), lambda: constant(lambda) })
    }

    fn moduli(&self) -> [T; 2] {
        [self.mu, self.lambda + constant::<T>(2.0 / 3.0) * self.mu]
    }
}
