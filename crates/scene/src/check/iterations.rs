//! Checks of `[iterations]`, and of what the iterated methods `pbd`, `xpbd`, `vbd` and `projective_dynamics` cannot be combined with.

use super::check_tolerance;
use crate::tables::IterationsTable;
use crate::{Pipeline, Scene};
use fem_model::numbers::problem;
use fem_model::{Integrator, Refusal};

/// Largest number of iterations: a run answers to a signal, and the window to its user, after a step.
const MOST_ITERATIONS: usize = 1_000_000;

pub(super) fn check(scene: &Scene) -> Result<(), Refusal> {
    let method = scene.time.integrator;
    if let Some(table) = &scene.iterations {
        check_numbers(table)?;
        // The course's pipeline refuses the table itself.
        if scene.pipeline == Pipeline::Engine {
            check_keys(table, method)?;
        }
    }
    if method.is_iterated() { check_features(scene) } else { Ok(()) }
}

fn check_numbers(table: &IterationsTable) -> Result<(), Refusal> {
    match table.count {
        Some(0) => return problem("iterations.count", "is 0; give at least one iteration"),
        Some(count) if count > MOST_ITERATIONS => {
            let text = format!("is {count}; give at most {MOST_ITERATIONS}, or a time.integrator with Newton's method");
            return problem("iterations.count", text);
        }
        _ => {}
    }
    table.tolerance.map_or(Ok(()), |tolerance| check_tolerance("iterations.tolerance", tolerance))?;
    if let Some(radius) = table.acceleration
        && !(0.0..1.0).contains(&radius)
    {
        let text = format!("is {radius}; give a spectral radius from 0, which changes nothing, to below 1");
        return problem("iterations.acceleration", text);
    }
    if let Some(stiffness) = table.stiffness
        && !(0.0..=1.0).contains(&stiffness)
    {
        let text = format!("is {stiffness}; give a number from 0, no constraint, to 1, a constraint that is met");
        return problem("iterations.stiffness", text);
    }
    Ok(())
}

/// Refuses keys that belong to other methods.
fn check_keys(table: &IterationsTable, method: Integrator) -> Result<(), Refusal> {
    use Integrator::{Pbd, Vbd, Xpbd};
    let keys: [(&str, bool, &[Integrator]); 3] = [
        ("acceleration", table.acceleration.is_some(), &[Vbd]),
        ("stiffness", table.stiffness.is_some(), &[Pbd]),
        ("residual", table.residual.is_some(), &[Xpbd]),
    ];
    for (key, is_given, users) in keys {
        if is_given && !users.contains(&method) {
            let users = users.iter().map(|user| user.name()).collect::<Vec<_>>().join(" or ");
            let text =
                format!("has no effect with time.integrator = \"{}\"; remove the key, or use {users}", method.name());
            return problem(&format!("iterations.{key}"), text);
        }
    }
    Ok(())
}

/// Refuses what a step of the method does not know.
fn check_features(scene: &Scene) -> Result<(), Refusal> {
    let method = scene.time.integrator;
    let name = method.name();
    if method.needs_node_masses() && scene.mass.lumped == Some(false) {
        let text = format!(
            "is false, and time.integrator = \"{name}\" moves nodes one by one, each with a mass of its own; remove it, or use \
             implicit_euler"
        );
        return problem("mass.lumped", text);
    }
    let has_beta = scene.damping.as_ref().is_some_and(|damping| damping.beta > 0.0);
    let has_pressure = scene.traction.iter().any(|traction| traction.pressure.is_some());
    let has_dampers = scene.springs.iter().any(|spring| spring.damping > 0.0);
    let unknown = [
        (
            "material.model",
            scene.material.is_mass_spring(),
            "is \"mass_spring\", a body without elastic elements",
            "give a law",
        ),
        ("springs", has_dampers, "have a damping", "leave it out"),
        ("damping.beta", has_beta, "is the damping of a stiffness matrix", "give damping.alpha alone"),
        ("plasticity", scene.plasticity.is_some(), "is a flow of the material", "remove the table"),
        ("mesh.order", scene.mesh.order != 1, "makes quadratic elements", "write 1"),
        ("traction", has_pressure, "has a pressure that follows the surface", "give force_per_area"),
    ];
    match unknown.into_iter().find(|(_, is_there, ..)| *is_there) {
        Some((field, _, problem_text, remedy)) => {
            let text = format!(
                "{problem_text}, which time.integrator = \"{name}\" does not know; {remedy}, or use implicit_euler"
            );
            problem(field, text)
        }
        None if method == Integrator::Pbd && !scene.springs.is_empty() => {
            let text = "have a stiffness in N/m, and time.integrator = \"pbd\" has constraints without one; remove them, or use xpbd";
            problem("springs", text)
        }
        None => Ok(()),
    }
}
