//! Mass-spring bodies: soft to stiff springs and short to long time steps, tangled and squashed starts. Springs do not know which side of an
//! element is its inside, so that elements may stay inverted: asked for are finite states, steps that converge, and rest in the end.

use fem_engine::simulator::Simulator;
use fem_model::{Integrator, Motion};

use super::invariance::in_rigid_motion;
use super::stiffness_and_step::{DT, YOUNG};
use super::*;
use fem_reference::LINEAR;

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
        cases.extend(pairs(YOUNG, DT).map(|(young, dt)| vibrating(integrator, young, dt, omega, quick)));
        cases.push(rigid(integrator, if quick { 100 } else { 1000 }));
    }
    let methods = [(Integrator::ImplicitEuler, DT[1]), (Integrator::ImplicitEuler, DT[2]), (Integrator::Bdf2, DT[1])];
    let stiffness = if quick { &YOUNG[1..2] } else { &YOUNG };
    cases.extend(pairs(stiffness, methods).map(|(&young, (integrator, dt))| weighed(integrator, young, dt)));
    let seeds = 0..if quick { 2 } else { 10 };
    cases.extend(pairs(TANGLES, seeds).map(|((name, tangle), seed)| tangled(name, tangle, seed)));
    let methods = [Integrator::ImplicitEuler, Integrator::Static];
    cases.extend(pairs(ENDS, methods).map(|((name, motion), integrator)| moved(name, motion(), integrator)));
}

fn vibrating(integrator: Integrator, young: f64, dt: f64, unit_omega: f64, quick: bool) -> Case {
    let z = unit_omega * young.sqrt() * dt;
    let forecast = forecast(integrator, z, if quick { 1000 } else { 20_000 });
    let parameters = format!("E = {young:e} Pa, dt = {dt:e} s, dt omega_max = {z:.3e}, {} steps", forecast.steps);
    let setup = clamped(integrator, MODEL, young, dt);
    Case {
        expected: forecast.expected,
        margin_is: if forecast.margin.is_some() { "growth or dt over their limit; stable below 1" } else { MARGIN_IS },
        ..setup.case(FAMILY, "clamped body, vibrating", parameters, move |setup, deadline| {
            let found = try_forecast(setup, forecast, deadline)?;
            Ok(if found.outcome == Outcome::Inverts { Finding { outcome: Outcome::Survives, ..found } } else { found })
        })
    }
}

/// A clamped body under a weight of a fifth of E times its cross-section, in the end at rest.
fn weighed(integrator: Integrator, young: f64, dt: f64) -> Case {
    let setup = clamped(integrator, MODEL, young, dt).with(gravity([0.0, 0.0, -0.1 * young / 1e3]));
    let parameters = format!("E = {young:e} Pa, dt = {dt:e} s, 50 steps");
    let name = "clamped body, sagging under a fifth of E times its cross-section";
    Case { margin_is: MARGIN_IS, ..setup.enduring(FAMILY, name, parameters, 50) }
}

/// Steps within which a tangled body must come to rest.
const STEPS: usize = 600;

fn tangled(name: &str, tangle: Tangle, seed: u64) -> Case {
    let setup = Setup { dt: 0.05, ..Setup::finer(Integrator::ImplicitEuler, MODEL) }.with(clamp).with(damp);
    let parameters = format!("E = 1e5 Pa, dt = {} s, {STEPS} steps", setup.dt);
    let case = setup.case(FAMILY, name, parameters, move |setup, deadline| {
        let (mut simulation, mut random) = (setup.build()?, Random::new(seed));
        place(&mut simulation, |X| tangle(&mut random, X));
        Ok(at_rest(&mut simulation, deadline))
    });
    Case { seed: Some(seed), margin_is: MARGIN_IS, ..case }
}

/// Marches until the body must be at rest.
fn at_rest(simulation: &mut Simulator<f64>, deadline: Deadline) -> Finding {
    let found = march(simulation, STEPS, deadline).endurance();
    let speed = largest_speed(simulation);
    let note = format!("{}, {speed:.1e} lengths/s in the end", found.note);
    // NaN fails the comparison.
    let outcome =
        if found.outcome == Outcome::Survives && !(speed <= STILL) { Outcome::Deviates } else { found.outcome };
    Finding { outcome, note, ..found }
}

/// Motions of the end of largest x.
const ENDS: [EndMotion; 3] = [
    ("stretched to ten times its length", || Motion::by([18.0, 0.0, 0.0])),
    ("compressed to a tenth of its length", || Motion::by([-1.8, 0.0, 0.0])),
    ("turned twice", || turned([0.0, 0.5, 0.5], 2.0)),
];

fn moved(name: &str, motion: Motion, integrator: Integrator) -> Case {
    let setup = Setup { dt: 0.05, ..Setup::finer(integrator, MODEL) };
    let setup = setup.load_steps(50).with(clamp).with(prescribed_end(motion, 2.5));
    let parameters = "E = 1e5 Pa, dt = 0.05 s, 50 steps".to_owned();
    Case { margin_is: MARGIN_IS, ..setup.enduring(FAMILY, name, parameters, 50) }
}

/// A free flat body in rigid motion without loads, which conserves its momentum.
fn rigid(integrator: Integrator, steps: usize) -> Case {
    let setup = Setup { dt: 1e-3, grid: Grid::Flat([2.0, 1.0], 2), ..Setup::small(integrator, MODEL) };
    in_rigid_motion(setup, FAMILY, format!("dt = 1e-3 s, {steps} steps"), steps)
}
