//! Checks that depend on whether the body is flat, which is known when its mesh is.

use crate::Scene;
use crate::tables::{InitialVelocityTable, MaterialTable, PrescribedTable};
use fem_model::numbers::problem;
use fem_model::{Axis, Law, PlaneState, Refusal};

/// Refuses the first key that has no effect on a flat body, or no meaning.
pub(crate) fn check(scene: &Scene) -> Result<(), Refusal> {
    if scene.mesh.display.is_some() {
        return problem("mesh.display", "belongs to solid bodies, and this one is flat; remove it");
    }
    if let Some(number) = scene.prescribed.iter().position(turns_out_of_the_plane) {
        let text = "turns a flat body out of its plane; give the axis z";
        return problem(&format!("prescribed[{number}].rotation"), text);
    }
    let is_tilted = |axis: [f64; 3]| axis[0] != 0.0 || axis[1] != 0.0;
    let angular = |table: &InitialVelocityTable| table.angular.as_ref().is_some_and(|angular| is_tilted(angular.axis));
    if let Some(number) = scene.initial_velocity.iter().position(angular) {
        let text = "turns a flat body out of its plane; give [0, 0, 1]";
        return problem(&format!("initial_velocity[{number}].angular.axis"), text);
    }
    match vectors(scene).find(|(_, vector)| vector[2] != 0.0) {
        Some((field, vector)) => {
            let text = format!("is {vector:?}, and a flat body moves in the plane z = 0; give 0 for its third number");
            problem(&field, text)
        }
        None => Ok(()),
    }
}

/// Refuses the first key that has no effect on a solid body.
pub(crate) fn check_solid(scene: &Scene) -> Result<(), Refusal> {
    let MaterialTable { thickness, plane, .. } = &scene.material;
    match [("material.thickness", thickness.is_some()), ("material.plane", plane.is_some())].iter().find(|key| key.1) {
        Some((key, _)) => problem(key, "belongs to flat bodies, and this one is solid; remove it"),
        None => Ok(()),
    }
}

/// Refuses plane stress of a law without a form for it, and of a body that flows.
pub(super) fn check_plane(scene: &Scene) -> Result<(), Refusal> {
    if scene.material.plane != Some(PlaneState::Stress) {
        return Ok(());
    }
    let tables =
        scene.materials.iter().enumerate().map(|(number, table)| (format!("materials[{number}]"), &table.model));
    let all = std::iter::once(("material".to_owned(), &scene.material.model)).chain(tables);
    let known = || Law::FACTS.into_iter().filter(|facts| facts.has_plane_stress).map(|facts| facts.name);
    if let Some((table, model)) = all.into_iter().find(|(_, model)| !known().any(|name| name == *model)) {
        let known = known().collect::<Vec<_>>().join(" or ");
        let text = format!(
            "is \"stress\", which {table}.model = \"{model}\" has no form for; write model = {known}, or plane = \"strain\""
        );
        return problem("material.plane", text);
    }
    match scene.plasticity {
        Some(_) => {
            problem("material.plane", "is \"stress\", in which bodies with [plasticity] cannot be; write \"strain\"")
        }
        None => Ok(()),
    }
}

fn turns_out_of_the_plane(table: &PrescribedTable) -> bool {
    table.rotation.as_ref().is_some_and(|rotation| rotation.axis != Axis::Z)
}

/// The vectors of a scene that lie in the plane of a flat body.
fn vectors(scene: &Scene) -> impl Iterator<Item = (String, [f64; 3])> {
    let gravity = scene.gravity.iter().map(|table| ("gravity.acceleration".to_owned(), table.acceleration));
    let body_force = scene.body_force.iter().map(|table| ("body_force.density".to_owned(), table.density));
    let drag = scene.drag.iter().map(|table| ("drag.direction".to_owned(), table.direction));
    let tractions = of_each("traction", &scene.traction, "force_per_area", |table| table.force_per_area);
    let forces = of_each("force", &scene.force, "value", |table| Some(table.value));
    let displacements = of_each("prescribed", &scene.prescribed, "displacement", |table| table.displacement);
    let speeds = of_each("prescribed", &scene.prescribed, "velocity", |table| table.velocity);
    let initial = of_each("initial_velocity", &scene.initial_velocity, "velocity", |table| table.velocity);
    let normals = of_each("planes", &scene.planes, "normal", |plane| Some(plane.normal));
    let velocities = of_each("planes", &scene.planes, "velocity", |plane| plane.velocity);
    let of_planes = of_each("planes", &scene.planes, "displacement", |plane| plane.displacement);
    let loads = gravity.chain(body_force).chain(drag).chain(tractions).chain(forces);
    let planes = normals.chain(velocities).chain(of_planes);
    loads.chain(displacements).chain(speeds).chain(initial).chain(planes)
}

/// The vector of a key in each table that gives it, with its field.
fn of_each<'a, T>(
    name: &'a str,
    tables: &'a [T],
    key: &'a str,
    vector: impl Fn(&T) -> Option<[f64; 3]> + 'a,
) -> impl Iterator<Item = (String, [f64; 3])> + 'a {
    let of_table = move |(number, table)| Some((format!("{name}[{number}].{key}"), vector(table)?));
    tables.iter().enumerate().filter_map(of_table)
}
