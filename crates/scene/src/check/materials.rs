//! Checks of `[[materials]]`.

use super::selector::check_one;
use crate::Scene;
use crate::tables::Pipeline;
use fem_model::Refusal;
use fem_model::numbers::problem;

pub(super) fn check(scene: &Scene) -> Result<(), Refusal> {
    if scene.pipeline == Pipeline::Course && scene.material.volumetric.is_some() {
        return problem("material.volumetric", "belongs to the engine; write pipeline = \"engine\", or remove it");
    }
    scene.materials.iter().enumerate().try_for_each(|(number, materials)| {
        let table = format!("materials[{number}]");
        check_one(&table, &materials.selectors(), "on, box, sphere and set")?;
        materials.material().check(&table)
    })
}
