//! Ten thousand steps and more, and steps that change their length on the way.

use nalgebra::Vector3;

use super::case::{Case, Clock, Finding, Outcome};
use super::march::march_with;
use super::scene_text::{CLAMPED, Text};
use super::start::place;
use fem_scene::simulation::Simulation;

const FAMILY: &str = "long runs";

/// Adds the chapter.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let steps = if quick { 2000 } else { 20_000 };
    for model in ["neo_hookean", "stable_neo_hookean"] {
        for (integrator, dt) in [("verlet", 1e-3), ("semi_implicit_euler", 1e-3), ("rk4", 1e-3)] {
            cases.push(lasting(Text { dt, ..Text::small(integrator, model) }.with(CLAMPED), steps, false));
        }
        for (integrator, dt) in [("implicit_euler", 0.01), ("implicit_euler", 1.0)] {
            cases.push(lasting(Text { dt, ..Text::small(integrator, model) }.with(CLAMPED), steps, true));
        }
        for (integrator, dts) in CHANGING {
            cases.push(changing(Text { dt: dts[0], ..Text::small(integrator, model) }.with(CLAMPED), dts));
        }
    }
}

const ENERGY: &str = "change of the mean energy from the first half to the second / 1 %; must be at most 1";
const DECAY: &str = "largest energy after the start / energy at the start; must be at most 1";

/// Bent, and let go.
fn lasting(text: Text, steps: usize, decays: bool) -> Case {
    Case {
        family: FAMILY,
        case: if decays { "energy never grows" } else { "energy swings and does not drift" }.to_owned(),
        parameters: format!("E = 1e5 Pa, dt = {:e} s, {steps} steps", text.dt),
        integrator: text.integrator.to_owned(),
        material: text.model.to_owned(),
        expected: Outcome::Survives,
        margin_is: if decays { DECAY } else { ENERGY },
        seed: None,
        work: Box::new(move |clock| watched(&text, steps, decays, clock).unwrap_or_else(|finding| finding)),
    }
}

fn watched(text: &Text, steps: usize, decays: bool, clock: Clock) -> Result<Finding, Finding> {
    let mut simulation = text.build()?;
    place(&mut simulation, |X| X + Vector3::new(0.0, 0.0, 0.05 * X.x * X.x));
    let start = simulation.energies().total();
    let mut energies = Vec::with_capacity(steps);
    let end = march_with(&mut simulation, steps, clock, |simulation| energies.push(simulation.energies().total()));
    if let Some(trouble) = end.trouble() {
        return Err(trouble);
    }
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let (first, second) = energies.split_at(steps / 2);
    let drift = (mean(second) - mean(first)) / start;
    let largest = energies.iter().fold(0.0, |largest: f64, &energy| largest.max(energy)) / start;
    let last = energies.last().copied().unwrap_or_default() / start;
    let note = format!("energy over that of the start: at most {largest:.6}, last {last:.3e}; drift {drift:.1e}");
    Ok(Finding::within(if decays { largest } else { drift.abs() / 0.01 }, note))
}

/// Steps that follow each other, s; all below the limit where there is one.
const CHANGING: [(&str, [f64; 3]); 4] = [
    ("implicit_euler", [0.01, 1e-4, 0.1]),
    ("linearly_implicit_euler", [0.01, 1e-4, 0.002]),
    ("verlet", [1e-3, 1e-5, 3e-3]),
    ("rk4", [1e-3, 1e-5, 3e-3]),
];

fn changing(text: Text, dts: [f64; 3]) -> Case {
    Case {
        family: FAMILY,
        case: "time step changed while it runs".to_owned(),
        parameters: format!("E = 1e5 Pa, dt = {dts:?} s in turn, 10 steps each, 100 times"),
        integrator: text.integrator.to_owned(),
        material: text.model.to_owned(),
        expected: Outcome::Survives,
        margin_is: "largest energy / 1.1 times that at the start; must be at most 1",
        seed: None,
        work: Box::new(move |clock| changed(&text, dts, clock).unwrap_or_else(|finding| finding)),
    }
}

fn changed(text: &Text, dts: [f64; 3], clock: Clock) -> Result<Finding, Finding> {
    let mut simulation = text.build()?;
    place(&mut simulation, |X| X + Vector3::new(0.0, 0.0, 0.05 * X.x * X.x));
    let start = simulation.energies().total();
    let mut largest: f64 = 0.0;
    for round in 0..100 {
        let set = simulation.set_parameter("dt", dts[round % 3]);
        set.map_err(|problem| Finding::plain(Outcome::Refused, problem))?;
        let end =
            march_with(&mut simulation, 10, clock, |simulation| largest = largest.max(simulation.energies().total()));
        if let Some(trouble) = end.trouble() {
            return Err(trouble);
        }
    }
    Ok(Finding::within(largest / (1.1 * start), format!("largest energy {:.4} of that at the start", largest / start)))
}
