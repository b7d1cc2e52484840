//! Checks of `[[fibres]]`.

use super::selector::check_one;
use crate::Scene;
use crate::tables::FibresTable;
use fem_model::Refusal;
use fem_model::numbers::problem;

pub(super) fn check(scene: &Scene) -> Result<(), Refusal> {
    let mut tables = scene.fibres.iter().enumerate();
    tables.try_for_each(|(number, fibres)| check_family(&format!("fibres[{number}]"), fibres))
}

fn check_family(table: &str, fibres: &FibresTable) -> Result<(), Refusal> {
    match &fibres.selectors()[..] {
        [] => {}
        selectors => check_one(table, selectors, "on, box, sphere and set")?,
    }
    fibres.law().check(table)?;
    let given = [fibres.direction.is_some(), fibres.around.is_some(), fibres.per_element.is_some()];
    if given.into_iter().filter(|is_given| *is_given).count() != 1 {
        return problem(table, "needs one of direction, around and per_element; give one and only one");
    }
    fibres.directions().map_or(Ok(()), |directions| directions.check(table))
}
