//! Energy, gradient and block of the elements around the nodes of a batch.
//!
//! With the node in question as the first, G = Σ_a (u_a − u) ⊗ ∇φ_a over the other nodes, and its own ∇φ is −Σ_a ∇φ_a. Gradient and block are
//! V P ∇φ and V Σ_jl H_(ij)(kl) (∇φ)_j (∇φ)_l, of which no other entry of the element's Hessian is needed.

use pulp::{Simd, WithSimd};

use super::search::Change;
use super::slot::Slot;
use super::sums::{Sums, UPPER};
use crate::integrators::relaxation::inner;
use fem_elements::materials::{Law, OfInvariants, OfRotation, Terms};
use fem_elements::number::Float;
use fem_elements::number::Lanes;
use fem_elements::tensor::{Tensor, Tensor4, cofactor, half, plus_identity, volume_change, zero};

/// Adds gradients and blocks of batches of one colour.
pub(super) struct SumsOf<'a, L: Lanes, W: Law<L> + ?Sized, const E: usize> {
    pub law: &'a W,
    pub allows_inversion: bool,
    /// All slots of the material, and the first of each batch.
    pub slots: &'a [Slot<L::Element, E>],
    pub others: &'a [[u32; E]],
    pub starts: &'a [usize],
    /// Nodes of the batches.
    pub lanes: &'a [u32],
    pub u: &'a [[L::Element; 3]],
    pub sums: &'a mut [Sums<<L::Element as Float>::Lanes>],
}

impl<L: Lanes, W: Law<L> + ?Sized, const E: usize> WithSimd for SumsOf<'_, L, W, E> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { law, allows_inversion, slots, others, starts, lanes, u, sums } = self;
        for i in 0..sums.len() * L::PARTS {
            let (batch, part) = (i / L::PARTS, i % L::PARTS);
            let own = places_of(&lanes[i * L::LANES..][..L::LANES], u);
            let mut of_part = Sums::<L>::load(&sums[batch], part);
            for slot in starts[batch]..starts[batch + 1] {
                let others = &others[(slot * L::PARTS + part) * L::LANES..][..L::LANES];
                let (G, gradient, volume) = deformation(&slots[slot], part, others, &own, u);
                add_element::<L, W, E>(law, allows_inversion, &G, &gradient, volume, &mut of_part);
            }
            of_part.store(&mut sums[batch], part);
        }
    }
}

/// Adds the change of the energy of one batch as its nodes move.
pub(super) struct ChangesOf<'a, L: Lanes, W: Law<L> + ?Sized, const E: usize> {
    pub law: &'a W,
    pub allows_inversion: bool,
    /// Slots of the batch.
    pub slots: &'a [Slot<L::Element, E>],
    pub others: &'a [[u32; E]],
    pub lanes: &'a [u32],
    pub u: &'a [[L::Element; 3]],
    pub change: &'a mut Change<L::Element>,
}

impl<L: Lanes, W: Law<L> + ?Sized, const E: usize> WithSimd for ChangesOf<'_, L, W, E> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { law, allows_inversion, slots, others, lanes, u, change } = self;
        let one = L::one();
        for part in 0..L::PARTS {
            let own = places_of(&lanes[part * L::LANES..][..L::LANES], u);
            let (mut total, mut size) = (one.load(&change.energy, part), one.load(&change.size, part));
            let mut step = [one; 3];
            for i in 0..3 {
                step[i] = one.load(&change.step[i], part);
            }
            for (slot, of_slot) in slots.iter().enumerate() {
                let others = &others[(slot * L::PARTS + part) * L::LANES..][..L::LANES];
                let (G, gradient, volume) = deformation(of_slot, part, others, &own, u);
                let mut after = G;
                for i in 0..3 {
                    for j in 0..3 {
                        after[i][j] = step[i].times_plus(gradient[j], after[i][j]);
                    }
                }
                let (before, after) = energies(law, allows_inversion, &G, &after);
                // A lane without an element has no volume, whatever its energy.
                let counts = volume.gt(L::zero());
                total += (volume * (after - before)).select(counts, L::zero());
                size += (volume * (after.abs() + before.abs())).select(counts, L::zero());
            }
            total.store(&mut change.energy, part);
            size.store(&mut change.size, part);
        }
    }
}

/// Displacements of the nodes of a batch, m.
#[inline(always)]
fn places_of<L: Lanes>(lanes: &[u32], u: &[[L::Element; 3]]) -> [L; 3] {
    L::one().gather(
        u,
        #[inline(always)]
        |lane| lanes[lane],
    )
}

/// G, the gradient of the node's own shape function (1/m), and the volume (m³) of one element around each node.
#[inline(always)]
fn deformation<L: Lanes, const E: usize>(
    slot: &Slot<L::Element, E>,
    part: usize,
    others: &[[u32; E]],
    own: &[L; 3],
    u: &[[L::Element; 3]],
) -> (Tensor<L>, [L; 3], L) {
    let (one, others) = (L::one(), &others[..L::LANES]);
    let (mut G, mut gradient) = (zero::<L>(), [L::zero(); 3]);
    for a in 0..E {
        let x = one.gather(
            u,
            #[inline(always)]
            |lane| others[lane][a],
        );
        let mut of_other = [one; 3];
        for j in 0..3 {
            of_other[j] = one.load(&slot.gradients[a][j], part);
            gradient[j] -= of_other[j];
        }
        for i in 0..3 {
            let difference = x[i] - own[i];
            for j in 0..3 {
                G[i][j] = difference.times_plus(of_other[j], G[i][j]);
            }
        }
    }
    (G, gradient, one.load(&slot.volume, part))
}

#[inline(always)]
fn add_element<L: Lanes, W: Law<L> + ?Sized, const E: usize>(
    law: &W,
    allows_inversion: bool,
    G: &Tensor<L>,
    gradient: &[L; 3],
    volume: L,
    sums: &mut Sums<L>,
) {
    let mut P = law.stress(G);
    let mut block = match law.terms(G) {
        Terms::Invariants(terms) => invariant_block(&terms, gradient),
        Terms::Rotation(terms) => rotation_block(&terms, gradient),
        Terms::Entries => general_block(&law.derivative(G), gradient),
    };
    let square = inner(gradient, gradient);
    let mut sharpness = square;
    if !allows_inversion {
        let J = volume_change(G).0 + L::one();
        let is_upright = J.gt(L::zero());
        // J is an affine function of the node's place, with this slope.
        let cof = cofactor(&plus_identity(G));
        let slope = [inner(&cof[0], gradient), inner(&cof[1], gradient), inner(&cof[2], gradient)];
        let relative = inner(&slope, &slope) / (J * J);
        sharpness = sharpness.max(relative.select(is_upright, square));
        if !L::all(is_upright) {
            // Where the law has no stress, the element is a linear one until it is upright again.
            let H = law.derivative(&zero());
            let rest = general_block(&H, gradient);
            let linear = linear_stress(&H, G);
            for i in 0..6 {
                block[i] = block[i].select(is_upright, rest[i]);
            }
            for i in 0..3 {
                for j in 0..3 {
                    P[i][j] = P[i][j].select(is_upright, linear[i][j]);
                }
            }
        }
    }
    for i in 0..3 {
        sums.gradient[i] = volume.times_plus(inner(&P[i], gradient), sums.gradient[i]);
    }
    for (entry, (row, column)) in UPPER.into_iter().enumerate() {
        // Triangles have no stiffness across their plane.
        if E == 3 || (row < 2 && column < 2) {
            sums.block[entry] = volume.times_plus(block[entry], sums.block[entry]);
        }
    }
    sums.sharpness = sums.sharpness.max(sharpness);
}

/// Energy densities before and after a node's step, J/m³. An inverted element whose law has no energy there has that of a linear one.
#[inline(always)]
fn energies<L: Lanes, W: Law<L> + ?Sized>(law: &W, allows_inversion: bool, G: &Tensor<L>, after: &Tensor<L>) -> (L, L) {
    let energies = (law.energy(G), law.energy(after));
    let is_upright = (volume_change(G).0 + L::one()).gt(L::zero());
    if allows_inversion || L::all(is_upright) {
        return energies;
    }
    let H = law.derivative(&zero());
    let linear = (linear_energy(&H, G), linear_energy(&H, after));
    (energies.0.select(is_upright, linear.0), energies.1.select(is_upright, linear.1))
}

/// H G
#[inline(always)]
fn linear_stress<L: Lanes>(H: &Tensor4<L>, G: &Tensor<L>) -> Tensor<L> {
    let mut P = zero::<L>();
    for row in 0..9 {
        for column in 0..9 {
            P[row / 3][row % 3] = H[row][column].times_plus(G[column / 3][column % 3], P[row / 3][row % 3]);
        }
    }
    P
}

/// ½ G:H G
#[inline(always)]
fn linear_energy<L: Lanes>(H: &Tensor4<L>, G: &Tensor<L>) -> L {
    half::<L>() * fem_elements::tensor::dot(G, &linear_stress(H, G))
}

/// a |∇φ|² 1 + s f⊗f + t (f⊗c + c⊗f) + r c⊗c with f = F ∇φ and c = cof ∇φ: that of ∂cof/∂F vanishes.
#[inline(always)]
fn invariant_block<L: Lanes>(terms: &OfInvariants<L>, gradient: &[L; 3]) -> [L; 6] {
    let OfInvariants { F, cof, a, s, t, r, .. } = terms;
    let f = [inner(&F[0], gradient), inner(&F[1], gradient), inner(&F[2], gradient)];
    let c = [inner(&cof[0], gradient), inner(&cof[1], gradient), inner(&cof[2], gradient)];
    let along = *a * inner(gradient, gradient);
    let mut block = [L::zero(); 6];
    for (entry, (i, k)) in UPPER.into_iter().enumerate() {
        let (of_f, of_c) = (s.times_plus(f[k], *t * c[k]), t.times_plus(f[k], *r * c[k]));
        block[entry] = f[i].times_plus(of_f, c[i] * of_c);
        if i == k {
            block[entry] += along;
        }
    }
    block
}

/// a |∇φ|² 1 + b (R ∇φ)⊗(R ∇φ) + W c Wᵀ, where row i of W is R_i × ∇φ.
#[inline(always)]
fn rotation_block<L: Lanes>(terms: &OfRotation<L>, gradient: &[L; 3]) -> [L; 6] {
    let OfRotation { R, identity, rotation, spin } = terms;
    let along = *identity * inner(gradient, gradient);
    let (mut r, mut W, mut right) = ([L::zero(); 3], zero::<L>(), zero::<L>());
    for i in 0..3 {
        r[i] = inner(&R[i], gradient);
        for k in 0..3 {
            let (next, last) = ((k + 1) % 3, (k + 2) % 3);
            W[i][k] = R[i][next] * gradient[last] - R[i][last] * gradient[next];
        }
        for m in 0..3 {
            right[i][m] = inner(&spin[m], &W[i]);
        }
    }
    let mut block = [L::zero(); 6];
    for (entry, (i, k)) in UPPER.into_iter().enumerate() {
        block[entry] = (*rotation * r[i]).times_plus(r[k], inner(&W[i], &right[k]));
        if i == k {
            block[entry] += along;
        }
    }
    block
}

/// Σ_jl H_(ij)(kl) (∇φ)_j (∇φ)_l
#[inline(always)]
fn general_block<L: Lanes>(H: &Tensor4<L>, gradient: &[L; 3]) -> [L; 6] {
    let mut block = [L::zero(); 6];
    for (entry, (i, k)) in UPPER.into_iter().enumerate() {
        for j in 0..3 {
            let row = &H[3 * i + j];
            let right = inner(&[row[3 * k], row[3 * k + 1], row[3 * k + 2]], gradient);
            block[entry] = gradient[j].times_plus(right, block[entry]);
        }
    }
    block
}
