//! Refusals of bodies and methods that steps on a device do not support.

use fem_gpu::{Law, Scheme};
use fem_model::{Body, Integrator, LoadCurve, Method, Refusal};

use super::arrays;
use crate::simulator::device_assembly::LAWS;

/// The law and the scheme on the device; the nodes of vertex block descent are still without colours. Returns the first key that the device does not know, with a remedy.
pub(super) fn check(body: &Body, method: &Method) -> Result<(Law, Scheme), Refusal> {
    let scheme = scheme(method)?;
    if let Some((field, what, remedy)) = unknown(body, method) {
        return Err(Refusal::new(field, on_device(what, &format!("{remedy}, or leave [solver] out"))));
    }
    let law = arrays::law(&body.material).map(|(law, _)| law).ok_or_else(|| {
        let what = format!("is \"{}\"", body.material.law.name());
        let [laws @ .., last] = &LAWS;
        Refusal::new(
            "material.model",
            on_device(&what, &format!("write {} or {last}, or leave [solver] out", laws.join(", "))),
        )
    })?;
    Ok((law, scheme))
}

fn on_device(what: &str, remedy: &str) -> String {
    format!("{what}, which steps on a graphics device (solver.kind = \"gpu\") do not know; {remedy}")
}

fn scheme(method: &Method) -> Result<Scheme, Refusal> {
    match method.integrator {
        Integrator::ExplicitEuler => Ok(Scheme::ExplicitEuler),
        Integrator::SemiImplicitEuler => Ok(Scheme::SemiImplicitEuler),
        Integrator::Verlet => Ok(Scheme::Verlet),
        Integrator::Rk2 => Ok(Scheme::Rk2),
        Integrator::Rk4 => Ok(Scheme::Rk4),
        Integrator::Vbd => Ok(Scheme::VertexBlockDescent { sweeps: method.iterations.count, colors: Vec::new() }),
        other => {
            let what = format!("is \"{}\"", other.name());
            Err(Refusal::new(
                "time.integrator",
                on_device(&what, "use an explicit method or vbd, or leave [solver] out"),
            ))
        }
    }
}

/// A key, its problem, and the remedy.
type Unknown = (&'static str, &'static str, &'static str);

fn unknown(body: &Body, method: &Method) -> Option<Unknown> {
    let has_curve = |curve: &Option<LoadCurve>| curve.is_some();
    let has_motion = body.dirichlet.iter().any(|condition| condition.motion.is_some());
    let is_released = body.dirichlet.iter().any(|condition| condition.until.is_some());
    let has_stiffness_damping = body.damping.is_some_and(|damping| damping.beta > 0.0);
    let traction_curve = body.tractions.iter().any(|traction| traction.curve.is_some());
    let field = body.fields.tables().next();
    let iterations = method.iterations;
    let is_accelerated = iterations.acceleration.is_some_and(|radius| radius > 0.0);
    let keys: [(&'static str, bool, &'static str, &'static str); 22] = [
        ("mesh", body.shape.mesh.dimension() == 2, "is a flat body", "take tetrahedra"),
        ("mesh.order", body.shape.mesh.element().order != 1, "makes quadratic elements", "write 1"),
        ("material.volumetric", body.volumetric().is_some(), "does not act at each quadrature point", "remove it"),
        ("materials", !body.regions.is_empty(), "gives the body several materials", "remove the tables"),
        ("plasticity", body.plasticity.is_some(), "is a flow of the material", "remove the table"),
        ("fibres", !body.fibres.is_empty(), "are forces within elements", "remove the tables"),
        (
            "mass.lumped",
            !body.lumped_mass,
            "is not true, and a consistent mass takes a linear system",
            "write mass.lumped = true",
        ),
        ("gravity.curve", has_curve(&body.gravity_curve), "is a factor of time", "remove it"),
        ("body_force.curve", has_curve(&body.body_force_curve), "is a factor of time", "remove it"),
        ("traction", traction_curve, "has a factor of time", "remove its curve"),
        ("traction", !body.pressures.is_empty(), "has a pressure that follows the surface", "give force_per_area"),
        (
            "force",
            body.nodal_forces.iter().any(|load| load.curve.is_some()),
            "has a factor of time",
            "remove its curve",
        ),
        (field.unwrap_or_default(), field.is_some(), "is a force field", "remove the table"),
        ("springs", !body.springs.is_empty(), "are forces between two nodes", "remove the tables"),
        ("prescribed", has_motion, "is a motion of nodes", "use [fixed]"),
        ("fixed.until", is_released, "is a time from which nodes are free", "remove it"),
        ("planes", body.contact.is_some(), "are obstacles", "remove the tables"),
        ("damping.beta", has_stiffness_damping, "is the damping of a stiffness matrix", "give damping.alpha alone"),
        ("drag", body.drag.is_some(), "is a force that follows a moving target", "remove the table"),
        ("iterations.tolerance", iterations.tolerance.is_some(), "may end a step early", "give iterations.count alone"),
        ("iterations.acceleration", is_accelerated, "is the radius of Chebyshev acceleration", "remove it"),
        ("time.adaptive", method.adaptive.is_some(), "are steps of different lengths", "remove it"),
    ];
    keys.into_iter().find(|(_, is_there, ..)| *is_there).map(|(field, _, what, remedy)| (field, what, remedy))
}
