//! Checks of `[[materials]]`.

use super::numbers::Problem;
use super::selector::check_one;
use crate::Scene;

pub(super) fn check(scene: &Scene) -> Result<(), Problem> {
    scene.materials.iter().enumerate().try_for_each(|(number, materials)| {
        let table = format!("materials[{number}]");
        check_one(&table, &materials.selectors(), "on, box, sphere and set")?;
        materials.material().check(&table)
    })
}
