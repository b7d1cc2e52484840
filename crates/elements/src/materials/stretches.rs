//! Principal stretches that keep the digits of a small strain.

use pulp::{Simd, WithSimd};

use super::isotropic::eigen;
use crate::number::{Number, constant};
use crate::svd::{Svd, largest_entry, svd, svd_in_plane};
use crate::tensor::{Tensor, dot, green_strain, plus_identity, volume_change};

/// ‖E‖² below which stretches come from Green's strain E.
const SMALL: f64 = 0.0625;

/// Smallest size of a strain that its entries are divided by.
const TINY: f64 = 1e-30;

/// F = U diag(1 + e) Vᵀ and e: those of a large strain in the order of [`svd`], those of a small one in any.
#[inline(always)]
pub(crate) fn stretches<T: Number>(G: &Tensor<T>) -> (Svd<T>, [T; 3]) {
    near_rest_or(
        G,
        #[inline(always)]
        || svd(&plus_identity(G)),
    )
}

/// The same of a flat body, whose third row and column of G are zero, with rotations within the plane.
#[inline(always)]
pub(crate) fn stretches_in_plane<T: Number>(G: &Tensor<T>) -> (Svd<T>, [T; 3]) {
    near_rest_or(
        G,
        #[inline(always)]
        || svd_in_plane(G),
    )
}

/// The stretches from Green's strain where it is small, else by another decomposition. F = 1 + G loses digits of a small G, and its principal axes
/// are wrong by the machine epsilon over the strain.
#[inline(always)]
fn near_rest_or<T: Number>(G: &Tensor<T>, other: impl FnOnce() -> Svd<T>) -> (Svd<T>, [T; 3]) {
    let strain = green_strain(G);
    // A mirror image is without strain, too.
    let is_small = dot(&strain, &strain).lt(constant(SMALL)) & volume_change(G).0.gt(-T::one());
    let (mut F, mut e) = near_rest(G, &strain);
    if T::all(is_small) {
        return (F, e);
    }
    let large = other();
    for k in 0..3 {
        e[k] = e[k].select(is_small, large.sigma[k] - T::one());
        F.sigma[k] = F.sigma[k].select(is_small, large.sigma[k]);
        for i in 0..3 {
            F.U[k][i] = F.U[k][i].select(is_small, large.U[k][i]);
            F.V[k][i] = F.V[k][i].select(is_small, large.V[k][i]);
        }
    }
    (F, e)
}

/// V and ε are eigenvectors and eigenvalues of E, 1 + e = √(1 + 2ε) and u_k = F v_k/(1 + e_k), in any order.
#[inline(never)] // one instance for each number type
fn near_rest<T: Number>(G: &Tensor<T>, strain: &Tensor<T>) -> (Svd<T>, [T; 3]) {
    T::vectorize(NearRest { G, strain })
}

struct NearRest<'a, T> {
    G: &'a Tensor<T>,
    strain: &'a Tensor<T>,
}

impl<T: Number> WithSimd for NearRest<'_, T> {
    type Output = (Svd<T>, [T; 3]);

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> Self::Output {
        let Self { G, strain } = self;
        let size = largest_entry(strain).max(constant(TINY));
        let (eigenvalues, V) = eigen(strain, size);
        let (mut U, mut sigma, mut e) = (V, [T::one(); 3], [T::zero(); 3]);
        for k in 0..3 {
            let twice = constant::<T>(2.0) * size * eigenvalues[k];
            sigma[k] = (T::one() + twice).sqrt();
            e[k] = twice / (sigma[k] + T::one());
            for i in 0..3 {
                let change = G[i][0] * V[k][0] + G[i][1] * V[k][1] + G[i][2] * V[k][2];
                U[k][i] = (V[k][i] + change) / sigma[k];
            }
        }
        (Svd { U, sigma, V }, e)
    }
}
