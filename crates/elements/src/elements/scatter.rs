//! Contributions of a batch to the nodes and blocks of its chunk.

use super::Chunk;
use super::build::NONE;
use super::kernel::{LaneBlock, element_hessian};
use crate::number::Lanes;
use crate::sparse::Block;
use crate::tensor::transpose;

/// Adds the contributions of the corners of a batch to the nodes of its chunk.
#[inline(always)]
pub(super) fn scatter<L: Lanes, const D: usize, const E: usize, const N: usize>(
    chunk: &Chunk<L::Element, D, E, N>,
    corners: &[[u32; N]],
    gradients: &[[L; D]; E],
    sums: &mut [[L::Element; 3]],
) {
    let first = chunk.nodes.start as u32;
    let mut of_first = [L::zero(); 3];
    for e in 0..E {
        let mut vectors = [L::zero(); 3];
        vectors[..D].copy_from_slice(&gradients[e]);
        for i in 0..D {
            of_first[i] -= vectors[i];
        }
        add_corner(&vectors, corners, e + 1, first, sums);
    }
    add_corner(&of_first, corners, 0, first, sums);
}

/// Adds the vectors of one corner of each element to the rows of a chunk whose first node is `first`.
#[inline(always)]
fn add_corner<L: Lanes, const N: usize>(
    vectors: &[L; 3],
    corners: &[[u32; N]],
    corner: usize,
    first: u32,
    sums: &mut [[L::Element; 3]],
) {
    // Bounded by a constant, so that no lane needs to be checked.
    let corners = &corners[..L::LANES];
    // A node of another chunk is out of range.
    L::add_vectors_by_lane(
        vectors,
        sums,
        #[inline(always)]
        |lane| corners[lane][corner].wrapping_sub(first),
    );
}

/// Adds the Hessian of a batch, of which the blocks of all corners but the first are given, to the rows of its chunk.
#[inline(always)]
pub(super) fn add_hessian<L: Lanes, const D: usize, const E: usize, const N: usize>(
    chunk: &Chunk<L::Element, D, E, N>,
    batch: usize,
    inner: &[[LaneBlock<L, D>; E]; E],
    values: &mut [Block<L::Element, 3>],
) {
    let hessian = element_hessian::<L, D, E, N>(inner);
    let targets = &chunk.targets[batch * L::LANES..(batch + 1) * L::LANES];
    for a in 0..N {
        for b in 0..=a {
            // A pair without a block, or whose row belongs to another chunk, is out of range.
            L::add_by_lane(&hessian[a][b], values, |lane| targets[lane][a][b]);
            if a != b && targets.iter().any(|targets| targets[b][a] != NONE) {
                let transposed = transpose(&hessian[a][b]);
                L::add_by_lane(&transposed, values, |lane| targets[lane][b][a]);
            }
        }
    }
}
