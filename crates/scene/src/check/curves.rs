//! Checks of `curve` in every table that has it.

use crate::Scene;
use crate::tables::CurveTable;
use fem_model::numbers::problem;
use fem_model::{Integrator, Refusal};

pub(super) fn check(scene: &Scene) -> Result<(), Refusal> {
    let gravity = scene.gravity.iter().map(|table| ("gravity".to_owned(), &table.curve));
    let body_force = scene.body_force.iter().map(|table| ("body_force".to_owned(), &table.curve));
    let numbered = |table: &str, number: usize| format!("{table}[{number}]");
    let tractions = scene.traction.iter().enumerate().map(|(i, table)| (numbered("traction", i), &table.curve));
    let forces = scene.force.iter().enumerate().map(|(i, table)| (numbered("force", i), &table.curve));
    let prescribed = scene.prescribed.iter().enumerate().map(|(i, table)| (numbered("prescribed", i), &table.curve));
    let curves = gravity.chain(body_force).chain(tractions).chain(forces).chain(prescribed);
    let given = curves.filter_map(|(table, curve)| Some((format!("{table}.curve"), curve.as_ref()?)));
    given.into_iter().try_for_each(|(field, curve)| check_curve(scene, &field, curve))
}

fn check_curve(scene: &Scene, field: &str, curve: &CurveTable) -> Result<(), Refusal> {
    curve.check(field)?;
    if scene.time.integrator == Integrator::Static && scene.statics.as_ref().is_some_and(|statics| statics.arc_length) {
        let text = "is a factor of its own, and along an equilibrium path by static.arc_length all loads have one factor; remove the curve \
                    or arc_length";
        return problem(field, text);
    }
    Ok(())
}
