//! What a scene's numbers must keep, beyond what its types do.

use super::{Drag, Fixed, Gravity, Material, MeshTable, Model, Newton, Scene, Solver, Time};

/// The field that is wrong, and what is wrong with it together with the remedy.
type Problem = (&'static str, String);

/// Returns the first problem.
pub(super) fn check(scene: &Scene) -> Result<(), Problem> {
    check_mesh(&scene.mesh)?;
    check_material(&scene.material)?;
    check_time(&scene.time)?;
    scene.gravity.as_ref().map_or(Ok(()), check_gravity)?;
    scene.fixed.as_ref().map_or(Ok(()), check_fixed)?;
    scene.newton.as_ref().map_or(Ok(()), check_newton)?;
    scene.solver.as_ref().map_or(Ok(()), check_solver)?;
    scene.drag.as_ref().map_or(Ok(()), check_drag)
}

fn problem<T>(field: &'static str, text: impl Into<String>) -> Result<T, Problem> {
    Err((field, text.into()))
}

fn check_positive(field: &'static str, value: f64, unit: &str) -> Result<(), Problem> {
    // NaN fails the comparison.
    if value > 0.0 && value.is_finite() {
        return Ok(());
    }
    problem(field, format!("is {value}; give a positive number{unit}"))
}

fn check_finite(field: &'static str, values: &[f64]) -> Result<(), Problem> {
    match values.iter().find(|value| !value.is_finite()) {
        Some(value) => problem(field, format!("is {value}; give finite numbers")),
        None => Ok(()),
    }
}

/// Finite, and so is its length.
fn check_vector(field: &'static str, vector: &[f64; 3]) -> Result<(), Problem> {
    check_finite(field, vector)?;
    if vector.iter().map(|x| x * x).sum::<f64>().is_finite() {
        return Ok(());
    }
    problem(field, "is too long to compute with; give a shorter vector")
}

fn check_mesh(mesh: &MeshTable) -> Result<(), Problem> {
    check_positive("mesh.scale", mesh.scale, "")?;
    match (&mesh.file, &mesh.cuboid) {
        (Some(_), Some(_)) => problem("mesh.box", "stands beside `file`; keep one of the two"),
        (None, None) => problem("mesh", "names no tetrahedra; give it `file` or `box`"),
        _ => Ok(()),
    }
}

fn check_material(material: &Material) -> Result<(), Problem> {
    check_positive("material.density", material.density, " of kg/m³")?;
    match (material.c, material.d, material.young, material.poisson) {
        (Some(C), Some(D), None, None) => {
            if material.model != Model::NeoHookean {
                return problem("material.C", "and D belong to neo_hookean; give this model young and poisson");
            }
            check_positive("material.C", C, " of Pa")?;
            check_positive("material.D", D, " of Pa")
        }
        (None, None, Some(young), Some(poisson)) => {
            check_positive("material.young", young, " of Pa")?;
            if poisson > -1.0 && poisson < 0.5 {
                return Ok(());
            }
            problem("material.poisson", format!("is {poisson}; Poisson's ratio lies above -1 and below 0.5"))
        }
        _ => problem("material", "needs either C and D or young and poisson; give one pair and only one"),
    }
}

fn check_time(time: &Time) -> Result<(), Problem> {
    check_positive("time.dt", time.dt, " of seconds")?;
    if time.steps == Some(0) { problem("time.steps", "is 0; give at least one step") } else { Ok(()) }
}

fn check_gravity(gravity: &Gravity) -> Result<(), Problem> {
    check_vector("gravity.acceleration", &gravity.acceleration)
}

fn check_fixed(fixed: &Fixed) -> Result<(), Problem> {
    match (&fixed.plane, &fixed.nodes) {
        (Some(plane), None) if plane.below >= 0.0 && plane.below.is_finite() => Ok(()),
        (Some(plane), None) => {
            problem("fixed.plane", format!("has below = {}; give a distance of 0 m or more", plane.below))
        }
        (None, Some(_)) => Ok(()),
        _ => problem("fixed", "needs either plane or nodes; give one and only one"),
    }
}

fn check_newton(newton: &Newton) -> Result<(), Problem> {
    if newton.max_iterations == Some(0) {
        return problem("newton.max_iterations", "is 0; give at least one iteration");
    }
    newton.tolerance.map_or(Ok(()), |tolerance| check_positive("newton.tolerance", tolerance, ""))
}

fn check_solver(solver: &Solver) -> Result<(), Problem> {
    solver.tolerance.map_or(Ok(()), |tolerance| check_positive("solver.tolerance", tolerance, ""))
}

fn check_drag(drag: &Drag) -> Result<(), Problem> {
    check_positive("drag.stiffness", drag.stiffness, " of N/m")?;
    check_vector("drag.direction", &drag.direction)?;
    if drag.direction == [0.0; 3] {
        return problem("drag.direction", "is zero; give the direction of the pull");
    }
    check_finite("drag.amplitude", &[drag.amplitude])?;
    if drag.frequency >= 0.0 && drag.frequency.is_finite() {
        return Ok(());
    }
    problem("drag.frequency", format!("is {}; give 0 Hz or more", drag.frequency))
}
