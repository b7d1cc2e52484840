//! Strains far beyond those of rubber: torsion, tension and compression by prescribed motion, and the release from them.

use fem_engine::simulator::Simulator;
use fem_model::Integrator;
use nalgebra::Vector3;

use super::recovery::{MARGIN_IS, back_at_rest};
use crate::stability::case::{Case, Finding, Outcome, SMALLEST_J};
use crate::stability::initial_state::place;
use crate::stability::march::march;
use crate::stability::scene_text::{CLAMPED, DAMPED, SceneText, prescribed_end};

const FAMILY: &str = "large strains";

/// The margin of a method of second order, which keeps the waves of such a motion: they are chaotic, so that another order of summation,
/// as other processors have it, changes it (0.30 to 0.38 in generalized-α).
const IN_WAVES: &str = "smallest J at the end of a step, in waves that amplify round-off; must be above 0";

/// A prescribed motion of the face of largest x.
struct EndMotion {
    name: &'static str,
    mesh: &'static str,
    /// Keys of `[[prescribed]]`.
    motion: &'static str,
    steps: usize,
    /// s
    dt: f64,
    /// A material without an energy barrier inverts elements.
    inverts: bool,
}

/// Neighbouring layers of the twisted rod rotate by 90° against each other; beyond 180° the mesh cannot represent the rotation.
const MOTIONS: [EndMotion; 3] = [
    EndMotion {
        name: "twisted by 10 turns",
        mesh: "box = { size = [5, 0.25, 0.25], pattern = \"kuhn\", cells_per_unit = 8 }",
        motion: "rotation = { axis = \"x\", center = [5, 0.125, 0.125], turns = 10 }",
        steps: 400,
        dt: 0.05,
        inverts: false,
    },
    EndMotion {
        name: "stretched to 10 times its length",
        mesh: "box = { size = [2, 1, 1], pattern = \"kuhn\", cells_per_unit = 2 }",
        motion: "displacement = [18, 0, 0]",
        steps: 100,
        dt: 0.01,
        inverts: false,
    },
    EndMotion {
        name: "compressed to 2 % of its length",
        mesh: "box = { size = [2, 1, 1], pattern = \"kuhn\", cells_per_unit = 2 }",
        motion: "displacement = [-1.96, 0, 0]",
        steps: 100,
        dt: 0.01,
        inverts: true,
    },
];

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    for motion in if quick { &MOTIONS[1..] } else { &MOTIONS } {
        for model in ["neo_hookean", "stable_neo_hookean"] {
            // Waves in the twisted rod take generalized-α beyond any deadline: it damps them by a fifth in each step.
            let is_usable =
                |integrator: &Integrator| !(is_twist(motion) && *integrator == Integrator::GeneralizedAlpha);
            for integrator in [Integrator::ImplicitEuler, Integrator::Static]
                .into_iter()
                .chain(Integrator::second_order_implicit().filter(is_usable))
            {
                cases.push(prescribed(motion, model, integrator));
            }
            cases.push(prescribed_and_released(motion, model));
        }
    }
    for (name, factors) in RELEASED {
        for dt in if quick { &[0.01][..] } else { &[0.01, 0.1, 1.0] } {
            for model in ["neo_hookean", "stable_neo_hookean"] {
                cases.push(released(name, factors, model, *dt));
            }
        }
        cases.extend([1e-3, 0.1, 1.0].map(|dt| released_linearly(name, factors, dt)));
    }
}

/// The scene of a motion, which takes `steps` steps of `dt`.
fn scene(motion: &EndMotion, model: &'static str, integrator: Integrator) -> SceneText {
    let load_steps = format!("[static]\nload_steps = {}\n", motion.steps);
    let tables = if integrator == Integrator::Static { &load_steps } else { "" };
    let mesh = motion.mesh.to_owned();
    let text = SceneText { poisson: 0.4, mesh, dt: motion.dt, ..SceneText::finer(integrator, model) };
    text.with(CLAMPED).with(tables).with(&prescribed_end(motion.motion, motion.dt * motion.steps as f64))
}

/// The motion, and as many steps at its end.
fn prescribed(motion: &EndMotion, model: &'static str, integrator: Integrator) -> Case {
    let text = scene(motion, model, integrator);
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
        ..text.surviving(FAMILY, motion.name, parameters, steps)
    }
}

/// Returns true if a method keeps the waves of the motion that its steps do not resolve, until they invert elements of a material with
/// a barrier, or their energy grows: the end of the run names the element or the energy.
fn keeps_shocks(motion: &EndMotion, model: &str, integrator: Integrator) -> bool {
    match integrator {
        Integrator::ImplicitMidpoint | Integrator::Newmark => is_twist(motion) || model == "neo_hookean",
        Integrator::GeneralizedAlpha => motion.inverts && model == "neo_hookean",
        // It gains energy where the rod buckles within a step.
        Integrator::Bdf2 => is_twist(motion) && model == "stable_neo_hookean",
        _ => false,
    }
}

fn is_twist(motion: &EndMotion) -> bool {
    motion.motion.starts_with("rotation")
}

/// The motion, and then a free end.
fn prescribed_and_released(motion: &EndMotion, model: &'static str) -> Case {
    let text = scene(motion, model, Integrator::ImplicitEuler);
    let mesh = motion.mesh.to_owned();
    let free = SceneText { poisson: 0.4, mesh, dt: 0.1, ..SceneText::finer(Integrator::ImplicitEuler, model) };
    // Buckling: implicit Euler may gain energy in a step across a maximum of the potential, which no convex potential has.
    let free = free.with(CLAMPED).with(DAMPED).with("[energy]\naccept_gain = true\n");
    let (steps, rest) = (motion.steps, 1000);
    let parameters = format!("nu = 0.4, E = 1e5 Pa, {steps} steps of {} s and {rest} of 0.1 s", motion.dt);
    let case = text.clone().case(FAMILY, format!("{}, then released", motion.name), parameters, move |deadline| {
        let mut simulation = text.build()?;
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
    let text = SceneText { dt, ..SceneText::finer(Integrator::ImplicitEuler, model) };
    let has_barrier = model == "neo_hookean";
    let (text, steps) = if has_barrier { (text, 100) } else { (text.with(DAMPED), 1000) };
    let parameters = format!("free, E = 1e5 Pa, nu = 0.3, dt = {dt:e} s, {steps} steps");
    let case = text.clone().case(FAMILY, name, parameters, move |deadline| {
        let mut simulation = placed(&text, factors)?;
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
    let text = SceneText { dt, ..SceneText::finer(Integrator::LinearlyImplicitEuler, "neo_hookean") };
    let courant = dt * (text.young / text.density).sqrt() / 0.5;
    let parameters = format!("free, E = 1e5 Pa, nu = 0.3, dt = {dt:e} s, 100 steps");
    Case {
        expected: if courant < 1.0 { Outcome::Survives } else { Outcome::Explodes },
        margin_is: "Courant number; must explode above 1",
        ..text.clone().case(FAMILY, name, parameters, move |deadline| {
            let found = march(&mut placed(&text, factors)?, 100, deadline).survival();
            Ok(Finding { margin: Some(courant), ..found })
        })
    }
}

fn placed(text: &SceneText, [along, across]: [f64; 2]) -> Result<Simulator<f64>, Finding> {
    let mut simulation = text.build()?;
    place(&mut simulation, |X| Vector3::new(along * X.x, across * X.y, across * X.z));
    Ok(simulation)
}
