//! Methods of a fixed number of iterations: position-based dynamics, its extended form, vertex block descent, projective dynamics. They step
//! with whatever error is left, so that every time step is stable, but elements of a law without a barrier may end inverted.

use std::path::Path;

use fem_model::{Integrator, Motion};
use fem_scene::parse;

use super::contact::{BODIES as OBSTRUCTED, hit};
use super::degenerate_bodies::{BODIES, Body};
use super::invariance::rigid;
use super::recovery::{MARGIN_IS as RECOVERED, back_at_rest};
use super::refusals::{refusal, scene};
use super::single_precision::compared;
use super::stiffness_and_step::{DT, YOUNG};
use super::*;
use fem_reference::LINEAR;

const FAMILY: &str = "iterated methods";

/// Laws with and without an energy barrier at J = 0.
const LAWS: [&str; 2] = ["stable_neo_hookean", "neo_hookean"];

/// The margin of bodies whose elements may invert.
const MARGIN_IS: &str =
    "smallest J at the end of a step, round-off decides which; a few iterations do not keep it above 0";

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let omega = unit_omega("linear", LINEAR);
    for integrator in iterated() {
        let counts = if quick { &[20][..] } else { &[1, 20] };
        for ((&count, young), dt) in pairs(pairs(counts, YOUNG), DT) {
            cases.push(vibrating(integrator, young, (dt, count), omega));
        }
        let stiffness = if quick { &YOUNG[1..2] } else { &YOUNG };
        cases.extend(pairs(stiffness, DT).map(|(&young, dt)| weighed(integrator, young, dt)));
        cases.extend(pairs(ENDS, LAWS).map(|((name, motion), law)| moved(name, motion(), law, integrator)));
        let tangles = TANGLES.into_iter().filter(|(name, _)| *name != "reflected");
        for ((name, tangle), seed) in pairs(tangles, 0..if quick { 1 } else { 10 }) {
            cases.push(tangled(name, tangle, integrator, seed));
        }
        cases.extend(BODIES.iter().map(|body| degenerate(body, integrator, if quick { 20 } else { 200 })));
        cases.push(compared("clamped body, sagging", clamped(integrator, "stable_neo_hookean", 1e5, 0.005), |x| *x));
        let obstructed = if quick { &OBSTRUCTED[1..] } else { &OBSTRUCTED[..] };
        for (&(name, grid), speed) in pairs(obstructed, [1e-3, 0.2]) {
            let setup = Setup { grid, ..Setup::small(integrator, "stable_neo_hookean") };
            cases.push(hit(setup, name, 0.5, speed));
        }
        // A step of few sweeps of vertex block descent does not keep the momentum. Round-off of all sweeps adds up.
        if integrator != Integrator::Vbd {
            cases.push(rigid(integrator, LINEAR, true, 100));
        }
        add_refusals(cases, integrator);
    }
}

/// The end of a large motion. PBD has no energy, and does not see the barrier of a law that has one: the step that passes it is refused. The
/// sweeps of XPBD diverge where elements are stiff beside their masses, E dt² of the order of ρ h² and more, and strains are large.
fn expected(integrator: Integrator, law: &str) -> Outcome {
    match (integrator, law) {
        (Integrator::Pbd, "neo_hookean") | (Integrator::Xpbd, _) => Outcome::Explodes,
        _ => Outcome::Survives,
    }
}

/// The highest mode of a clamped body, which implicit Euler damps however stiff the body and long the step.
fn vibrating(integrator: Integrator, young: f64, (dt, count): (f64, usize), unit_omega: f64) -> Case {
    let forecast = forecast(integrator, unit_omega * young.sqrt() * dt, 60);
    let parameters = format!("E = {young:e} Pa, dt = {dt:e} s, {count} iterations, {} steps", forecast.steps);
    let setup = clamped(integrator, "stable_neo_hookean", young, dt).iterations(count);
    setup.case(FAMILY, "clamped body, vibrating", parameters, move |setup, deadline| {
        try_forecast(setup, forecast, deadline)
    })
}

/// A clamped body under a weight of a fifth of E times its cross-section.
fn weighed(integrator: Integrator, young: f64, dt: f64) -> Case {
    let setup = clamped(integrator, "stable_neo_hookean", young, dt).with(gravity([0.0, 0.0, -0.1 * young / 1e3]));
    let parameters = format!("E = {young:e} Pa, dt = {dt:e} s, 50 steps");
    let name = "clamped body, sagging under a fifth of E times its cross-section";
    // E dt² over ρ h², of elements with edges of h = 1 m. Twenty sweeps of vertex block descent carry a load that far alone.
    let stiffness = young * dt * dt / setup.density;
    Case {
        expected: match integrator {
            Integrator::Xpbd if stiffness > 5.0 => Outcome::Explodes,
            Integrator::Vbd if stiffness > 1e4 => Outcome::Inverts,
            _ => Outcome::Survives,
        },
        ..setup.surviving(FAMILY, name, parameters, 50)
    }
}

/// Motions of the end of largest x.
const ENDS: [EndMotion; 3] = [
    ("stretched to ten times its length", || Motion::by([18.0, 0.0, 0.0])),
    ("compressed to a tenth of its length", || Motion::by([-1.8, 0.0, 0.0])),
    ("turned once", || turned([0.0, 0.5, 0.5], 1.0)),
];

fn moved(name: &str, motion: Motion, law: &'static str, integrator: Integrator) -> Case {
    let setup = Setup { dt: 0.05, ..Setup::finer(integrator, law) };
    let setup = setup.with(clamp).with(prescribed_end(motion, 2.5));
    let case = setup.enduring(FAMILY, name, "E = 1e5 Pa, dt = 0.05 s, 50 steps".to_owned(), 50);
    Case { expected: expected(integrator, law), margin_is: MARGIN_IS, ..case }
}

/// Steps within which a body must come to rest.
const STEPS: usize = 600;

/// Seeds with which the sweeps of XPBD diverge from a plane.
const FLAT_AND_DIVERGING: [u64; 4] = [1, 4, 7, 9];

fn tangled(name: &str, tangle: Tangle, integrator: Integrator, seed: u64) -> Case {
    let setup = Setup { dt: 0.05, ..Setup::finer(integrator, "stable_neo_hookean") }.with(clamp).with(damp);
    let parameters = format!("E = 1e5 Pa, dt = {} s, up to {STEPS} steps", setup.dt);
    let case = setup.case(FAMILY, name, parameters, move |setup, deadline| {
        let (mut simulation, mut random) = (setup.build()?, Random::new(seed));
        place(&mut simulation, |X| tangle(&mut random, X));
        Ok(back_at_rest(&mut simulation, STEPS, true, deadline))
    });
    let diverges = integrator == Integrator::Xpbd
        && match name {
            "random positions" | "collapsed to a point" => true,
            "flattened to a plane" => FLAT_AND_DIVERGING.contains(&seed),
            _ => false,
        };
    let expected = if diverges { Outcome::Explodes } else { Outcome::Untangles };
    Case { expected, margin_is: RECOVERED, seed: Some(seed), ..case }
}

fn degenerate(body: &Body, integrator: Integrator, steps: usize) -> Case {
    let setup = Setup { dt: 1e-3, ..Setup::small(integrator, "stable_neo_hookean") };
    let setup = (body.constrained)(setup).with(gravity([0.0, 0.0, -9.81]));
    let (mesh, parameters) = (body.mesh, format!("E = 1e5 Pa, dt = 1e-3 s, under its weight, {steps} steps"));
    setup.case(FAMILY, body.name, parameters, move |setup, deadline| {
        Ok(march(&mut setup.build_on::<f64>(mesh()?)?, steps, deadline).survival())
    })
}

/// Settings that these methods do not support: setup to replace, its replacement, and the words that the error must contain.
const UNKNOWN: [(&str, &str, &str, &str); 4] = [
    (
        "a mass-spring body",
        "\"neo_hookean\"\nyoung = 1e5\npoisson = 0.3",
        "\"mass_spring\"\nyoung = 1e5",
        "material.model",
    ),
    ("damping of a stiffness matrix", "[fixed]", "[damping]\nbeta = 0.1\n[fixed]", "damping.beta"),
    ("no iterations", "[fixed]", "[iterations]\ncount = 0\n[fixed]", "iterations.count"),
    ("Newton's tolerance", "[fixed]", "[newton]\ntolerance = 1e-6\n[fixed]", "newton"),
];

fn add_refusals(cases: &mut Vec<Case>, integrator: Integrator) {
    for (name, from, to, names) in UNKNOWN {
        let case = refusal(name, format!("`{}`", to.replace('\n', "; ")), names, move || {
            let refused = parse(&scene(integrator).replace(from, to), Path::new("case.toml"));
            refused.map(|_| ()).map_err(|error| error.to_string())
        });
        let (integrator, material) = (integrator.name().to_owned(), "neo_hookean".to_owned());
        cases.push(Case { family: FAMILY, integrator, material, ..case });
    }
}
