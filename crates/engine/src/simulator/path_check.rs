//! Loads and solvers that `static.arc_length` refuses.

use fem_model::{Body, Method, Refusal, SolverKind};
use nalgebra::Vector3;

use crate::forces::Potential;
use fem_elements::Real;

/// Refuses a scene whose loads are not proportional to the load factor, or whose solver needs a positive definite matrix.
pub(super) fn check(method: &Method, body: &Body) -> Result<(), Refusal> {
    if !method.arc_length {
        return Ok(());
    }
    let moves = |motion: &fem_model::Motion| motion.displacement != Vector3::zeros() || motion.rotation.is_some();
    if let Some(condition) = body.dirichlet.iter().find(|condition| condition.motion.as_ref().is_some_and(moves)) {
        return refuse(format!(
            "follows loads, and {} is a motion; prescribe a load, or remove arc_length",
            condition.name
        ));
    }
    if body.contact.is_some() {
        return refuse("does not know obstacles; remove [[planes]], or arc_length".to_owned());
    }
    match method.solver.as_ref().map(|solver| solver.kind) {
        None | Some(SolverKind::Lu) => Ok(()),
        Some(_) => {
            let problem = "is for positive definite matrices, and beyond a limit point there is none; remove [solver], or give \"lu\"";
            Err(Refusal::new("solver.kind", problem.to_owned()))
        }
    }
}

/// Refuses follower loads, whose stiffness is not part of the matrix, and obstacles.
pub(super) fn check_force<T: Real>(method: &Method, force: &dyn Potential<T>) -> Result<(), Refusal> {
    if method.arc_length && force.is_obstacle() {
        return refuse(format!("does not know obstacles; remove the force `{}`, or arc_length", force.name()));
    }
    if method.arc_length && !force.is_conservative() {
        return refuse(
            "needs loads with a potential, and the edge of a pressure is free; fix it, or give force_per_area"
                .to_owned(),
        );
    }
    Ok(())
}

fn refuse(problem: String) -> Result<(), Refusal> {
    Err(Refusal::new("static.arc_length", problem))
}
