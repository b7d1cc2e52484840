//! ψ = μ E:E + λ/2 tr(E)², E = ½ (FᵀF − 1): St. Venant–Kirchhoff, Hooke's law in Green's strain.
//!
//! Sifakis and Barbič, FEM Simulation of 3D Deformable Solids (2012), part one, §3.3.
//! With S = 2μ E + λ tr(E) 1: P = F S, and ∂P_ij/∂F_kl = δ_ik S_jl + μ ((FFᵀ)_ik δ_jl + F_il F_kj) + λ F_ij F_kl.
//! Below 1/√3 of its length an element resists further compression less and less; a flat element has no stress along it.

use super::isotropic::{Principal, projected_derivative_from};
use super::{Law, NamedLaw};
use crate::number::{Number, constant};
use crate::svd::svd;
use crate::tensor::{Tensor, Tensor4, dot, from_fn, green_strain, half, plus_identity, product, trace};

/// Lamé's constants of small strain, Pa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StVenantKirchhoff<T> {
    /// Shear modulus μ.
    pub mu: T,
    /// λ
    pub lambda: T,
}

impl<T: Number> StVenantKirchhoff<T> {
    /// S, the second Piola–Kirchhoff stress.
    #[inline(always)]
    fn second_stress(&self, G: &Tensor<T>) -> Tensor<T> {
        let strain = green_strain(G);
        let (two_mu, pressure) = (constant::<T>(2.0) * self.mu, self.lambda * trace(&strain));
        from_fn(
            #[inline(always)]
            |i, j| if i == j { two_mu * strain[i][j] + pressure } else { two_mu * strain[i][j] },
        )
    }
}

impl<T: Number> Law<T> for StVenantKirchhoff<T> {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        let strain = green_strain(G);
        let volume = trace(&strain);
        self.mu * dot(&strain, &strain) + half::<T>() * self.lambda * volume * volume
    }

    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        product(&plus_identity(G), &self.second_stress(G))
    }

    #[inline(always)]
    fn derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let (F, S) = (plus_identity(G), self.second_stress(G));
        let left = from_fn(
            #[inline(always)]
            |i, k| self.mu * (F[i][0] * F[k][0] + F[i][1] * F[k][1] + F[i][2] * F[k][2]),
        );
        let mut H = [[T::zero(); 9]; 9];
        for row in 0..9 {
            for column in 0..9 {
                let (i, j, k, l) = (row / 3, row % 3, column / 3, column % 3);
                let mut entry = self.mu * F[i][l] * F[k][j] + self.lambda * F[i][j] * F[k][l];
                if i == k {
                    entry += S[j][l];
                }
                if j == l {
                    entry += left[i][k];
                }
                H[row][column] = entry;
            }
        }
        H
    }

    /// With e_i = (σ_i² − 1)/2 and p_i = σ_i (2μ e_i + λ Σe), the ratios (p_i ± p_j)/(σ_i ± σ_j) divide out.
    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        let F = svd(&plus_identity(G));
        let sigma = &F.sigma;
        let pressure = self.lambda * trace(&green_strain(G));
        let mut principal = Principal::zero();
        for k in 0..3 {
            let (i, j) = ((k + 1) % 3, (k + 2) % 3);
            let squares = sigma[i] * sigma[i] + sigma[j] * sigma[j] - T::one();
            let mixed = sigma[i] * sigma[j];
            principal.twist[k] = self.mu * (squares - mixed) + pressure;
            principal.flip[k] = self.mu * (squares + mixed) + pressure;
            for l in 0..3 {
                principal.scaling[k][l] = self.lambda * sigma[k] * sigma[l];
            }
            principal.scaling[k][k] += self.mu * (constant::<T>(3.0) * sigma[k] * sigma[k] - T::one()) + pressure;
        }
        projected_derivative_from(&F, &principal)
    }
}

impl<T: Number> NamedLaw<T> for StVenantKirchhoff<T> {
    const NAME: &'static str = "st_venant_kirchhoff";

    fn of(material: &fem_model::Material) -> Option<Self> {
        let fem_model::Law::StVenantKirchhoff(elastic) = material.law else { return None };
        let [mu, lambda] = elastic.lame(material.plane).map(constant);
        Some(Self { mu, lambda })
    }

    fn moduli(&self) -> [T; 2] {
        [self.mu, self.lambda + constant::<T>(2.0 / 3.0) * self.mu]
    }
}
