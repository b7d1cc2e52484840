//! Mass-spring bodies: soft to stiff springs and short to long time steps, tangled and squashed starts. Springs do not know which side of an
//! element is its inside, so that elements may stay inverted: asked for are finite states, steps that converge, and rest in the end.

use fem_engine::simulator::Simulator;
use fem_model::Integrator;
use nalgebra::Vector3;

use super::invariance::in_rigid_motion;
use super::stiffness_and_step::{DT, YOUNG};
use crate::scenes::LINEAR;
use crate::stability::case::{Case, Finding, Outcome};
use crate::stability::forecast::{clamped, forecast, try_forecast, unit_omega};
use crate::stability::initial_state::{Random, TANGLES, Tangle, place};
use crate::stability::march::march;
use crate::stability::scene_text::{CLAMPED, DAMPED, SceneText, dynamic, gravity, prescribed_end};
use crate::study::Deadline;

const FAMILY: &str = "mass-spring bodies";
const MODEL: &str = "mass_spring";

/// The margin of bodies whose elements may invert.
const MARGIN_IS: &str = "smallest J at the end of a step, round-off decides which; springs do not keep it above 0";

/// Largest speed of a node of a body at rest, body lengths per second.
const STILL: f64 = 1e-2;

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let omega = unit_omega(MODEL, LINEAR);
    for integrator in dynamic() {
        for young in YOUNG {
            for dt in DT {
                cases.push(vibrating(integrator, young, dt, omega, quick));
            }
        }
        cases.push(rigid(integrator, if quick { 100 } else { 1000 }));
    }
    for young in if quick { &YOUNG[1..2] } else { &YOUNG } {
        for (integrator, dt) in
            [(Integrator::ImplicitEuler, DT[1]), (Integrator::ImplicitEuler, DT[2]), (Integrator::Bdf2, DT[1])]
        {
            cases.push(weighed(integrator, *young, dt));
        }
    }
    for (name, tangle) in TANGLES {
        for seed in 0..if quick { 2 } else { 10 } {
            cases.push(tangled(name, tangle, seed));
        }
    }
    for (name, motion) in ENDS {
        for integrator in [Integrator::ImplicitEuler, Integrator::Static] {
            cases.push(moved(name, motion, integrator));
        }
    }
}

fn vibrating(integrator: Integrator, young: f64, dt: f64, unit_omega: f64, quick: bool) -> Case {
    let z = unit_omega * young.sqrt() * dt;
    let forecast = forecast(integrator, z, if quick { 1000 } else { 20_000 });
    let parameters = format!("E = {young:e} Pa, dt = {dt:e} s, dt omega_max = {z:.3e}, {} steps", forecast.steps);
    let text = clamped(integrator, MODEL, young, dt);
    Case {
        expected: forecast.expected,
        margin_is: if forecast.margin.is_some() { "growth or dt over their limit; stable below 1" } else { MARGIN_IS },
        ..text.clone().case(FAMILY, "clamped body, vibrating", parameters, move |deadline| {
            let found = try_forecast(&text, forecast, deadline)?;
            Ok(if found.outcome == Outcome::Inverts { Finding { outcome: Outcome::Survives, ..found } } else { found })
        })
    }
}

/// A clamped body under a weight of a fifth of E times its cross-section, in the end at rest.
fn weighed(integrator: Integrator, young: f64, dt: f64) -> Case {
    let text = clamped(integrator, MODEL, young, dt).with(&gravity([0.0, 0.0, -0.1 * young / 1e3]));
    let parameters = format!("E = {young:e} Pa, dt = {dt:e} s, 50 steps");
    of_springs(&text, "clamped body, sagging under a fifth of E times its cross-section", parameters, {
        let text = text.clone();
        move |deadline| Ok(march(&mut text.build()?, 50, deadline).endurance())
    })
}

/// Steps within which a tangled body must come to rest.
const STEPS: usize = 600;

fn tangled(name: &str, tangle: Tangle, seed: u64) -> Case {
    let text = SceneText { dt: 0.05, ..SceneText::finer(Integrator::ImplicitEuler, MODEL) }.with(CLAMPED).with(DAMPED);
    let parameters = format!("E = 1e5 Pa, dt = {} s, {STEPS} steps", text.dt);
    let case = of_springs(&text, name, parameters, {
        let text = text.clone();
        move |deadline| {
            let (mut simulation, mut random) = (text.build()?, Random::new(seed));
            place(&mut simulation, |X| tangle(&mut random, X));
            Ok(at_rest(&mut simulation, deadline))
        }
    });
    Case { seed: Some(seed), ..case }
}

/// Marches until the body must be at rest.
fn at_rest(simulation: &mut Simulator<f64>, deadline: Deadline) -> Finding {
    let found = march(simulation, STEPS, deadline).endurance();
    let speeds = simulation.state().v.iter().map(|v| Vector3::from(*v).norm());
    let speed = speeds.fold(0.0, f64::max) / simulation.system().length;
    let note = format!("{}, {speed:.1e} lengths/s in the end", found.note);
    // NaN fails the comparison.
    let outcome =
        if found.outcome == Outcome::Survives && !(speed <= STILL) { Outcome::Deviates } else { found.outcome };
    Finding { outcome, note, ..found }
}

/// Motions of the end of largest x.
const ENDS: [(&str, &str); 3] = [
    ("stretched to ten times its length", "displacement = [18, 0, 0]"),
    ("compressed to a tenth of its length", "displacement = [-1.8, 0, 0]"),
    ("turned twice", "rotation = { axis = \"x\", center = [0, 0.5, 0.5], turns = 2 }"),
];

fn moved(name: &str, motion: &str, integrator: Integrator) -> Case {
    let load_steps = if integrator == Integrator::Static { "[static]\nload_steps = 50\n" } else { "" };
    let text = SceneText { dt: 0.05, ..SceneText::finer(integrator, MODEL) };
    let text = text.with(CLAMPED).with(load_steps).with(&prescribed_end(motion, 2.5));
    of_springs(&text, name, "E = 1e5 Pa, dt = 0.05 s, 50 steps".to_owned(), {
        let text = text.clone();
        move |deadline| Ok(march(&mut text.build()?, 50, deadline).endurance())
    })
}

/// A free flat body in rigid motion without loads, which conserves its momentum.
fn rigid(integrator: Integrator, steps: usize) -> Case {
    let mesh = "rectangle = { size = [2, 1], pattern = \"kuhn\", cells_per_unit = 2 }".to_owned();
    let text = SceneText { dt: 1e-3, mesh, ..SceneText::small(integrator, MODEL) };
    in_rigid_motion(text, FAMILY, format!("dt = 1e-3 s, {steps} steps"), steps)
}

/// A case whose elements may invert.
fn of_springs(
    text: &SceneText,
    case: &str,
    parameters: String,
    work: impl FnOnce(Deadline) -> Result<Finding, Finding> + Send + 'static,
) -> Case {
    Case { margin_is: MARGIN_IS, ..text.case(FAMILY, case, parameters, work) }
}
