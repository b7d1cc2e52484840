//! Assembly over all elements: energy, its gradient, its Hessian as a sparse matrix, and stresses.
//!
//! Elements lie side by side in batches, one in each lane of a register, and are written for D dimensions: tetrahedra in
//! space, triangles of the plane z = 0 in plane strain. Nodes have three coordinates in both; triangles read and move the first two. Nodes are divided into chunks; each chunk computes all elements that touch its nodes and
//! sums up its own rows alone. Elements between chunks are computed twice, no two threads write to one place, and sums come
//! out the same with any number of threads.

mod assembly;
mod build;
mod kernel;
mod laws;
mod parallel;
mod stress;

#[cfg(test)]
mod tests;

use std::ops::Range;

use crate::number::Real;
pub use laws::BatchLaws;

/// All elements of a mesh of simplices with `N = D + 1` corners, in batches, with the targets of their scatter.
#[derive(Clone, Debug)]
pub struct Elements<T: Real, const D: usize, const N: usize> {
    chunks: Vec<Chunk<T, D, N>>,
    /// Number of elements.
    pub count: usize,
}

/// Nodes whose rows are assembled together, and the elements that touch them.
#[derive(Clone, Debug)]
struct Chunk<T: Real, const D: usize, const N: usize> {
    /// Nodes whose rows are assembled here.
    nodes: Range<usize>,
    /// Blocks of their rows.
    blocks: Range<usize>,
    /// Corners of each element, lane after lane; the last batch is filled up with elements of no volume.
    corners: Vec<[u32; N]>,
    /// Block that each pair of corners is added to, counted from the first of `blocks`; pairs without a block have a target
    /// beyond the last.
    targets: Vec<[[u32; N]; N]>,
    batches: Vec<Batch<T, D>>,
    /// Number of each element in the mesh.
    elements: Vec<u32>,
}

/// The undeformed shape of as many elements as there are lanes.
#[derive(Clone, Copy, Debug)]
struct Batch<T: Real, const D: usize> {
    /// Inverse of the edge matrix, 1/m: row e is the gradient of the shape function of corner e + 1.
    inverse: [[T::Lanes; D]; D],
    /// Volume, m³ (area in the plane, m²).
    volume: T::Lanes,
    /// The volume where this chunk counts the element's energy, zero where another does.
    counted: T::Lanes,
}

impl<T: Real, const D: usize, const N: usize> Elements<T, D, N> {
    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        let of_chunk = |chunk: &Chunk<T, D, N>| {
            size_of_val(&chunk.corners[..])
                + size_of_val(&chunk.targets[..])
                + size_of_val(&chunk.batches[..])
                + size_of_val(&chunk.elements[..])
        };
        self.chunks.iter().map(of_chunk).sum()
    }
}
