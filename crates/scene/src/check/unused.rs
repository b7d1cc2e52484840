//! Tables that have no effect with the integrator of the scene.

use crate::{Pipeline, Scene};
use fem_model::numbers::problem;
use fem_model::{Integrator, Refusal, SolverKind};

/// A table, whether the scene has it, whether its integrator uses it, and which integrators do.
type Use = (&'static str, bool, bool, &'static str);

fn uses(scene: &Scene) -> [Use; 9] {
    let method = scene.time.integrator;
    let is_static = method == Integrator::Static;
    [
        ("static", scene.statics.is_some(), is_static, "static"),
        ("newmark", scene.newmark.is_some(), method == Integrator::Newmark, "newmark"),
        (
            "generalized_alpha",
            scene.generalized_alpha.is_some(),
            method == Integrator::GeneralizedAlpha,
            "generalized_alpha",
        ),
        (
            "newton",
            scene.newton.is_some(),
            method.has_newton(),
            "implicit_euler, an implicit method of second order, or static",
        ),
        (
            "solver",
            scene.solver.is_some(),
            method.has_matrix() && !method.is_iterated() || steps_on_device(scene),
            "an implicit method with a linear solver, or static; a [batch], which may have count = 1, runs an explicit method or vbd on the \
             device of kind = \"gpu\"",
        ),
        ("iterations", scene.iterations.is_some(), method.is_iterated(), "pbd, xpbd, vbd or projective_dynamics"),
        (
            "contact",
            scene.contact.is_some(),
            !method.is_explicit() && !method.is_iterated(),
            "implicit_euler, an implicit method of second order, or static",
        ),
        ("damping", scene.damping.is_some(), !is_static, "a method that moves: equilibrium has no velocities"),
        ("energy", scene.energy.is_some(), !is_static, "a method that moves: statics has no energy ledger"),
    ]
}

/// The tables of the list above that a scene does not have.
pub(crate) fn missing_tables(scene: &Scene) -> impl Iterator<Item = &'static str> {
    uses(scene).into_iter().filter(|(_, is_there, ..)| !is_there).map(|(table, ..)| table)
}

/// Returns true if whole steps run on a graphics device.
fn steps_on_device(scene: &Scene) -> bool {
    let method = scene.time.integrator;
    let is_known = method.is_explicit() || method == Integrator::Vbd;
    is_known && scene.batch.is_some() && scene.solver.as_ref().is_some_and(|solver| solver.kind == SolverKind::Gpu)
}

/// Refuses the first table without effect. The course's pipeline has none of them, and says so itself.
pub(super) fn check(scene: &Scene) -> Result<(), Refusal> {
    if scene.pipeline == Pipeline::Course {
        return Ok(());
    }
    match uses(scene).into_iter().find(|(_, is_there, is_used, _)| *is_there && !is_used) {
        Some((table, _, _, users)) => {
            let method = scene.time.integrator.name();
            problem(
                table,
                format!("has no effect with time.integrator = \"{method}\"; remove the table, or use {users}"),
            )
        }
        None => Ok(()),
    }
}

impl Scene {
    /// Removes the tables that have no effect with the integrator, and returns their names: after another integrator was chosen for
    /// a scene that was written for its own.
    pub fn remove_unused_tables(&mut self) -> Vec<&'static str> {
        let unused = uses(self).into_iter().filter(|(_, is_there, is_used, _)| *is_there && !is_used);
        let names: Vec<_> = unused.map(|(table, ..)| table).collect();
        for name in &names {
            match *name {
                "static" => self.statics = None,
                "newmark" => self.newmark = None,
                "generalized_alpha" => self.generalized_alpha = None,
                "newton" => self.newton = None,
                "iterations" => self.iterations = None,
                "solver" => self.solver = None,
                "contact" => self.contact = None,
                "damping" => self.damping = None,
                "energy" => self.energy = None,
                other => unreachable!("{other} is none of the tables above"),
            }
        }
        names
    }
}
