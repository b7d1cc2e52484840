//! The materials of a scene.

use fem_model::{BodyMesh, Material, MaterialRegion, Refusal, elements};

use super::chosen;
use crate::Scene;

/// The region of each `[[materials]]`: an element belongs to the last table that names it. Tables whose elements all belong to later
/// ones have no region.
pub(crate) fn regions(scene: &Scene, mesh: &BodyMesh) -> Result<Vec<MaterialRegion>, Refusal> {
    let mut owner = vec![None; mesh.elements()];
    for (number, table) in scene.materials.iter().enumerate() {
        let selector = chosen(table.selectors());
        for element in elements(&format!("materials[{number}]"), &selector, mesh)? {
            owner[element] = Some(number);
        }
    }
    let region = |number: usize| MaterialRegion {
        name: format!("materials[{number}]"),
        material: Material {
            plane: scene.material.plane.unwrap_or_default(),
            ..scene.materials[number].material().value()
        },
        elements: (0..owner.len()).filter(|&element| owner[element] == Some(number)).collect(),
    };
    Ok((0..scene.materials.len()).map(region).filter(|region| !region.elements.is_empty()).collect())
}
