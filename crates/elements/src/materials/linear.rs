//! ψ = μ ε:ε + λ/2 tr(ε)², ε = ½ (G + Gᵀ): Hooke's law for small strain and small rotation.
//!
//! Sifakis and Barbič, FEM Simulation of 3D Deformable Solids (2012), part one, §3.2. P = 2μ ε + λ tr(ε) 1. The law
//! mistakes a rotation for a strain.

use super::{Law, NamedLaw};
use crate::number::{Number, constant};
use crate::tensor::{Tensor, Tensor4, dot, from_fn, half, trace};

/// Lamé's constants, Pa.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Linear<T> {
    /// Shear modulus μ.
    pub mu: T,
    /// λ
    pub lambda: T,
}

/// ε
#[inline(always)]
fn strain<T: Number>(G: &Tensor<T>) -> Tensor<T> {
    from_fn(
        #[inline(always)]
        |i, j| half::<T>() * (G[i][j] + G[j][i]),
    )
}

impl<T: Number> Law<T> for Linear<T> {
    #[inline(always)]
    fn energy(&self, G: &Tensor<T>) -> T {
        let (strain, volume) = (strain(G), trace(G));
        self.mu * dot(&strain, &strain) + half::<T>() * self.lambda * volume * volume
    }

    #[inline(always)]
    fn stress(&self, G: &Tensor<T>) -> Tensor<T> {
        let two_mu = constant::<T>(2.0) * self.mu;
        let strain = strain(G);
        let mut P = from_fn(
            #[inline(always)]
            |i, j| two_mu * strain[i][j],
        );
        let pressure = self.lambda * trace(G);
        for i in 0..3 {
            P[i][i] += pressure;
        }
        P
    }

    #[inline(always)]
    fn derivative(&self, _: &Tensor<T>) -> Tensor4<T> {
        let mut H = [[T::zero(); 9]; 9];
        for i in 0..3 {
            for j in 0..3 {
                H[3 * i + j][3 * i + j] += self.mu;
                H[3 * i + j][3 * j + i] += self.mu;
                H[4 * i][4 * j] += self.lambda;
            }
        }
        H
    }

    /// The derivative itself: its eigenvalues are 2μ, 2μ + 3λ and, for rotations, zero.
    #[inline(always)]
    fn projected_derivative(&self, G: &Tensor<T>) -> Tensor4<T> {
        self.derivative(G)
    }
}

impl<T: Number> NamedLaw<T> for Linear<T> {
    const NAME: &'static str = "linear";
    const IS_LINEAR: bool = true;

    fn of(material: &fem_model::Material) -> Option<Self> {
        let fem_model::Law::Linear(elastic) = material.law else { return None };
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
