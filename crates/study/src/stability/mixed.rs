//! Unlike materials side by side: soft beside stiff, light beside heavy.

use std::path::Path;

use super::case::{Case, Clock, Finding, Outcome};
use super::march::{SMALLEST_J, march};
use super::matrix::excite;
use super::scene_text::{CLAMPED, Text, gravity, refused};
use fem_engine::simulator::Simulator;
use fem_scene::body;

const FAMILY: &str = "unlike neighbours";

/// What the half of larger x has of the other half's.
#[derive(Clone, Copy, Debug)]
struct Factors {
    name: &'static str,
    young: f64,
    density: f64,
}

const MIXTURES: [Factors; 4] = [
    Factors { name: "1e9 Pa on 1e2 Pa", young: 1e7, density: 1.0 },
    Factors { name: "1e2 Pa on 1e9 Pa", young: 1e-7, density: 1.0 },
    Factors { name: "a million times as dense", young: 1.0, density: 1e6 },
    Factors { name: "a millionth as dense", young: 1.0, density: 1e-6 },
];

/// Adds the chapter.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    for mixture in MIXTURES {
        for model in ["neo_hookean", "stable_neo_hookean"] {
            for (integrator, dt) in [
                ("implicit_euler", 1e-5),
                ("implicit_euler", 0.01),
                ("implicit_euler", 1.0),
                ("linearly_implicit_euler", 0.01),
                ("static", 1.0),
                ("verlet", 1.0),
            ] {
                let young = if mixture.young > 1.0 {
                    1e2
                } else if mixture.young < 1.0 {
                    1e9
                } else {
                    1e5
                };
                let text = Text { young, dt, ..Text::finer(integrator, model) }.with(CLAMPED);
                cases.push(mixed(mixture, text, if quick { 20 } else { 200 }));
            }
        }
    }
}

fn mixed(mixture: Factors, text: Text, steps: usize) -> Case {
    let steps = if text.integrator == "static" { 1 } else { steps };
    let soft = text.young * mixture.young.min(1.0);
    let heavy = text.density * mixture.density.max(1.0);
    // A hundredth of the softer half's stiffness.
    let text = text.with(&gravity([0.0, 0.0, -0.01 * soft / heavy]));
    let step = if text.integrator == "verlet" {
        "0.9 of the largest stable step".to_owned()
    } else {
        format!("{:e} s", text.dt)
    };
    Case {
        family: FAMILY,
        case: mixture.name.to_owned(),
        parameters: format!("the half at the clamp: E = {:e} Pa, 1e3 kg/m3; dt = {step}, {steps} steps", text.young),
        integrator: text.integrator.to_owned(),
        material: text.model.to_owned(),
        expected: Outcome::Survives,
        margin_is: SMALLEST_J,
        seed: None,
        work: Box::new(move |clock| tried(mixture, text, steps, clock).unwrap_or_else(|finding| finding)),
    }
}

fn tried(mixture: Factors, mut text: Text, steps: usize, clock: Clock) -> Result<Finding, Finding> {
    if text.integrator == "verlet" {
        text.dt = 0.9 * 2.0 / excite(&mut build(&text, mixture)?, 0.0)?.omega;
    }
    Ok(march(&mut build(&text, mixture)?, steps, clock).survival())
}

fn build(text: &Text, mixture: Factors) -> Result<Simulator<f64>, Finding> {
    let scene = text.scene().map_err(refused)?;
    let mut body = body(&scene, Path::new("")).map_err(refused)?;
    let mesh = &body.shape.mesh;
    let is_beyond = |element: &[usize; 4]| element.iter().map(|&node| mesh.vertices[node].x).sum::<f64>() > 4.0;
    let beyond: Vec<bool> = mesh.elements.iter().map(is_beyond).collect();
    let factors = |factor: f64| beyond.iter().map(|&beyond| if beyond { factor } else { 1.0 }).collect();
    (body.stiffness_factors, body.density_factors) = (factors(mixture.young), factors(mixture.density));
    Simulator::new(&scene, body).map_err(refused)
}
