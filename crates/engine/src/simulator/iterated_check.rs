//! Forces that the iterated methods refuse.

use fem_model::{Integrator as IntegratorKind, Method, Refusal};

use crate::forces::{Forces, anchors, dead_load, springs};
use fem_elements::Real;

/// Refuses forces that a method which moves nodes one by one does not know, those of a program's own, and follower loads in projective
/// dynamics.
pub(super) fn check_forces<T: Real>(method: &Method, forces: &Forces<T>) -> Result<(), Refusal> {
    if method.integrator == IntegratorKind::ProjectiveDynamics && forces.has_followers() {
        let problem = "is \"projective_dynamics\", which does not know follower loads; use implicit_euler";
        return Err(Refusal::new("time.integrator", problem.to_owned()));
    }
    if !method.integrator.needs_node_masses() {
        return Ok(());
    }
    let name = method.integrator.name();
    let known = [dead_load::NAME, springs::NAME, anchors::NAME];
    match forces.all().map(|(force, _)| force.name()).find(|name| !known.contains(name)) {
        Some(force) => Err(Refusal::new(
            "time.integrator",
            format!("is \"{name}\", which does not know the force `{force}`; use implicit_euler"),
        )),
        None => Ok(()),
    }
}
