//! Kernels: computations for one batch of elements, one element in each SIMD lane.

use super::Batch;
use crate::materials::{OfInvariants, OfRotation};
use crate::number::{Float, Lanes};
use crate::tensor::{Tensor, Tensor4, dot, zero};

/// A D×D block for each lane.
pub(super) type LaneBlock<L, const D: usize> = [[L; D]; D];

/// The vectors of the corners of each element but the first, less those of the first, in lanes like `like`: u_{e+1} − u_0.
#[inline(always)]
pub(super) fn corner_differences<L: Lanes, const D: usize, const E: usize, const N: usize>(
    like: L,
    corners: &[[u32; N]],
    u: &[[L::Element; 3]],
) -> [[L; D]; E] {
    let first = corner_vectors(like, corners, 0, u);
    let mut differences = [[like; D]; E];
    for e in 0..E {
        let x = corner_vectors(like, corners, e + 1, u);
        for i in 0..D {
            differences[e][i] = x[i] - first[i];
        }
    }
    differences
}

/// Displacement gradients G_ij = Σ_e (u_{e+1} − u_0)_i (∇φ_{e+1})_j. In the plane the third direction does not deform: plane strain.
#[inline(always)]
pub(super) fn displacement_gradient<L: Lanes, const D: usize, const E: usize>(
    batch: &Batch<L, D, E>,
    differences: &[[L; D]; E],
) -> Tensor<L> {
    let mut G = zero::<L>();
    for i in 0..D {
        for j in 0..D {
            G[i][j] = differences[0][i] * batch.gradients[0][j];
            for e in 1..E {
                G[i][j] = differences[e][i].times_plus(batch.gradients[e][j], G[i][j]);
            }
        }
    }
    G
}

/// The vectors of one corner of each element, in lanes like `like`.
#[inline(always)]
fn corner_vectors<L: Lanes, const N: usize>(
    like: L,
    corners: &[[u32; N]],
    corner: usize,
    vectors: &[[L::Element; 3]],
) -> [L; 3] {
    // Bounded by a constant, so that no lane needs to be checked.
    let corners = &corners[..L::LANES];
    like.gather(
        vectors,
        #[inline(always)]
        |lane| corners[lane][corner],
    )
}

/// Adds the gradient of the energy at a quadrature point by the positions of the element's corners but the first, V P ∇φ. The first point
/// begins the sum.
#[inline(always)]
pub(super) fn add_corner_gradients<L: Lanes, const D: usize, const E: usize>(
    batch: &Batch<L, D, E>,
    P: &Tensor<L>,
    is_first: bool,
    gradients: &mut [[L; D]; E],
) {
    for e in 0..E {
        for i in 0..D {
            let mut sum = P[i][0] * batch.gradients[e][0];
            for j in 1..D {
                sum = P[i][j].times_plus(batch.gradients[e][j], sum);
            }
            let sum = sum * batch.volume;
            gradients[e][i] = if is_first { sum } else { gradients[e][i] + sum };
        }
    }
}

/// The blocks of an element's Hessian before the first quadrature point has begun their sum.
#[inline(always)]
pub(super) fn no_blocks<L: Lanes, const D: usize, const E: usize>() -> [[LaneBlock<L, D>; E]; E] {
    [[[[L::zero(); D]; D]; E]; E]
}

/// Adds the blocks V Σ_jl H_(ij)(kl) (∇φ_a)_j (∇φ_b)_l of a quadrature point to the element's Hessian for corners a + 1 and b + 1, b ≤ a. The
/// first point begins the sum.
#[inline(always)]
pub(super) fn add_corner_blocks<L: Lanes, const D: usize, const E: usize>(
    batch: &Batch<L, D, E>,
    H: &Tensor4<L>,
    is_first: bool,
    blocks: &mut [[LaneBlock<L, D>; E]; E],
) {
    let zero = L::zero();
    for b in 0..E {
        // H contracted with ∇φ_b from the right, times the volume.
        let mut right = [[zero; D]; 9];
        for (row, right) in right.iter_mut().enumerate() {
            if row % 3 >= D || row / 3 >= D {
                continue;
            }
            for k in 0..D {
                let mut sum = H[row][3 * k] * batch.gradients[b][0];
                for l in 1..D {
                    sum = H[row][3 * k + l].times_plus(batch.gradients[b][l], sum);
                }
                right[k] = sum * batch.volume;
            }
        }
        for a in b..E {
            for i in 0..D {
                for k in 0..D {
                    let mut sum = right[3 * i][k] * batch.gradients[a][0];
                    for j in 1..D {
                        sum = right[3 * i + j][k].times_plus(batch.gradients[a][j], sum);
                    }
                    blocks[a][b][i][k] = if is_first { sum } else { blocks[a][b][i][k] + sum };
                }
            }
        }
    }
}

/// a · b
#[inline(always)]
fn inner<L: Lanes>(a: &[L; 3], b: &[L; 3]) -> L {
    a[2].times_plus(b[2], a[1].times_plus(b[1], a[0] * b[0]))
}

/// The same blocks for a law of invariants, without the 81 entries of H. With f_a = F ∇φ_a and c_a = cof ∇φ_a they are
/// V (a ∇φ_a·∇φ_b 1 + s f_a⊗f_b + t (f_a⊗c_b + c_a⊗f_b) + r c_a⊗c_b + b [F (∇φ_a × ∇φ_b)]), where [w]_ik = ε_ikm w_m.
#[inline(always)]
pub(super) fn add_invariant_blocks<L: Lanes, const D: usize, const E: usize>(
    batch: &Batch<L, D, E>,
    terms: &OfInvariants<L>,
    is_first: bool,
    blocks: &mut [[LaneBlock<L, D>; E]; E],
) {
    let zero = L::zero();
    let OfInvariants { F, cof, a, b, s, t, r } = *terms;
    let (a, b) = (a * batch.volume, b * batch.volume);
    let (mut g, mut f, mut c) = ([[zero; 3]; E], [[zero; D]; E], [[zero; D]; E]);
    for e in 0..E {
        g[e][..D].copy_from_slice(&batch.gradients[e]);
        for i in 0..D {
            f[e][i] = inner(&F[i], &g[e]);
            c[e][i] = inner(&cof[i], &g[e]);
        }
    }
    for column in 0..E {
        let (mut of_f, mut of_c) = ([zero; D], [zero; D]);
        for k in 0..D {
            of_f[k] = (s * f[column][k] + t * c[column][k]) * batch.volume;
            of_c[k] = (t * f[column][k] + r * c[column][k]) * batch.volume;
        }
        for row in column..E {
            let (x, y) = (&g[row], &g[column]);
            let along = a * inner(x, y);
            let block = &mut blocks[row][column];
            for i in 0..D {
                for k in 0..D {
                    let sum = f[row][i].times_plus(of_f[k], c[row][i] * of_c[k]);
                    block[i][k] = if is_first { sum } else { block[i][k] + sum };
                }
                block[i][i] += along;
            }
            if row == column {
                continue;
            }
            let cross = [x[1] * y[2] - x[2] * y[1], x[2] * y[0] - x[0] * y[2], x[0] * y[1] - x[1] * y[0]];
            for i in 0..D {
                let k = (i + 1) % 3;
                if k < D {
                    let m = 3 - i - k;
                    let w = b * inner(&F[m], &cross);
                    block[i][k] += w;
                    block[k][i] -= w;
                }
            }
        }
    }
}

/// The same blocks for a law of the rotation R, V (a ∇φ_a·∇φ_b 1 + b (R ∇φ_a)⊗(R ∇φ_b) + W_a c W_bᵀ), where row i of W_a is R_i × ∇φ_a.
#[inline(always)]
pub(super) fn add_rotation_blocks<L: Lanes, const D: usize, const E: usize>(
    batch: &Batch<L, D, E>,
    terms: &OfRotation<L>,
    is_first: bool,
    blocks: &mut [[LaneBlock<L, D>; E]; E],
) {
    let zero = L::zero();
    let OfRotation { R, identity, rotation, spin } = terms;
    let (identity, rotation) = (*identity * batch.volume, *rotation * batch.volume);
    let (mut g, mut r, mut W) = ([[zero; 3]; E], [[zero; D]; E], [[[zero; 3]; D]; E]);
    for e in 0..E {
        g[e][..D].copy_from_slice(&batch.gradients[e]);
        for i in 0..D {
            r[e][i] = inner(&R[i], &g[e]);
            for k in 0..3 {
                let (next, last) = ((k + 1) % 3, (k + 2) % 3);
                W[e][i][k] = R[i][next] * g[e][last] - R[i][last] * g[e][next];
            }
        }
    }
    for column in 0..E {
        let mut right = [[zero; 3]; D];
        for k in 0..D {
            for m in 0..3 {
                let w = &W[column][k];
                right[k][m] = inner(&spin[m], w) * batch.volume;
            }
        }
        for row in column..E {
            let (x, y) = (&g[row], &g[column]);
            let along = identity * inner(x, y);
            let block = &mut blocks[row][column];
            for i in 0..D {
                let (w, of_r) = (&W[row][i], rotation * r[row][i]);
                for k in 0..D {
                    let sum = of_r * r[column][k] + inner(w, &right[k]);
                    block[i][k] = if is_first { sum } else { block[i][k] + sum };
                }
                block[i][i] += along;
            }
        }
    }
}

/// All blocks with row ≥ column of an element's Hessian, from those of all corners but the first: the energy does not change
/// under translation, so each row of blocks adds up to zero, which gives the blocks of the first corner. Elements in the plane have no
/// stiffness in the third direction.
#[inline(always)]
pub(super) fn element_hessian<L: Lanes, const D: usize, const E: usize, const N: usize>(
    inner: &[[LaneBlock<L, D>; E]; E],
) -> [[LaneBlock<L, 3>; N]; N] {
    let zero = L::zero();
    let mut all = [[[[zero; 3]; 3]; N]; N];
    for a in 0..E {
        for b in 0..=a {
            for i in 0..D {
                all[a + 1][b + 1][i][..D].copy_from_slice(&inner[a][b][i]);
            }
        }
    }
    for a in 0..E {
        for i in 0..D {
            for k in 0..D {
                let mut sum = zero;
                for b in 0..E {
                    sum += if b <= a { inner[a][b][i][k] } else { inner[b][a][k][i] };
                }
                all[a + 1][0][i][k] = -sum;
                all[0][0][i][k] += sum;
            }
        }
    }
    all
}

/// Energy of a batch from its densities, J.
#[inline(always)]
pub(super) fn total_energy<L: Lanes, const D: usize, const E: usize>(batch: &Batch<L, D, E>, densities: L) -> f64 {
    // An element of no volume has no energy, whatever its lane contains.
    let zero = L::zero();
    let energies = (densities * batch.counted).select(batch.counted.gt(zero), zero);
    energies.as_slice().iter().map(|energy| energy.as_f64()).sum()
}

/// Σ V G:G of a batch, m³.
#[inline(always)]
pub(super) fn squares<L: Lanes, const D: usize, const E: usize>(batch: &Batch<L, D, E>, G: &Tensor<L>) -> f64 {
    let squares = dot(G, G) * batch.counted;
    squares.as_slice().iter().map(|squares| squares.as_f64()).sum()
}
