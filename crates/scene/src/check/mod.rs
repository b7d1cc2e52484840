//! Checks of a scene's values beyond their types.

mod batch;
mod constraints;
pub(crate) mod contact;
mod curves;
mod fibres;
pub(crate) mod flat;
mod initial;
mod iterations;
mod loads;
mod mass_spring;
mod materials;
mod plasticity;
mod second_order;
mod selector;
mod unused;

pub(crate) use unused::missing_tables;

use crate::Scene;
use crate::tables::{DampingTable, MeshTable, NewtonTable, SolverTable, StaticTable, TimeTable};
use fem_model::numbers::{check_not_negative, check_positive, problem};
use fem_model::{Integrator, Refusal, SolverKind};

/// Largest number of refinements: 8⁴ = 4096 tetrahedra for each of the mesh file, or 4⁴ = 256 triangles.
const MOST_REFINEMENTS: u32 = 4;

/// Returns the first problem of a scene.
pub(super) fn check(scene: &Scene) -> Result<(), Refusal> {
    check_mesh(&scene.mesh)?;
    scene.material.check("material")?;
    materials::check(scene)?;
    mass_spring::check(scene)?;
    plasticity::check(scene)?;
    fibres::check(scene)?;
    flat::check_plane(scene)?;
    check_time(&scene.time)?;
    batch::check(scene)?;
    unused::check(scene)?;
    second_order::check(scene)?;
    iterations::check(scene)?;
    loads::check(scene)?;
    constraints::check(scene)?;
    curves::check(scene)?;
    contact::check(scene)?;
    initial::check(scene)?;
    scene.damping.as_ref().map_or(Ok(()), check_damping)?;
    scene.statics.as_ref().map_or(Ok(()), check_static)?;
    scene.newton.as_ref().map_or(Ok(()), check_newton)?;
    scene.solver.as_ref().map_or(Ok(()), check_solver)
}

fn check_mesh(mesh: &MeshTable) -> Result<(), Refusal> {
    check_positive("mesh.scale", mesh.scale, "")?;
    if mesh.refine > MOST_REFINEMENTS {
        let text = format!("is {}; cut every element at most {MOST_REFINEMENTS} times", mesh.refine);
        return problem("mesh.refine", text);
    }
    if !(1..=2).contains(&mesh.order) {
        return problem(
            "mesh.order",
            format!("is {}; write 1 for linear elements, or 2 for quadratic ones", mesh.order),
        );
    }
    let sources = [
        ("file", mesh.file.is_some()),
        ("files", mesh.files.is_some()),
        ("box", mesh.cuboid.is_some()),
        ("surface", mesh.surface.is_some()),
        ("rectangle", mesh.rectangle.is_some()),
        ("picture", mesh.picture.is_some()),
    ];
    let mut given = sources.iter().filter(|(_, is_given)| *is_given).map(|(key, _)| key);
    match (given.next(), given.next()) {
        (None, _) => {
            problem("mesh", "names no elements; give it `file`, `files`, `box`, `surface`, `rectangle` or `picture`")
        }
        (Some(first), Some(second)) => {
            problem(&format!("mesh.{second}"), format!("stands beside `{first}`; keep one of the two"))
        }
        _ if mesh.files.as_ref().is_some_and(Vec::is_empty) => problem("mesh.files", "is empty; name a file"),
        _ => Ok(()),
    }
}

fn check_time(time: &TimeTable) -> Result<(), Refusal> {
    match time.dt {
        Some(dt) => check_positive("time.dt", dt, " of seconds")?,
        None if time.integrator == Integrator::Static => {}
        None => {
            let text = format!("is missing, and {} needs a time step; give it in seconds", time.integrator.name());
            return problem("time.dt", text);
        }
    }
    match time.substeps {
        Some(0) => return problem("time.substeps", "is 0; give at least one substep"),
        Some(count) if count > MOST_SUBSTEPS => {
            let text =
                format!("is {count}; give at most {MOST_SUBSTEPS}, and a shorter time.dt where these are too long");
            return problem("time.substeps", text);
        }
        Some(_) if time.integrator == Integrator::Static => {
            return problem(
                "time.substeps",
                "has no effect with time.integrator = \"static\"; remove it, or give static.load_steps",
            );
        }
        _ => {}
    }
    if time.steps == Some(0) { problem("time.steps", "is 0; give at least one step") } else { Ok(()) }
}

/// Largest number of substeps: a run answers to a signal, and the window to its user, after a step.
const MOST_SUBSTEPS: usize = 100_000;

fn check_damping(damping: &DampingTable) -> Result<(), Refusal> {
    check_not_negative("damping.alpha", damping.alpha, "1/s")?;
    check_not_negative("damping.beta", damping.beta, "s")
}

fn check_static(statics: &StaticTable) -> Result<(), Refusal> {
    match statics.load_steps {
        0 => problem("static.load_steps", "is 0; give at least one load step"),
        _ => Ok(()),
    }
}

fn check_newton(newton: &NewtonTable) -> Result<(), Refusal> {
    if newton.max_iterations == Some(0) {
        return problem("newton.max_iterations", "is 0; give at least one iteration");
    }
    newton.tolerance.map_or(Ok(()), |tolerance| check_tolerance("newton.tolerance", tolerance))
}

/// Checks that a relative tolerance lies between 0 and 1.
fn check_tolerance(field: &str, tolerance: f64) -> Result<(), Refusal> {
    check_positive(field, tolerance, "")?;
    if tolerance < 1.0 { Ok(()) } else { problem(field, format!("is {tolerance}; give a number below 1")) }
}

fn check_solver(solver: &SolverTable) -> Result<(), Refusal> {
    solver.tolerance.map_or(Ok(()), |tolerance| check_tolerance("solver.tolerance", tolerance))?;
    if solver.precision.is_some() && solver.kind != SolverKind::Gpu {
        return problem("solver.precision", "belongs to the kind \"gpu\"; write that kind, or time.precision");
    }
    if solver.preconditioner.is_some() && solver.kind != SolverKind::Pcg {
        return problem("solver.preconditioner", "belongs to the kind \"pcg\"; write that kind or remove it");
    }
    Ok(())
}
