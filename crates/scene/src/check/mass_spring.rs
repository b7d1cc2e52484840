//! Checks of `[material]` with `model = "mass_spring"`: tables and keys that need elastic elements.

use crate::Scene;
use fem_model::Refusal;
use fem_model::numbers::problem;

pub(super) fn check(scene: &Scene) -> Result<(), Refusal> {
    if let Some(number) = scene.materials.iter().position(|table| table.material().is_mass_spring()) {
        let text = "is \"mass_spring\", which is a model of whole bodies: an edge between two materials has no stiffness of its own; \
                    write a law, or make it the model of [material] and remove [[materials]]";
        return problem(&format!("materials[{number}].model"), text);
    }
    if !scene.material.is_mass_spring() {
        return Ok(());
    }
    if !scene.materials.is_empty() {
        let text = "gives elements a law, and material.model = \"mass_spring\" has no elastic elements; remove it, or write a law in \
                    [material]";
        return problem("materials[0]", text);
    }
    if scene.material.plane.is_some() {
        let text = "is a state of elastic elements, and material.model = \"mass_spring\" has none: its springs lie in the plane; \
                    remove it";
        return problem("material.plane", text);
    }
    if scene.mesh.order == 2 {
        let text = "is 2, and the springs of material.model = \"mass_spring\" are the edges of linear elements; write 1, and refine = 1 \
                    for more springs";
        return problem("mesh.order", text);
    }
    Ok(())
}
