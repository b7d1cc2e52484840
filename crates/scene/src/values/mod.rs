//! A scene's tables as values: SI units, the mesh's node numbers, defaults filled in.

mod constraints;
mod initial;
mod loads;
mod method;

pub use constraints::{DirichletCondition, Motion, Rotation};
pub use loads::{Drag, Pressure, Spring, Traction};
pub use method::{Method, NewtonSettings, RayleighDamping, SolverSettings};

pub(crate) use constraints::dirichlet_conditions;
pub(crate) use initial::initial_velocity;
pub(crate) use loads::{curve, drag, springs, surface_loads};
pub(crate) use method::damping;

use crate::{Scene, SceneError};
use fem_mesh::TetrahedralMesh;

/// Listed nodes, ascending and without repeats. Refuses a node that the mesh does not have.
fn listed(scene: &Scene, field: &str, nodes: &[usize], mesh: &TetrahedralMesh) -> Result<Vec<usize>, SceneError> {
    let mut nodes = nodes.to_vec();
    nodes.sort_unstable();
    nodes.dedup();
    match nodes.last() {
        Some(&node) if node >= mesh.vertices.len() => {
            let last = mesh.vertices.len() - 1;
            Err(scene.refuse(field, &format!("names node {node}; the mesh has nodes 0 to {last}")))
        }
        _ => Ok(nodes),
    }
}
