//! Motions far beyond the critical time step: they end at the step in which it shows, whatever the law.

use fem_model::Integrator;
use fem_model::simulation::{Cause, Simulation};

use crate::stability::case::{Case, Finding, Outcome};
use crate::stability::forecast::clamped;
use crate::stability::scene_text::{LAWS, SceneText, gravity};
use crate::study::Deadline;

const FAMILY: &str = "explosions";

/// Steps within which a motion must have ended.
const STEPS: usize = 20;

/// Adds the family.
pub fn add(cases: &mut Vec<Case>) {
    for integrator in
        [Integrator::ExplicitEuler, Integrator::SemiImplicitEuler, Integrator::Rk2, Integrator::Rk4, Integrator::Verlet]
    {
        for model in LAWS {
            let text = clamped(integrator, model, 1e5, 0.3).with(&gravity([0.0, 0.0, -10.0]));
            let parameters = "E = 1e5 Pa, dt = 0.3 s".to_owned();
            cases.push(Case {
                expected: Outcome::Explodes,
                margin_is: "step in which the run ends; at most 20",
                ..text.clone().case(FAMILY, "clamped body, falling", parameters, move |deadline| ended(&text, deadline))
            });
        }
    }
}

fn ended(text: &SceneText, deadline: Deadline) -> Result<Finding, Finding> {
    let mut simulation = text.build()?;
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
