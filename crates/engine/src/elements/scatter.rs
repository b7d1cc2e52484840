//! Contributions of a batch to the nodes and blocks of its chunk.

use super::Chunk;
use super::build::NONE;
use super::kernel::{LaneBlock, element_hessian};
use crate::number::Lanes;
use crate::sparse::Block;
use crate::tensor::transpose;

/// Adds what the corners of a batch contribute to the nodes of its chunk.
#[inline(always)]
pub(super) fn scatter<L: Lanes, const D: usize, const E: usize, const N: usize>(
    chunk: &Chunk<L::Element, D, E, N>,
    corners: &[[u32; N]],
    gradients: &[[L; D]; E],
    sums: &mut [[L::Element; 3]],
) {
    let first = chunk.nodes.start as u32;
    // Bounded by a constant, so that no lane needs to be checked.
    for lane in 0..L::LANES {
        let corners = &corners[lane];
        let mut of_first = [L::Element::default(); D];
        for e in 0..E {
            let mut value = [L::Element::default(); D];
            for i in 0..D {
                value[i] = gradients[e][i].as_slice()[lane];
            }
            for i in 0..D {
                of_first[i] -= value[i];
            }
            // A node of another chunk is out of range.
            if let Some(sum) = sums.get_mut(corners[e + 1].wrapping_sub(first) as usize) {
                for i in 0..D {
                    sum[i] += value[i];
                }
            }
        }
        if let Some(sum) = sums.get_mut(corners[0].wrapping_sub(first) as usize) {
            for i in 0..D {
                sum[i] += of_first[i];
            }
        }
    }
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
