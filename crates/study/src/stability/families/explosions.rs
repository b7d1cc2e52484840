//! Motions far beyond the critical time step: they end at the step in which it shows, whatever the law.

use fem_model::Integrator;
use fem_model::simulation::{Cause, Simulation};

use super::*;

const FAMILY: &str = "explosions";

/// Steps within which a motion must have ended.
const STEPS: usize = 20;

/// Adds the family.
pub fn add(cases: &mut Vec<Case>) {
    let methods = [
        Integrator::ExplicitEuler,
        Integrator::SemiImplicitEuler,
        Integrator::Rk2,
        Integrator::Rk4,
        Integrator::Verlet,
    ];
    for (integrator, law) in pairs(methods, LAWS) {
        let setup = clamped(integrator, law, 1e5, 0.3).with(gravity([0.0, 0.0, -10.0]));
        let case = setup.case(FAMILY, "clamped body, falling", "E = 1e5 Pa, dt = 0.3 s".to_owned(), ended);
        let margin_is = "step in which the run ends; at most 20";
        cases.push(Case { expected: Outcome::Explodes, margin_is, ..case });
    }
}

fn ended(setup: &Setup, deadline: Deadline) -> Result<Finding, Finding> {
    let mut simulation = setup.build()?;
    for step in 1..=STEPS {
        if deadline.is_over() {
            return Ok(Finding::plain(Outcome::Hangs, format!("deadline after {step} steps")));
        }
        let Err(failure) = simulation.step() else { continue };
        let finite = simulation.positions().iter().all(|x| x.is_finite());
        let is_clear = matches!(failure.cause, Cause::EnergyGained { .. }) || failure.cause.is_inversion();
        let outcome = if finite && is_clear { Outcome::Explodes } else { Outcome::Deviates };
        return Ok(Finding::new(outcome, step as f64, failure.to_string()));
    }
    Ok(Finding::plain(Outcome::Survives, format!("no failure in {STEPS} steps")))
}
