//! Parts of a body with materials of their own.

use crate::Material;

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

/// Density of each element relative to that of `[material]`; empty for a body without regions.
pub fn density_factors(regions: &[MaterialRegion], density: f64, elements: usize) -> Vec<f64> {
    if regions.is_empty() {
        return Vec::new();
    }
    let mut factors = vec![1.0; elements];
    for region in regions {
        region.elements.iter().for_each(|&element| factors[element] = region.material.density / density);
    }
    factors
}
