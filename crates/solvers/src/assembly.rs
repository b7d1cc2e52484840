//! A matrix as a sum of terms, for solvers that assemble it on their own device.

#[cfg(feature = "gpu")]
use fem_gpu::{Law, Tetrahedra};

use fem_elements::sparse::Block;

/// Σ f K(u) + m M + others, with zero beside the diagonal in constrained directions.
pub struct Assembly<'a, T> {
    /// Factors f of the stiffness of the elements, and the displacements of all nodes at which it is taken, m.
    pub stiffness: &'a [(T, &'a [[T; 3]])],
    /// The factor m of the mass, 1/s².
    pub mass: T,
    /// Everything else: blocks of the pattern, with their numbers, N/m.
    pub others: &'a [(usize, Block<T, 3>)],
    /// 1 for each free direction of a node, 0 for a constrained one.
    pub free: &'a [[T; 3]],
}

/// The elements of a body, for a device that assembles matrices.
#[cfg(feature = "gpu")]
pub struct DeviceElements {
    /// Number of nodes of the body.
    pub nodes: usize,
    /// The elements, in the engine's numbering.
    pub tetrahedra: Tetrahedra,
    /// Their law.
    pub law: Law,
    /// Its parameters in each element, Pa.
    pub moduli: Vec<[f64; 2]>,
    /// Mass of each block of the matrix, kg.
    pub masses: Vec<f64>,
    /// Bounds of a diagonal entry of the undeformed stiffness (N/m) and of the mass matrix (kg).
    pub largest: [f64; 2],
}
