//! Ten thousand steps and more, and time steps that change within a run.

use fem_model::Integrator;
use fem_model::simulation::{Interactive, Simulation};
use nalgebra::Vector3;

use crate::stability::case::{Case, Finding, Outcome};
use crate::stability::initial_state::place;
use crate::stability::march::march_with;
use crate::stability::scene_text::{CLAMPED, SceneText};
use crate::study::Deadline;

const FAMILY: &str = "long runs";

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let steps = if quick { 2000 } else { 20_000 };
    for model in ["neo_hookean", "stable_neo_hookean"] {
        let text = |integrator, dt| SceneText { dt, ..SceneText::small(integrator, model) }.with(CLAMPED);
        for integrator in [Integrator::Verlet, Integrator::SemiImplicitEuler, Integrator::Rk4] {
            cases.push(lasting(text(integrator, 1e-3), steps, false));
        }
        for dt in [0.01, 1.0] {
            cases.push(lasting(text(Integrator::ImplicitEuler, dt), steps, true));
        }
        for integrator in [Integrator::ImplicitMidpoint, Integrator::Newmark] {
            cases.push(lasting(text(integrator, 0.01), steps, false));
        }
        cases.push(lasting(text(Integrator::Bdf2, 0.01), steps, true));
        for (integrator, dts) in CHANGING {
            cases.push(changing(text(integrator, dts[0]), dts));
        }
    }
}

const ENERGY: &str = "change of the mean energy between the two halves / 1 %; must be at most 1";
const DECAY: &str = "largest energy over the initial energy; must be at most 1";

/// Bends the body.
fn bent(X: &Vector3<f64>) -> Vector3<f64> {
    X + Vector3::new(0.0, 0.0, 0.05 * X.x * X.x)
}

/// A bent body, released.
fn lasting(text: SceneText, steps: usize, decays: bool) -> Case {
    let name = if decays { "energy never grows" } else { "energy does not drift" };
    let parameters = format!("E = 1e5 Pa, dt = {:e} s, {steps} steps", text.dt);
    Case {
        margin_is: if decays { DECAY } else { ENERGY },
        ..text.clone().case(FAMILY, name, parameters, move |deadline| watched(&text, steps, decays, deadline))
    }
}

fn watched(text: &SceneText, steps: usize, decays: bool, deadline: Deadline) -> Result<Finding, Finding> {
    let mut simulation = text.build()?;
    place(&mut simulation, bent);
    let start = simulation.energies().total();
    let mut energies = Vec::with_capacity(steps);
    let end = march_with(&mut simulation, steps, deadline, |simulation| energies.push(simulation.energies().total()));
    if let Some(trouble) = end.trouble() {
        return Err(trouble);
    }
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let (first, second) = energies.split_at(steps / 2);
    let drift = (mean(second) - mean(first)) / start;
    let largest = energies.iter().fold(0.0, |largest: f64, &energy| largest.max(energy)) / start;
    let last = energies.last().copied().unwrap_or_default() / start;
    let note = format!("energy over initial energy: at most {largest:.6}, last {last:.3e}; drift {drift:.1e}");
    Ok(Finding::within(if decays { largest } else { drift.abs() / 0.01 }, note))
}

/// Time steps in turn, s; all below the stability limit.
const CHANGING: [(Integrator, [f64; 3]); 6] = [
    (Integrator::ImplicitEuler, [0.01, 1e-4, 0.1]),
    (Integrator::LinearlyImplicitEuler, [0.01, 1e-4, 0.002]),
    (Integrator::Newmark, [0.01, 1e-4, 0.02]),
    (Integrator::Bdf2, [0.01, 1e-4, 0.1]),
    (Integrator::Verlet, [1e-3, 1e-5, 3e-3]),
    (Integrator::Rk4, [1e-3, 1e-5, 3e-3]),
];

fn changing(text: SceneText, dts: [f64; 3]) -> Case {
    let parameters = format!("E = 1e5 Pa, dt = {dts:?} s in turn, 10 steps each, 100 times");
    Case {
        margin_is: "largest energy / 1.1 times the initial energy; must be at most 1",
        ..text.clone().case(FAMILY, "time step that changes", parameters, move |deadline| changed(&text, dts, deadline))
    }
}

fn changed(text: &SceneText, dts: [f64; 3], deadline: Deadline) -> Result<Finding, Finding> {
    let mut simulation = text.build()?;
    place(&mut simulation, bent);
    let start = simulation.energies().total();
    let mut largest: f64 = 0.0;
    for round in 0..100 {
        let set = simulation.set_parameter("dt", dts[round % 3]);
        set.map_err(|problem| Finding::plain(Outcome::Refused, problem))?;
        let end = march_with(&mut simulation, 10, deadline, |simulation| {
            largest = largest.max(simulation.energies().total());
        });
        if let Some(trouble) = end.trouble() {
            return Err(trouble);
        }
    }
    Ok(Finding::within(largest / (1.1 * start), format!("largest energy {:.4} of the initial one", largest / start)))
}
