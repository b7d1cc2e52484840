//! Bodies and forces that a method or a solver cannot take: one table of what is asked, the quantity that asks for it, and the problem with
//! its remedy.

use fem_model::{
    Body, ContactTreatment, Integrator as IntegratorKind, Method, Motion, PlaneState, Precision, Refusal, SolverKind,
    Volumetric,
};
use nalgebra::Vector3;

use crate::forces::{Potential, dead_load, drag, springs};
use fem_solvers::{Real, unusable_device};

/// Forces that methods know which move nodes one by one.
const OF_NODES: [&str; 3] = [dead_load::NAME, springs::NAME, drag::NAME];

/// True if it is asked for; the quantity; its problem and the remedy.
type Row = (bool, &'static str, String);

/// Refuses the first thing that is asked for and cannot be had.
fn refuse(rows: impl IntoIterator<Item = Row>) -> Result<(), Refusal> {
    match rows.into_iter().find(|(is_asked, ..)| *is_asked) {
        Some((_, field, problem)) => Err(Refusal::new(field, problem)),
        None => Ok(()),
    }
}

/// Refuses a body and a solver that the method cannot take.
pub(super) fn check(method: &Method, body: &Body) -> Result<(), Refusal> {
    let (name, follows) = (method.integrator.name(), method.arc_length);
    let solver = method.solver.as_ref();
    let volumetric = body.volumetric();
    let is_mixed = body.has_pressures();
    let volume = volumetric.map_or("", Volumetric::name);
    let has_impulses = body.contact.as_ref().is_some_and(|contact| contact.treatment == ContactTreatment::Impulses);
    let moves = |motion: &Motion| motion.displacement != Vector3::zeros() || motion.rotation.is_some();
    let moved = body.dirichlet.iter().find(|condition| condition.motion.as_ref().is_some_and(moves));
    let device = solver.filter(|solver| solver.kind == SolverKind::Gpu);
    let unusable = device.and_then(|solver| unusable_device(solver.precision));
    refuse([
        (
            !body.lumped_mass && (method.integrator.needs_node_masses() || has_impulses),
            "mass.lumped",
            format!("is false, and a step of {name} needs a mass for each node; make it true"),
        ),
        (
            method.integrator.is_iterated() && body.shape.mesh.element().order != 1,
            "mesh.order",
            format!(
                "makes quadratic elements, which time.integrator = \"{name}\" does not know; write 1, or use implicit_euler"
            ),
        ),
        (
            method.integrator.is_iterated() && volumetric.is_some(),
            "material.volumetric",
            format!("is \"{volume}\", which time.integrator = \"{name}\" does not know; remove it, or use implicit_euler"),
        ),
        (
            is_mixed && (!method.integrator.has_newton() || follows),
            "material.volumetric",
            format!(
                "is \"mixed\", whose pressures Newton's method finds, and {} has none; write \"averaged\", or use \
                 implicit_euler",
                if follows { "static.arc_length" } else { name }
            ),
        ),
        (
            body.is_incompressible() && method.integrator.facts().is_balanced_within_step,
            "time.integrator",
            format!(
                "is \"{name}\", which would keep the volume within its steps alone, and material.poisson is ½; take a smaller \
                 ratio, or newmark, bdf2, bathe or implicit_euler"
            ),
        ),
        (
            is_mixed && solver.is_some_and(|solver| solver.kind != SolverKind::Cholesky),
            "solver.kind",
            "is for displacements alone, and material.volumetric is \"mixed\"; remove [solver], or give \"cholesky\""
                .to_owned(),
        ),
        (
            is_mixed && method.precision == Precision::F32,
            "time.precision",
            "is \"f32\", in which pressures would have no digits; remove it, or write material.volumetric = \"averaged\""
                .to_owned(),
        ),
        (
            !body.fields.viscosity.is_empty() && (body.plasticity.is_some() || body.material.is_mass_spring()),
            "viscosity",
            "is a table for elastic elements; remove it, or [plasticity] or the springs".to_owned(),
        ),
        (
            !body.fields.viscosity.is_empty() && body.material.plane == PlaneState::Stress,
            "viscosity",
            "is not known in plane stress; write material.plane = \"strain\", or remove it".to_owned(),
        ),
        (
            !body.fibres.is_empty() && (body.plasticity.is_some() || body.material.is_mass_spring()),
            "fibres",
            "are for elastic elements; remove the tables, or [plasticity] or the springs".to_owned(),
        ),
        (
            !body.fibres.is_empty() && body.material.plane == PlaneState::Stress,
            "fibres",
            "are not known in plane stress; write material.plane = \"strain\", or remove the tables".to_owned(),
        ),
        (
            follows && moved.is_some(),
            "static.arc_length",
            format!(
                "follows loads, and {} is a motion; prescribe a load, or remove arc_length",
                moved.map_or("", |condition| &condition.name)
            ),
        ),
        (
            follows && body.contact.is_some(),
            "static.arc_length",
            "does not know obstacles; remove [[planes]], or arc_length".to_owned(),
        ),
        (
            follows && solver.is_some_and(|solver| solver.kind != SolverKind::Lu),
            "solver.kind",
            "is for positive definite matrices, and beyond a limit point there is none; remove [solver], or give \"lu\""
                .to_owned(),
        ),
        (
            unusable.is_some(),
            "solver.kind",
            format!("is \"gpu\", and {}; write \"pcg\", or leave the table out", unusable.unwrap_or_default()),
        ),
    ])
}

/// Refuses a force that the method cannot take.
pub(super) fn check_force<T: Real>(method: &Method, force: &dyn Potential<T>) -> Result<(), Refusal> {
    let (name, follows, is_follower) = (method.integrator.name(), method.arc_length, !force.is_conservative());
    refuse([
        (
            follows && force.is_obstacle(),
            "static.arc_length",
            format!("does not know obstacles; remove the force `{}`, or arc_length", force.name()),
        ),
        (
            follows && is_follower,
            "static.arc_length",
            "needs loads with a potential, and the edge of a pressure is free; fix it, or give force_per_area"
                .to_owned(),
        ),
        (
            method.integrator == IntegratorKind::ProjectiveDynamics && is_follower,
            "time.integrator",
            format!("is \"{name}\", which does not know follower loads; use implicit_euler"),
        ),
        (
            method.integrator == IntegratorKind::ProjectiveDynamics && force.in_elements().is_some(),
            "time.integrator",
            format!("is \"{name}\", which does not know the force `{}`; use implicit_euler", force.name()),
        ),
        (
            method.integrator.needs_node_masses() && !OF_NODES.contains(&force.name()),
            "time.integrator",
            format!("is \"{name}\", which does not know the force `{}`; use implicit_euler", force.name()),
        ),
    ])
}
