//! From any tangle back to rest: stable neo-Hookean, Smith, de Goes and Kim (2018), whose energy is finite for every shape.
//!
//! A mirrored body and one that is flattened to a plane must come back to the shape of rest. One that has lost more, in which
//! nodes have passed through others, must come back upright: an edge inside that its elements surround twice is a balance of its
//! own that no energy of single elements can tell from rest.

use nalgebra::Vector3;

use super::case::{Case, Clock, Finding, Outcome};
use super::march::march;
use super::scene_text::{CLAMPED, Text};
use super::start::{Random, distance_from_rest, place};
use super::strains::DAMPED;
use fem_engine::simulator::Simulator;
use fem_scene::simulation::Simulation;

const FAMILY: &str = "recovery";

/// Seeds of each tangle.
const SEEDS: u64 = 20;

/// Farthest that a node may be from rest at the end, in lengths of the body.
const REST: f64 = 1e-3;

/// Adds the chapter.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    for (name, tangle, expected) in TANGLES {
        for seed in 0..if quick { 2 } else { SEEDS } {
            for is_held in [true, false] {
                cases.push(recovering(name, tangle, expected, is_held, seed));
            }
        }
    }
}

/// Where each node starts, for a seed.
type Tangle = fn(&mut Random) -> Box<dyn FnMut(&mut Random, &Vector3<f64>) -> Vector3<f64>>;

const TANGLES: [(&str, Tangle, Outcome); 5] = [
    (
        "scrambled",
        |_| Box::new(|random, _| MIDDLE + Vector3::new(1.0, 0.5, 0.5).component_mul(&random.vector())),
        Outcome::Untangles,
    ),
    (
        "flattened to a plane",
        |random| {
            let normal = random.direction();
            Box::new(move |_, X| X - normal * normal.dot(&(X - MIDDLE)))
        },
        Outcome::Recovers,
    ),
    (
        "flattened to a line",
        |random| {
            let axis = random.direction();
            Box::new(move |_, X| MIDDLE + axis * axis.dot(&(X - MIDDLE)))
        },
        Outcome::Untangles,
    ),
    (
        "collapsed to a point",
        |random| {
            let point = MIDDLE + 0.5 * random.vector();
            Box::new(move |_, _| point)
        },
        Outcome::Untangles,
    ),
    (
        "mirrored",
        |random| {
            let normal = random.direction();
            Box::new(move |_, X| X - 2.0 * normal * normal.dot(&(X - MIDDLE)))
        },
        Outcome::Recovers,
    ),
];

/// Of the body.
const MIDDLE: Vector3<f64> = Vector3::new(1.0, 0.5, 0.5);

/// Speed of the fastest node of a body at rest, in lengths of the body a second.
const STILL: f64 = 1e-2;

/// Shakes every node by so much, m: a body that is flattened exactly is in balance across the plane.
const SHAKEN: f64 = 1e-3;

/// Steps within which a body must be back.
const STEPS: usize = 600;

/// What its margins are.
pub const MARGIN_IS: &str = "distance from rest / 1e-3 lengths of the body; has recovered below 1";

fn recovering(name: &str, tangle: Tangle, expected: Outcome, is_held: bool, seed: u64) -> Case {
    let text = Text { dt: 0.05, poisson: 0.4, ..Text::finer("implicit_euler", "stable_neo_hookean") };
    let text = if is_held { text.with(CLAMPED) } else { text }.with(DAMPED);
    Case {
        family: FAMILY,
        case: format!("{name}, {}", if is_held { "one side held" } else { "free" }),
        parameters: format!("E = 1e5 Pa, nu = 0.4, dt = {} s, up to {STEPS} steps", text.dt),
        integrator: text.integrator.to_owned(),
        material: text.model.to_owned(),
        expected,
        margin_is: MARGIN_IS,
        seed: Some(seed),
        work: Box::new(move |clock| match text.build() {
            Ok(mut simulation) => recovered(&mut simulation, tangle, is_held, seed, clock),
            Err(finding) => finding,
        }),
    }
}

fn recovered(simulation: &mut Simulator<f64>, tangle: Tangle, is_held: bool, seed: u64, clock: Clock) -> Finding {
    let mut random = Random::new(seed);
    let mut tangled = tangle(&mut random);
    place(simulation, |X| tangled(&mut random, X) + SHAKEN * random.vector());
    back_at_rest(simulation, STEPS, is_held, clock)
}

/// Whether a body is back after so many steps: where it was where it is held, else in its shape.
pub fn back_at_rest(simulation: &mut Simulator<f64>, steps: usize, is_held: bool, clock: Clock) -> Finding {
    let end = march(simulation, steps, clock);
    if let Some(trouble) = end.trouble().filter(|trouble| trouble.outcome != Outcome::Inverts) {
        return trouble;
    }
    let distance = if is_held { distance_from_rest(simulation) } else { change_of_shape(simulation) };
    let (J, element) = simulation.min_J();
    let speeds = simulation.state().v.iter().map(|v| Vector3::from(*v).norm());
    let speed = speeds.fold(0.0, f64::max) / simulation.system().length;
    let outcome = match (J > 0.0, distance <= REST, speed <= STILL) {
        (true, true, _) => Outcome::Recovers,
        (true, false, true) => Outcome::Untangles,
        (true, false, false) => Outcome::Deviates,
        (false, _, _) => Outcome::Inverts,
    };
    let shape = format!("{distance:.1e} lengths from rest, {speed:.1e} lengths/s, J = {J:.4} in element {element}");
    Finding::new(outcome, distance / REST, format!("{}, {shape}", end.note()))
}

/// Largest change of the distance between two nodes, in lengths of the body: a free one may end anywhere, and turned.
fn change_of_shape(simulation: &Simulator<f64>) -> f64 {
    let (system, u) = (simulation.system(), &simulation.state().u);
    let x: Vec<Vector3<f64>> = system.rest.iter().zip(u).map(|(X, u)| X + Vector3::from(*u)).collect();
    let change = |i: usize, j: usize| ((x[i] - x[j]).norm() - (system.rest[i] - system.rest[j]).norm()).abs();
    let pairs = (0..x.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    pairs.map(|(i, j)| change(i, j)).fold(0.0, f64::max) / system.length
}
