//! Recovery of the undeformed shape from inverted and degenerate states with the stable neo-Hookean material (Smith, de Goes and
//! Kim, 2018), whose energy is finite for every shape.
//!
//! A free body that is reflected and one that is flattened to a plane must return to the undeformed shape. From a state in which
//! nodes have passed through others, or beside a clamp that is not reflected with the body, it must reach an equilibrium with
//! J > 0: an inner edge that its elements surround twice is an equilibrium that the energies of single elements cannot
//! distinguish from the undeformed state.

use fem_engine::simulator::Simulator;
use fem_model::Integrator;
use fem_model::simulation::Simulation;
use nalgebra::Vector3;

use super::*;
use fem_reference::{Elements, LINEAR};

const FAMILY: &str = "recovery";

/// Seeds of each initial state.
const SEEDS: u64 = 20;

/// Largest distance of a node from rest after recovery, relative to the body's length.
const REST: f64 = 1e-3;

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    add_of(cases, LINEAR, if quick { 2 } else { SEEDS });
}

/// Adds the cases with these elements and so many seeds.
pub fn add_of(cases: &mut Vec<Case>, elements: Elements, seeds: u64) {
    for (((name, tangle, expected), seed), is_clamped) in pairs(pairs(TANGLES, 0..seeds), [true, false]) {
        cases.push(recovering(name, tangle, expected, is_clamped, seed, elements));
    }
}

/// The initial position of each node.
type Tangle = fn(&mut Random) -> Box<dyn FnMut(&mut Random, &Vector3<f64>) -> Vector3<f64>>;

const TANGLES: [(&str, Tangle, Outcome); 5] = [
    (
        "random positions",
        |_| Box::new(|random, _| CENTRE + Vector3::new(1.0, 0.5, 0.5).component_mul(&random.vector())),
        Outcome::Untangles,
    ),
    (
        "flattened to a plane",
        |random| {
            let normal = random.direction();
            Box::new(move |_, X| X - normal * normal.dot(&(X - CENTRE)))
        },
        Outcome::Recovers,
    ),
    (
        "flattened to a line",
        |random| {
            let axis = random.direction();
            Box::new(move |_, X| CENTRE + axis * axis.dot(&(X - CENTRE)))
        },
        Outcome::Untangles,
    ),
    (
        "collapsed to a point",
        |random| {
            let point = CENTRE + 0.5 * random.vector();
            Box::new(move |_, _| point)
        },
        Outcome::Untangles,
    ),
    (
        "reflected",
        |random| {
            let normal = random.direction();
            Box::new(move |_, X| X - 2.0 * normal * normal.dot(&(X - CENTRE)))
        },
        Outcome::Recovers,
    ),
];

/// Largest speed of a node of a body at rest, body lengths per second.
const STILL: f64 = 1e-2;

/// Random perturbation of every node, m. An exactly flat body is in equilibrium across its plane.
const PERTURBATION: f64 = 1e-3;

/// Steps within which a body must recover.
const STEPS: usize = 600;

/// The margin of [`back_at_rest`].
pub const MARGIN_IS: &str = "distance from rest / 1e-3 of the length; recovered below 1";

fn recovering(name: &str, tangle: Tangle, expected: Outcome, is_clamped: bool, seed: u64, elements: Elements) -> Case {
    let body = match elements.order {
        1 => Setup::finer(Integrator::ImplicitEuler, "stable_neo_hookean"),
        _ => Setup::small(Integrator::ImplicitEuler, "stable_neo_hookean"),
    };
    let setup = Setup { dt: 0.05, poisson: 0.4, elements, ..body };
    let setup = setup.with_if(is_clamped, clamp).with(damp);
    // Quadratic elements reach J > 0 while their edges still cross.
    let is_free_to_turn = !is_clamped && elements.order == 1;
    let expected = if name == "reflected" && !is_free_to_turn { Outcome::Untangles } else { expected };
    let name = format!("{name}, {}", if is_clamped { "clamped" } else { "free" });
    let parameters = format!("E = 1e5 Pa, nu = 0.4, dt = {} s, up to {STEPS} steps", setup.dt);
    let case = setup.case(FAMILY, name, parameters, move |setup, deadline| {
        let (mut simulation, mut random) = (setup.build()?, Random::new(seed));
        let mut tangled = tangle(&mut random);
        place(&mut simulation, |X| tangled(&mut random, X) + PERTURBATION * random.vector());
        Ok(back_at_rest(&mut simulation, STEPS, is_clamped, deadline))
    });
    Case { expected, margin_is: MARGIN_IS, seed: Some(seed), ..case }
}

/// Marches, and compares a clamped body with its position at rest, a free body with its shape at rest.
pub fn back_at_rest(simulation: &mut Simulator<f64>, steps: usize, is_clamped: bool, deadline: Deadline) -> Finding {
    let end = march(simulation, steps, deadline);
    if let Err(trouble) = end.survived()
        && trouble.outcome != Outcome::Inverts
    {
        return trouble;
    }
    let distance = if is_clamped { distance_from_rest(simulation) } else { change_of_shape(simulation) };
    let (J, element) = simulation.min_J();
    let speed = largest_speed(simulation);
    let outcome = match (J > 0.0, distance <= REST, speed <= STILL) {
        (true, true, _) => Outcome::Recovers,
        (true, false, true) => Outcome::Untangles,
        (true, false, false) => Outcome::Deviates,
        (false, _, _) => Outcome::Inverts,
    };
    let shape = format!("{distance:.1e} lengths from rest, {speed:.1e} lengths/s, J = {J:.4} in element {element}");
    Finding::new(outcome, distance / REST, format!("{}, {shape}", end.note()))
}

/// Largest change of the distance of two nodes, relative to the body's length. Rigid motion does not change it.
fn change_of_shape(simulation: &Simulator<f64>) -> f64 {
    let (system, u) = (simulation.system(), &simulation.state().u);
    let x: Vec<Vector3<f64>> = system.rest.iter().zip(u).map(|(X, u)| X + Vector3::from(*u)).collect();
    let change = |i: usize, j: usize| ((x[i] - x[j]).norm() - (system.rest[i] - system.rest[j]).norm()).abs();
    let pairs = (0..x.len()).flat_map(|i| (0..i).map(move |j| (i, j)));
    pairs.map(|(i, j)| change(i, j)).fold(0.0, f64::max) / system.length
}
