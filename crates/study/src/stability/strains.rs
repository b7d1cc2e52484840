//! Strains beyond all that rubber bears: twists, pulls, squashes, and what happens when they are let go.

use nalgebra::Vector3;

use super::case::{Case, Clock, Finding, Outcome};
use super::march::{SMALLEST_J, march};
use super::recovery::{MARGIN_IS, back_at_rest};
use super::scene_text::{CLAMPED, Text, led_end};
use super::start::place;
use fem_engine::simulator::Simulator;

const FAMILY: &str = "large strains";

/// A motion of the end where x is largest.
struct Motion {
    name: &'static str,
    mesh: &'static str,
    how: &'static str,
    steps: usize,
    /// s
    dt: f64,
}

/// Neighbouring layers of the twisted rod turn by 90° against each other: beyond 180° no mesh could tell which way.
const MOTIONS: [Motion; 3] = [
    Motion {
        name: "twisted by 10 turns",
        mesh: "box = { size = [5, 0.25, 0.25], cells_per_unit = 8 }",
        how: "rotation = { axis = \"x\", center = [5, 0.125, 0.125], turns = 10 }",
        steps: 400,
        dt: 0.05,
    },
    Motion {
        name: "pulled to 10 times its length",
        mesh: "box = { size = [2, 1, 1], cells_per_unit = 2 }",
        how: "displacement = [18, 0, 0]",
        steps: 100,
        dt: 0.01,
    },
    Motion {
        name: "squashed to 2 % of its length",
        mesh: "box = { size = [2, 1, 1], cells_per_unit = 2 }",
        how: "displacement = [-1.96, 0, 0]",
        steps: 100,
        dt: 0.01,
    },
];

/// Adds the chapter.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    for motion in if quick { &MOTIONS[1..] } else { &MOTIONS } {
        for model in ["neo_hookean", "stable_neo_hookean"] {
            for integrator in ["implicit_euler", "static"] {
                cases.push(led(motion, model, integrator));
            }
            cases.push(led_and_let_go(motion, model));
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

/// The scene of a motion, all of it in `steps` steps of `dt`.
fn scene(motion: &Motion, model: &'static str, integrator: &'static str) -> Text {
    let tables =
        if integrator == "static" { format!("[static]\nload_steps = {}\n", motion.steps) } else { String::new() };
    let text = Text { poisson: 0.4, mesh: motion.mesh.to_owned(), dt: motion.dt, ..Text::finer(integrator, model) };
    text.with(CLAMPED).with(&tables).with(&led_end(motion.how, motion.dt * motion.steps as f64))
}

fn case(name: String, parameters: String, text: &Text, expected: Outcome, margin_is: &'static str, work: Work) -> Case {
    let (integrator, material) = (text.integrator.to_owned(), text.model.to_owned());
    Case { family: FAMILY, case: name, parameters, integrator, material, expected, margin_is, seed: None, work }
}

type Work = Box<dyn FnOnce(Clock) -> Finding + Send>;

/// Led there, and held as long again.
fn led(motion: &Motion, model: &'static str, integrator: &'static str) -> Case {
    let text = scene(motion, model, integrator);
    let steps = if integrator == "static" { motion.steps } else { 2 * motion.steps };
    let parameters = format!("nu = 0.4, E = 1e5 Pa, dt = {} s, {steps} steps", motion.dt);
    // What has no energy to keep J above 0 may fold where it is squashed, and has to unfold again when it is let go.
    let folds = model == "stable_neo_hookean" && motion.name.starts_with("squashed");
    let expected = if folds { Outcome::Inverts } else { Outcome::Survives };
    case(
        motion.name.to_owned(),
        parameters,
        &text.clone(),
        expected,
        SMALLEST_J,
        Box::new(move |clock| match text.build() {
            Ok(mut simulation) => march(&mut simulation, steps, clock).survival(),
            Err(finding) => finding,
        }),
    )
}

/// Led there, and then free again at that end.
fn led_and_let_go(motion: &Motion, model: &'static str) -> Case {
    let text = scene(motion, model, "implicit_euler");
    let free = Text { poisson: 0.4, mesh: motion.mesh.to_owned(), dt: 0.1, ..Text::finer("implicit_euler", model) };
    let free = free.with(CLAMPED).with(DAMPED);
    let (steps, rest) = (motion.steps, 1000);
    let parameters = format!("nu = 0.4, E = 1e5 Pa, {steps} steps of {} s and {rest} of 0.1 s", motion.dt);
    let name = format!("{}, then let go", motion.name);
    case(
        name,
        parameters,
        &text.clone(),
        Outcome::Recovers,
        MARGIN_IS,
        Box::new(move |clock| {
            let attempt = || {
                let mut simulation = text.build()?;
                let end = march(&mut simulation, steps, clock);
                if end.failure.is_some() || end.is_late || !end.is_finite {
                    return Err(end.survival());
                }
                let numbering = &simulation.system().numbering;
                let state = simulation.state();
                let (u, v) = (numbering.to_mesh(&state.u), numbering.to_mesh(&state.v));
                let mut simulation = free.build()?;
                simulation.set_state(&u, &v);
                Ok(back_at_rest(&mut simulation, rest, true, clock))
            };
            attempt().unwrap_or_else(|finding| finding)
        }),
    )
}

/// Rubber comes to rest; without damping it would swing for longer than anyone wants to wait.
pub const DAMPED: &str = "[damping]\nalpha = 0.2\n";

/// Where a body is let go: its length and its width, in parts of those at rest.
const RELEASED: [(&str, [f64; 2]); 3] = [
    ("let go at 3 times its length", [3.0, 1.0]),
    ("let go at a tenth of its length", [0.1, 1.0]),
    ("let go at a tenth of its size", [0.1, 0.1]),
];

/// A law without a barrier may pass through J = 0 on its way, and must come back.
fn released(name: &str, factors: [f64; 2], model: &'static str, dt: f64) -> Case {
    let text = Text { dt, ..Text::finer("implicit_euler", model) };
    let has_barrier = model == "neo_hookean";
    let steps = if has_barrier { 100 } else { 1000 };
    let (expected, margin_is) =
        if has_barrier { (Outcome::Survives, SMALLEST_J) } else { (Outcome::Recovers, MARGIN_IS) };
    let text = if has_barrier { text } else { text.with(DAMPED) };
    let parameters = format!("free, E = 1e5 Pa, nu = 0.3, dt = {dt:e} s, {steps} steps");
    case(
        name.to_owned(),
        parameters,
        &text.clone(),
        expected,
        margin_is,
        Box::new(move |clock| match placed(&text, factors) {
            Ok(mut simulation) if has_barrier => march(&mut simulation, steps, clock).survival(),
            Ok(mut simulation) => back_at_rest(&mut simulation, steps, false, clock),
            Err(finding) => finding,
        }),
    )
}

/// One linear step takes a wave as far as it would go at the start; where it passes whole elements, it turns them inside out.
fn released_linearly(name: &str, factors: [f64; 2], dt: f64) -> Case {
    let text = Text { dt, ..Text::finer("linearly_implicit_euler", "neo_hookean") };
    let courant = dt * (text.young / text.density).sqrt() / 0.5;
    let parameters = format!("free, E = 1e5 Pa, nu = 0.3, dt = {dt:e} s, 100 steps");
    let expected = if courant < 1.0 { Outcome::Survives } else { Outcome::Explodes };
    let margin_is = "elements that a wave passes in a step; must explode above 1";
    case(
        name.to_owned(),
        parameters,
        &text.clone(),
        expected,
        margin_is,
        Box::new(move |clock| match placed(&text, factors) {
            Ok(mut simulation) => Finding { margin: Some(courant), ..march(&mut simulation, 100, clock).survival() },
            Err(finding) => finding,
        }),
    )
}

fn placed(text: &Text, [along, across]: [f64; 2]) -> Result<Simulator<f64>, Finding> {
    let mut simulation = text.build()?;
    place(&mut simulation, |X| Vector3::new(along * X.x, across * X.y, across * X.z));
    Ok(simulation)
}
