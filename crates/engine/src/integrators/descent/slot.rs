//! One element around each node of a batch.

use fem_elements::number::Float;

/// One element around the node in each lane, E = N − 1 of whose nodes are others. A copy of the element's shape for each of its nodes makes
/// a sweep read memory in order.
#[derive(Clone)]
pub(super) struct Slot<T: Float, const E: usize> {
    /// Gradients of the shape functions of the other nodes, 1/m; the third direction of triangles is zero.
    pub gradients: [[T::Lanes; 3]; E],
    /// Volume times a factor of the element's moduli, m³; zero in lanes without an element.
    pub volume: T::Lanes,
}
