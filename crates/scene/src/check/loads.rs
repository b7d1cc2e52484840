//! Checks of the tables of external forces.

use super::selector::check_one;
use crate::tables::{DragTable, SpringTable, TractionTable};
use crate::{Pipeline, Scene};
use fem_model::Refusal;
use fem_model::numbers::{check_direction, check_finite, check_not_negative, check_positive, check_vector, problem};

pub(super) fn check(scene: &Scene) -> Result<(), Refusal> {
    if let Some(gravity) = &scene.gravity {
        check_vector("gravity.acceleration", &gravity.acceleration)?;
    }
    if let Some(force) = &scene.body_force {
        check_vector("body_force.density", &force.density)?;
    }
    for (number, traction) in scene.traction.iter().enumerate() {
        check_traction(&format!("traction[{number}]"), traction)?;
    }
    for (number, force) in scene.force.iter().enumerate() {
        let table = format!("force[{number}]");
        check_one(&table, &force.selectors(), "plane, on, box, sphere, set and nodes")?;
        check_vector(&format!("{table}.value"), &force.value)?;
    }
    scene.fields().check()?;
    for (number, spring) in scene.springs.iter().enumerate() {
        check_spring(&format!("springs[{number}]"), spring)?;
    }
    scene.drag.as_ref().map_or(Ok(()), |drag| check_drag(scene.pipeline, drag))
}

fn check_traction(table: &str, traction: &TractionTable) -> Result<(), Refusal> {
    check_one(table, &traction.selectors(), "on, box, sphere, set, faces and edges")?;
    match (&traction.force_per_area, traction.pressure) {
        (Some(force), None) => check_vector(&format!("{table}.force_per_area"), force),
        (None, Some(pressure)) => check_finite(&format!("{table}.pressure"), &[pressure]),
        _ => problem(table, "needs either force_per_area or pressure; give one and only one"),
    }
}

fn check_spring(table: &str, spring: &SpringTable) -> Result<(), Refusal> {
    check_positive(&format!("{table}.stiffness"), spring.stiffness, " of N/m")?;
    check_not_negative(&format!("{table}.damping"), spring.damping, "N s/m")?;
    if spring.nodes[0] == spring.nodes[1] {
        let text = format!("names node {} twice; a spring joins two nodes", spring.nodes[0]);
        return problem(&format!("{table}.nodes"), text);
    }
    let length = spring.rest_length;
    length.map_or(Ok(()), |length| check_not_negative(&format!("{table}.rest_length"), length, "m"))
}

fn check_drag(pipeline: Pipeline, drag: &DragTable) -> Result<(), Refusal> {
    if pipeline == Pipeline::Engine && drag.in_stiffness == Some(false) {
        let text = "is false, and the engine's stiffness always contains the spring; remove the key, or write pipeline = \"course\"";
        return problem("drag.in_stiffness", text);
    }
    check_positive("drag.stiffness", drag.stiffness, " of N/m")?;
    check_direction("drag.direction", &drag.direction)?;
    if drag.direction == [0.0; 3] {
        return problem("drag.direction", "is zero; give the direction of the pull");
    }
    check_finite("drag.amplitude", &[drag.amplitude])?;
    check_not_negative("drag.frequency", drag.frequency, "Hz")
}
