//! Corrections of the nodes of a batch of elements.

use pulp::{Simd, WithSimd};

use super::batch::Batch;
use super::rule::{Rule, Sweep};
use super::scalar::{by_energy, by_volume};
use super::stress::change_of_stress;
use crate::integrators::relaxation::inner;
use fem_elements::materials::Law;
use fem_elements::number::Float;
use fem_elements::number::{Lanes, Number, constant};
use fem_elements::tensor::{Tensor, half, map, volume_change, zero};

/// Part of det F that a correction keeps at least, and most halvings of it.
const KEPT: f64 = 0.1;
const HALVINGS: usize = 12;

/// Corrects batches of one colour.
pub(super) struct CorrectionsOf<'a, L: Lanes, const N: usize> {
    pub law: &'a dyn Law<L>,
    pub allows_inversion: bool,
    pub sweep: Sweep,
    pub batches: &'a mut [Batch<L::Element, N>],
    pub moves: &'a mut [[[<L::Element as Float>::Lanes; 3]; N]],
    pub corners: &'a [[u32; N]],
    pub u: &'a [[L::Element; 3]],
}

impl<L: Lanes, const N: usize> WithSimd for CorrectionsOf<'_, L, N> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { law, allows_inversion, sweep, batches, moves, corners, u } = self;
        let one = L::one();
        let (dt2, dt) = (constant::<L>(sweep.dt2), constant::<L>(sweep.dt2.sqrt()));
        for (i, corners) in corners.chunks_exact(L::LANES).enumerate() {
            let (batch, part) = (&mut batches[i / L::PARTS], i % L::PARTS);
            let gradients = batch.gradients.map(|g| g.map(|g| one.load(&g, part)));
            let masses = batch.inverse_masses.map(|m| m.map(|m| one.load(&m, part)));
            let mut multiplier = map(
                &batch.multiplier,
                #[inline(always)]
                |entry| one.load(&entry, part),
            );
            let G = displacement_gradient(&gradients, corners, u);
            let pressed = dt2 * one.load(&batch.volume, part);
            let (factor, direction, change) = match sweep.rule {
                Rule::Stress => {
                    let factors = batch.factors.map(|l| {
                        map(
                            &l,
                            #[inline(always)]
                            |entry| dt * one.load(&entry, part),
                        )
                    });
                    let change = change_of_stress(law, allows_inversion, &G, &multiplier, &factors);
                    (pressed, change, change)
                }
                Rule::Energy => {
                    let (direction, change) = by_energy(law, &G, multiplier[0][0], pressed, &gradients, &masses);
                    let mut of_first = zero::<L>();
                    of_first[0][0] = change;
                    (
                        pressed,
                        map(
                            &direction,
                            #[inline(always)]
                            |entry| -(entry * change),
                        ),
                        of_first,
                    )
                }
                Rule::Volume { stiffness } => (one, by_volume(constant(stiffness), &G, &gradients, &masses), zero()),
            };
            let mut corrections = [[L::zero(); 3]; N];
            for a in 0..N {
                for i in 0..3 {
                    corrections[a][i] = -(factor * masses[a][i] * inner(&direction[i], &gradients[a]));
                }
            }
            let feasible = if allows_inversion { one } else { feasible_part(&G, &corrections, &gradients) };
            let moves = &mut moves[i / L::PARTS];
            for a in 0..N {
                for i in 0..3 {
                    (feasible * corrections[a][i]).store(&mut moves[a][i], part);
                }
            }
            for i in 0..3 {
                for j in 0..3 {
                    multiplier[i][j] = feasible.times_plus(change[i][j], multiplier[i][j]);
                    multiplier[i][j].store(&mut batch.multiplier[i][j], part);
                }
            }
        }
    }
}

/// G_ij = Σ_a (u_a − u_0)_i (∇φ_a)_j.
#[inline(always)]
fn displacement_gradient<L: Lanes, const N: usize>(
    gradients: &[[L; 3]; N],
    corners: &[[u32; N]],
    u: &[[L::Element; 3]],
) -> Tensor<L> {
    let mut G = zero::<L>();
    let mut difference = [L::zero(); 3];
    for a in 1..N {
        for (lane, corners) in corners.iter().enumerate().take(L::LANES) {
            let (x, first) = (u[corners[a] as usize], u[corners[0] as usize]);
            for i in 0..3 {
                difference[i].as_mut_slice()[lane] = x[i] - first[i];
            }
        }
        for i in 0..3 {
            for j in 0..3 {
                G[i][j] = difference[i].times_plus(gradients[a][j], G[i][j]);
            }
        }
    }
    G
}

/// The largest of 1, ½, ¼ … that leaves a tenth of det F; 1 where the element is inverted.
#[inline(always)]
fn feasible_part<L: Number, const N: usize>(G: &Tensor<L>, corrections: &[[L; 3]; N], gradients: &[[L; 3]; N]) -> L {
    let mut change = zero::<L>();
    for a in 0..N {
        for i in 0..3 {
            for j in 0..3 {
                change[i][j] = corrections[a][i].times_plus(gradients[a][j], change[i][j]);
            }
        }
    }
    let J = volume_change(G).0 + L::one();
    let least = (constant::<L>(KEPT) * J).select(J.gt(L::zero()), constant(f64::from(f32::MIN)));
    let mut part = L::one();
    for _ in 0..HALVINGS {
        let mut after = *G;
        for i in 0..3 {
            for j in 0..3 {
                after[i][j] = part.times_plus(change[i][j], after[i][j]);
            }
        }
        let keeps = (volume_change(&after).0 + L::one()).ge(least);
        if L::all(keeps) {
            break;
        }
        part = part.select(keeps, half::<L>() * part);
    }
    part
}
