//! Constraints of one number for an element: the energy of XPBD, the volume of PBD.

use crate::integrators::relaxation::inner;
use fem_elements::materials::Law;
use fem_elements::number::{Lanes, Number, constant};
use fem_elements::tensor::{Tensor, cofactor, dot, map, plus_identity, volume_change};

/// Part of the moduli below which an energy density is rounding error and has no direction.
const NO_ENERGY: f64 = 1e-28;

/// Largest energy density of a deformation that the law allows, J/m³.
const LARGEST: f64 = 1e38;

/// Σ_a Σ_i m_a⁻¹ (X ∇φ_a)_i²: the inverse mass of a correction along X.
#[inline(always)]
fn inverse_mass<L: Number, const N: usize>(X: &Tensor<L>, gradients: &[[L; 3]; N], masses: &[[L; 3]; N]) -> L {
    let mut sum = L::zero();
    for a in 0..N {
        for i in 0..3 {
            let along = inner(&X[i], &gradients[a]);
            sum = (masses[a][i] * along).times_plus(along, sum);
        }
    }
    sum
}

/// The direction P/C of the constraint C = √(2ψ), and the change of its multiplier over V Δt². Zero where the element is at rest.
#[inline(always)]
pub(super) fn by_energy<L: Lanes, const N: usize>(
    law: &dyn Law<L>,
    G: &Tensor<L>,
    multiplier: L,
    pressed: L,
    gradients: &[[L; 3]; N],
    masses: &[[L; 3]; N],
) -> (Tensor<L>, L) {
    let (energy, P) = law.energy_and_stress(G);
    // P:P over the energy is of the size of the moduli.
    let strained = dot(&P, &P) * constant::<L>(NO_ENERGY);
    let is_finite = energy.lt(constant(LARGEST));
    let is_strained = energy.gt(L::zero()) & is_finite & (energy * energy).ge(strained);
    let C = (energy + energy).select(is_strained, L::one()).sqrt();
    let zero = L::zero();
    let direction = map(
        &P,
        #[inline(always)]
        |entry| (entry / C).select(is_strained, zero),
    );
    let w = pressed * inverse_mass(&direction, gradients, masses);
    let change = (-(C + multiplier)).select(is_strained, zero) / (w + L::one());
    (direction, change)
}

/// The part `stiffness` of the correction that brings J − 1 to zero, along cof F.
#[inline(always)]
pub(super) fn by_volume<L: Number, const N: usize>(
    stiffness: L,
    G: &Tensor<L>,
    gradients: &[[L; 3]; N],
    masses: &[[L; 3]; N],
) -> Tensor<L> {
    let cof = cofactor(&plus_identity(G));
    let w = inverse_mass(&cof, gradients, masses);
    let is_free = w.gt(L::zero());
    let (change, _) = volume_change(G);
    let size = (stiffness * change).select(is_free, L::zero()) / w.select(is_free, L::one());
    map(
        &cof,
        #[inline(always)]
        |entry| size * entry,
    )
}
