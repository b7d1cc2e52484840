//! A mesh of a study, with its reference.

use fem_model::BodyMesh;
use fem_scene::Scene;

use crate::reference::Reference;

/// A mesh of the study, with its reference.
pub(super) struct StudyMesh {
    pub mesh: BodyMesh,
    /// Weights of the nodes, m³.
    pub weights: Vec<f64>,
    pub hash: String,
    /// File of the reference.
    pub file: String,
    pub reference: Option<Reference>,
}

/// Cells per metre of a box, 0 for a mesh from a file.
pub(super) fn cells(scene: &Scene) -> usize {
    scene.mesh.cuboid.as_ref().map_or(0, |cuboid| cuboid.cells_per_unit)
}
