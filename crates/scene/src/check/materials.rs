//! Checks of `[[materials]]`.

use super::selector::check_one;
use crate::Scene;
use fem_model::Refusal;

pub(super) fn check(scene: &Scene) -> Result<(), Refusal> {
    scene.materials.iter().enumerate().try_for_each(|(number, materials)| {
        let table = format!("materials[{number}]");
        check_one(&table, &materials.selectors(), "on, box, sphere and set")?;
        materials.material().check(&table)
    })
}
