//! Strains far beyond those of rubber: torsion, tension and compression by prescribed motion, and the release from them.

use fem_engine::simulator::Simulator;
use fem_model::{Integrator, Motion};
use nalgebra::Vector3;

use super::recovery::{MARGIN_IS, back_at_rest};
use super::*;

const FAMILY: &str = "large strains";

/// The margin of a method of second order, which keeps the waves of such a motion: they are chaotic, so that another order of summation,
/// as other processors have it, changes it (0.30 to 0.38 in generalized-α).
const IN_WAVES: &str = "smallest J at the end of a step, in waves that amplify round-off; must be above 0";

/// A prescribed motion of the face of largest x.
struct Driven {
    name: &'static str,
    grid: Grid,
    motion: fn() -> Motion,
    steps: usize,
    /// s
    dt: f64,
    /// A material without an energy barrier inverts elements.
    inverts: bool,
}

/// Neighbouring layers of the twisted rod rotate by 90° against each other; beyond 180° the mesh cannot represent the rotation.
const MOTIONS: [Driven; 3] = [
    Driven {
        name: "twisted by 10 turns",
        grid: Grid::Solid([5.0, 0.25, 0.25], 8),
        motion: || turned([5.0, 0.125, 0.125], 10.0),
        steps: 400,
        dt: 0.05,
        inverts: false,
    },
    Driven {
        name: "stretched to 10 times its length",
        grid: Grid::Solid([2.0, 1.0, 1.0], 2),
        motion: || Motion::by([18.0, 0.0, 0.0]),
        steps: 100,
        dt: 0.01,
        inverts: false,
    },
    Driven {
        name: "compressed to 2 % of its length",
        grid: Grid::Solid([2.0, 1.0, 1.0], 2),
        motion: || Motion::by([-1.96, 0.0, 0.0]),
        steps: 100,
        dt: 0.01,
        inverts: true,
    },
];

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    for (motion, law) in pairs(if quick { &MOTIONS[1..] } else { &MOTIONS }, NEO_HOOKEAN) {
        // Waves in the twisted rod take generalized-α beyond any deadline: it damps them by a fifth in each step.
        let is_usable = |integrator: &Integrator| !(is_twist(motion) && *integrator == Integrator::GeneralizedAlpha);
        let second_order = Integrator::second_order_implicit().filter(is_usable);
        let methods = [Integrator::ImplicitEuler, Integrator::Static].into_iter().chain(second_order);
        cases.extend(methods.map(|integrator| prescribed(motion, law, integrator)));
        cases.push(prescribed_and_released(motion, law));
    }
    for (name, factors) in RELEASED {
        let steps = if quick { &[0.01][..] } else { &[0.01, 0.1, 1.0] };
        cases.extend(pairs(steps, NEO_HOOKEAN).map(|(&dt, law)| released(name, factors, law, dt)));
        cases.extend([1e-3, 0.1, 1.0].map(|dt| released_linearly(name, factors, dt)));
    }
}

/// The scene of a motion, which takes `steps` steps of `dt`.
fn scene(motion: &Driven, model: &'static str, integrator: Integrator) -> Setup {
    let &Driven { grid, dt, steps, .. } = motion;
    let setup = Setup { poisson: 0.4, grid, dt, ..Setup::finer(integrator, model) };
    setup.load_steps(steps).with(clamp).with(prescribed_end((motion.motion)(), dt * steps as f64))
}

/// The motion, and as many steps at its end.
fn prescribed(motion: &Driven, model: &'static str, integrator: Integrator) -> Case {
    let setup = scene(motion, model, integrator);
    let steps = if integrator == Integrator::Static { motion.steps } else { 2 * motion.steps };
    let parameters = format!("nu = 0.4, E = 1e5 Pa, dt = {} s, {steps} steps", motion.dt);
    // The rod buckles within steps; of the methods that survive, Bathe's damps these waves least.
    let is_crossed = motion.inverts || is_twist(motion) && integrator == Integrator::Bathe;
    let inverts = model == "stable_neo_hookean" && is_crossed;
    Case {
        expected: match inverts {
            true => Outcome::Inverts,
            false if keeps_shocks(motion, model, integrator) => Outcome::Explodes,
            false => Outcome::Survives,
        },
        margin_is: if integrator.estimates_error() { IN_WAVES } else { SMALLEST_J },
        ..setup.surviving(FAMILY, motion.name, parameters, steps)
    }
}

/// Returns true if a method keeps the waves of the motion that its steps do not resolve, until they invert elements of a material with
/// a barrier, or their energy grows: the end of the run names the element or the energy.
fn keeps_shocks(motion: &Driven, model: &str, integrator: Integrator) -> bool {
    match integrator {
        Integrator::ImplicitMidpoint | Integrator::Newmark => is_twist(motion) || model == "neo_hookean",
        Integrator::GeneralizedAlpha => motion.inverts && model == "neo_hookean",
        // It gains energy where the rod buckles within a step.
        Integrator::Bdf2 => is_twist(motion) && model == "stable_neo_hookean",
        _ => false,
    }
}

fn is_twist(motion: &Driven) -> bool {
    (motion.motion)().rotation.is_some()
}

/// The motion, and then a free end.
fn prescribed_and_released(motion: &Driven, model: &'static str) -> Case {
    let setup = scene(motion, model, Integrator::ImplicitEuler);
    let grid = motion.grid;
    let free = Setup { poisson: 0.4, grid, dt: 0.1, ..Setup::finer(Integrator::ImplicitEuler, model) };
    // Buckling: implicit Euler may gain energy in a step across a maximum of the potential, which no convex potential has.
    let free = free.with(clamp).with(damp).set(|method| method.accept_gain = true);
    let (steps, rest) = (motion.steps, 1000);
    let parameters = format!("nu = 0.4, E = 1e5 Pa, {steps} steps of {} s and {rest} of 0.1 s", motion.dt);
    let case = setup.case(FAMILY, format!("{}, then released", motion.name), parameters, move |setup, deadline| {
        let mut simulation = setup.build()?;
        let end = march(&mut simulation, steps, deadline);
        if end.failure.is_some() || end.is_late || !end.is_finite {
            return Err(end.survival());
        }
        let (numbering, state) = (&simulation.system().numbering, simulation.state());
        let (u, v) = (numbering.to_mesh(&state.u), numbering.to_mesh(&state.v));
        let mut simulation = free.build()?;
        simulation.set_state(&u, &v);
        Ok(back_at_rest(&mut simulation, rest, true, deadline))
    });
    Case { expected: Outcome::Recovers, margin_is: MARGIN_IS, ..case }
}

/// Initial length and width, relative to those at rest.
const RELEASED: [(&str, [f64; 2]); 3] = [
    ("released at 3 times its length", [3.0, 1.0]),
    ("released at a tenth of its length", [0.1, 1.0]),
    ("released at a tenth of its size", [0.1, 0.1]),
];

/// A material without an energy barrier may pass through J = 0, and must recover.
fn released(name: &str, factors: [f64; 2], model: &'static str, dt: f64) -> Case {
    let setup = Setup { dt, ..Setup::finer(Integrator::ImplicitEuler, model) };
    let has_barrier = model == "neo_hookean";
    let (setup, steps) = if has_barrier { (setup, 100) } else { (setup.with(damp), 1000) };
    let parameters = format!("free, E = 1e5 Pa, nu = 0.3, dt = {dt:e} s, {steps} steps");
    let case = setup.case(FAMILY, name, parameters, move |setup, deadline| {
        let mut simulation = placed(setup, factors)?;
        Ok(if has_barrier {
            march(&mut simulation, steps, deadline).survival()
        } else {
            back_at_rest(&mut simulation, steps, false, deadline)
        })
    });
    if has_barrier { case } else { Case { expected: Outcome::Recovers, margin_is: MARGIN_IS, ..case } }
}

/// A linearly implicit step moves a wave as far as its initial speed says. If that is more than an element, elements invert.
fn released_linearly(name: &str, factors: [f64; 2], dt: f64) -> Case {
    let setup = Setup { dt, ..Setup::finer(Integrator::LinearlyImplicitEuler, "neo_hookean") };
    let courant = dt * (setup.young / setup.density).sqrt() / 0.5;
    let parameters = format!("free, E = 1e5 Pa, nu = 0.3, dt = {dt:e} s, 100 steps");
    Case {
        expected: if courant < 1.0 { Outcome::Survives } else { Outcome::Explodes },
        margin_is: "Courant number; must explode above 1",
        ..setup.case(FAMILY, name, parameters, move |setup, deadline| {
            let found = march(&mut placed(setup, factors)?, 100, deadline).survival();
            Ok(Finding { margin: Some(courant), ..found })
        })
    }
}

fn placed(setup: &Setup, [along, across]: [f64; 2]) -> Result<Simulator<f64>, Finding> {
    let mut simulation = setup.build()?;
    place(&mut simulation, |X| Vector3::new(along * X.x, across * X.y, across * X.z));
    Ok(simulation)
}
