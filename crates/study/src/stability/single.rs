//! Single precision beside double: half of the digits must carry the same motion.

use nalgebra::{DVector, Vector3};

use super::case::{Case, Clock, Finding, Outcome};
use super::march::march;
use super::matrix::{DT, YOUNG, clamped};
use super::scene_text::{Text, gravity, moved_box};
use fem_engine::number::Real;
use fem_scene::simulation::Simulation;

const FAMILY: &str = "single precision";

/// What a last iteration may still change, in lengths of the body: in single precision, and in double.
const TOLERANCES: [&str; 2] = ["[newton]\ntolerance = 1e-6\n", "[newton]\ntolerance = 1e-12\n"];

/// Steps, where there is motion.
const STEPS: usize = 50;

/// Largest distance from the answer in double, as a part of the largest displacement.
const SAME: f64 = 1e-4;

const MARGIN_IS: &str =
    "largest distance from the answer in double / 1e-4 of the largest displacement; must be at most 1";

/// Methods and steps, s; all below the limits of E = 1e5 Pa.
const METHODS: [(&str, f64); 6] = [
    ("semi_implicit_euler", 0.002),
    ("rk2", 0.001),
    ("rk4", 0.002),
    ("verlet", 0.002),
    ("linearly_implicit_euler", 0.005),
    ("static", 1.0),
];

/// Adds the chapter.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    for model in ["neo_hookean", "stable_neo_hookean"] {
        let mut add = |name, text, place| cases.push(beside(name, text, place));
        for &young in if quick { &YOUNG[..1] } else { &YOUNG } {
            for dt in DT {
                add("clamped body, sagging", clamped("implicit_euler", model, young, dt), |x| *x);
            }
        }
        for &(integrator, dt) in if quick { &METHODS[3..5] } else { &METHODS } {
            add("clamped body, sagging", clamped(integrator, model, 1e5, dt), |x| *x);
        }
        let text = || clamped("implicit_euler", model, 1e5, 0.02);
        add("the same, moved by (1e6, -1e6, 1e6) m", text(), |x| x + Vector3::new(1e6, -1e6, 1e6));
        add("the same, a millionth as large", text(), |x| 1e-6 * x);
        add("the same, a million times as large", text(), |x| 1e6 * x);
    }
}

/// Where a node of a box of 2 × 1 × 1 m is.
type Place = fn(&Vector3<f64>) -> Vector3<f64>;

fn beside(name: &str, text: Text, place: Place) -> Case {
    Case {
        family: FAMILY,
        case: format!("{name} under a weight of a quarter of E times its cross-section"),
        parameters: format!("E = {:e} Pa, dt = {:e} s", text.young, text.dt),
        integrator: text.integrator.to_owned(),
        material: text.model.to_owned(),
        expected: Outcome::Survives,
        margin_is: MARGIN_IS,
        seed: None,
        work: Box::new(move |clock| compared(&text, place, clock).unwrap_or_else(|finding| finding)),
    }
}

fn compared(text: &Text, place: Place, clock: Clock) -> Result<Finding, Finding> {
    let length = (place(&Vector3::new(2.0, 0.0, 0.0)) - place(&Vector3::zeros())).norm();
    let weight = gravity([0.0, 0.0, -text.young / (4.0 * text.density * length)]);
    let double = end::<f64>(&text.clone().with(&weight).with(TOLERANCES[1]), place, clock)?;
    let single = Text { rest: format!("precision = \"f32\"\n{}", text.rest), ..text.clone() };
    let single = end::<f32>(&single.with(&weight).with(TOLERANCES[0]), place, clock)?;
    let apart = (&double - single).amax() / double.amax();
    let outcome = if apart <= SAME { Outcome::Survives } else { Outcome::Deviates };
    Ok(Finding::new(outcome, apart / SAME, format!("{apart:.2e} of a displacement of {:.2e} m", double.amax())))
}

/// Displacements at the end, m.
fn end<T: Real>(text: &Text, place: Place, clock: Clock) -> Result<DVector<f64>, Finding> {
    let mut simulation = text.build_on_as::<T>(moved_box([2.0, 1.0, 1.0], 1, place)?)?;
    let start = simulation.positions();
    let march = march(&mut simulation, if text.integrator == "static" { 1 } else { STEPS }, clock);
    match march.trouble() {
        Some(trouble) => Err(trouble),
        None => Ok(simulation.positions() - start),
    }
}
