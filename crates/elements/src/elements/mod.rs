//! Assembly over all elements: energy, its gradient, its Hessian as a sparse matrix, and stresses.
//!
//! Elements lie side by side in batches, one in each lane of a register, and are written for D dimensions: tetrahedra in
//! space, triangles of the plane z = 0. An element here has one quadrature point, where the displacement gradient is
//! Σ_e (u_{e+1} − u_0) ⊗ ∇φ_{e+1}: a sum over its E = N − 1 nodes but the first, since shape functions add up to one. A simplex has
//! constant gradients and needs one point; an element with more is as many such elements on the same nodes
//! ([`at_points`](Elements::at_points)), which quadratic tetrahedra add up before they are scattered. Nodes have three coordinates in all of them; triangles read and move the first two. Nodes are divided into chunks; each chunk computes all elements
//! that touch its nodes and sums up its own rows alone. Elements between chunks are computed twice, no two threads write to one place, and
//! sums come out the same with any number of threads.

mod assembly;
mod build;
mod chunk_sums;
mod kernel;
mod laws;
mod parallel;
mod scatter;
mod stress;

use std::ops::Range;

use crate::number::Float;
pub(crate) use chunk_sums::smaller;
pub use laws::BatchLaws;

/// All elements of a mesh, with `N = E + 1` nodes each in `D` dimensions, in batches, with the targets of their scatter.
#[derive(Clone, Debug)]
pub struct Elements<T: Float, const D: usize, const E: usize, const N: usize> {
    chunks: Vec<Chunk<T, D, E, N>>,
    /// Number of elements, which is that of the quadrature points.
    pub count: usize,
}

/// Nodes whose rows are assembled together, and the elements that touch them.
#[derive(Clone, Debug)]
struct Chunk<T: Float, const D: usize, const E: usize, const N: usize> {
    /// Nodes whose rows are assembled here.
    nodes: Range<usize>,
    /// Blocks of their rows.
    blocks: Range<usize>,
    /// Number of elements.
    count: usize,
    /// Nodes of each element in ascending order, lane after lane; the last batch is filled up with copies of its last element, which have no
    /// volume.
    corners: Vec<[u32; N]>,
    /// Block that each pair of nodes is added to, counted from the first of `blocks`; pairs without a block have a target
    /// beyond the last. Empty where no matrix is assembled.
    targets: Vec<[[u32; N]; N]>,
    /// The first quadrature points of as many elements as there are lanes, then their second ones.
    batches: Vec<Batch<T::Lanes, D, E>>,
    /// Number of each lane's quadrature point in the list that the elements were made from.
    elements: Vec<u32>,
}

/// The undeformed shape of as many elements as there are lanes.
#[derive(Clone, Copy, Debug)]
struct Batch<L, const D: usize, const E: usize> {
    /// Gradients of the shape functions, 1/m: row e is that of node e + 1. Of a simplex it is the inverse of the edge matrix.
    gradients: [[L; D]; E],
    /// Volume, m³ (area in the plane, m²).
    volume: L,
    /// The volume where this chunk counts the element's energy, zero where another does.
    counted: L,
}

impl<T: Float, const D: usize, const E: usize, const N: usize> Elements<T, D, E, N> {
    /// Number of chunks, which threads compute side by side.
    pub fn chunks(&self) -> usize {
        self.chunks.len()
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        let of_chunk = |chunk: &Chunk<T, D, E, N>| {
            size_of_val(&chunk.corners[..])
                + size_of_val(&chunk.targets[..])
                + size_of_val(&chunk.batches[..])
                + size_of_val(&chunk.elements[..])
        };
        self.chunks.iter().map(of_chunk).sum()
    }
}
