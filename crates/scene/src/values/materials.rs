//! Parts of a body with materials of their own.

use super::selection::{chosen, elements};
use crate::{BodyMesh, Material, Scene, SceneError};

/// Elements with the same material.
#[derive(Clone, Debug, PartialEq)]
pub struct MaterialRegion {
    /// The scene's table, such as `materials[0]`.
    pub name: String,
    /// Constitutive law and density.
    pub material: Material,
    /// Elements of the mesh, ascending and without repeats.
    pub elements: Vec<usize>,
}

/// The region of each `[[materials]]`: an element belongs to the last table that names it. Tables whose elements all belong to later
/// ones have no region.
pub(crate) fn regions(scene: &Scene, mesh: &BodyMesh) -> Result<Vec<MaterialRegion>, SceneError> {
    let mut owner = vec![None; mesh.elements()];
    for (number, table) in scene.materials.iter().enumerate() {
        let selector = chosen(table.selectors());
        for element in elements(scene, &format!("materials[{number}]"), &selector, mesh)? {
            owner[element] = Some(number);
        }
    }
    let region = |number: usize| MaterialRegion {
        name: format!("materials[{number}]"),
        material: Material { plane: scene.material.plane, ..scene.materials[number].material() },
        elements: (0..owner.len()).filter(|&element| owner[element] == Some(number)).collect(),
    };
    Ok((0..scene.materials.len()).map(region).filter(|region| !region.elements.is_empty()).collect())
}

/// Density of each element relative to that of `[material]`; empty for a body without regions.
pub(crate) fn density_factors(regions: &[MaterialRegion], density: f64, elements: usize) -> Vec<f64> {
    if regions.is_empty() {
        return Vec::new();
    }
    let mut factors = vec![1.0; elements];
    for region in regions {
        region.elements.iter().for_each(|&element| factors[element] = region.material.density / density);
    }
    factors
}
