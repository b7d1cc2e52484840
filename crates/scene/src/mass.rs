//! The rule by which the mass matrix of a body is lumped.

use crate::Scene;

/// Largest number of nodes for which an explicit method takes the consistent mass by default. Its linear systems need some thirty
/// products for each evaluation of the forces, a lumped mass one division.
pub const CONSISTENT_MASS: usize = 2000;

/// Returns true if the mass matrix of a scene with so many nodes is lumped, see [`Body::lumped_mass`](crate::Body::lumped_mass).
pub fn lumps_mass(scene: &Scene, nodes: usize) -> bool {
    let method = scene.time.integrator;
    let by_default =
        method.needs_node_masses() || method.is_explicit() && (nodes > CONSISTENT_MASS || !scene.planes.is_empty());
    scene.mass.lumped.unwrap_or(by_default)
}
