//! Bodies that hit planes: fast, stiff, with much friction or none. No node is behind a plane after any step.

use fem_model::Integrator;
use fem_model::simulation::Diagnostics;

use crate::stability::case::{Case, Finding, Outcome};
use crate::stability::march::march_with;
use crate::stability::scene_text::{LUMPED, SceneText};
use crate::study::Deadline;

const FAMILY: &str = "contact";

/// Meshes of a solid and of a flat block.
pub const BODIES: [(&str, &str); 2] = [
    ("solid", "box = { size = [1, 1, 1], pattern = \"kuhn\", cells_per_unit = 2 }"),
    ("flat", "rectangle = { size = [1, 1], pattern = \"kuhn\", cells_per_unit = 3 }"),
];

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let bodies = if quick { &BODIES[1..] } else { &BODIES[..] };
    for (name, mesh) in bodies {
        for young in if quick { vec![1e5] } else { vec![1e4, 1e7, 2e11] } {
            for friction in if quick { vec![0.5] } else { vec![0.0, 0.5, 10.0] } {
                // Fractions of the speed of waves in the body.
                for speed in [1e-3, 0.2] {
                    let methods = [Integrator::ImplicitEuler, Integrator::Verlet, Integrator::SemiImplicitEuler];
                    // Bathe's method has no contact.
                    let second_order =
                        Integrator::second_order_implicit().filter(|integrator| *integrator != Integrator::Bathe);
                    for integrator in methods.into_iter().chain(second_order) {
                        let text = SceneText {
                            mesh: (*mesh).to_owned(),
                            young,
                            ..SceneText::small(integrator, "stable_neo_hookean")
                        };
                        cases.push(hit(text, name, friction, speed));
                    }
                }
            }
        }
    }
}

/// A block that flies into the corner of two planes.
pub fn hit(text: SceneText, body: &str, friction: f64, part: f64) -> Case {
    let wave = (text.young / text.density).sqrt();
    let speed = part * wave;
    let plane = |point: [f64; 3], normal: [f64; 3]| {
        format!("[[planes]]\npoint = {point:?}\nnormal = {normal:?}\nfriction = {friction}\n")
    };
    let planes = plane([0.0, -0.05, 0.0], [0.0, 1.0, 0.0]) + &plane([1.3, 0.0, 0.0], [-1.0, 1.0, 0.0]);
    let motion = format!("[[initial_velocity]]\nvelocity = [{}, {}, 0]\n", 0.5 * speed, -speed);
    let is_explicit = !text.integrator.has_newton() && !text.integrator.is_iterated();
    let (dt, steps) = if is_explicit { (0.01 / wave, 400) } else { (0.1 / wave, 60) };
    let text = SceneText { dt, ..text }.with(&planes).with(&motion).with(if is_explicit { LUMPED } else { "" });
    let parameters = format!(
        "{body}, E = {:e} Pa, friction {friction}, {part} of the speed of waves, dt = {dt:.2e} s, {steps} steps",
        text.young
    );
    Case {
        // The line search of projective dynamics would need the barrier, so the method refuses contact.
        expected: if text.integrator.facts().contact.is_some() { Outcome::Survives } else { Outcome::Refused },
        margin_is: "smallest distance from a plane in steps, m; must not be negative",
        ..text.clone().case(FAMILY, "flies into a corner", parameters, move |deadline| watched(&text, steps, deadline))
    }
}

fn watched(text: &SceneText, steps: usize, deadline: Deadline) -> Result<Finding, Finding> {
    let mut simulation = text.build()?;
    let mut smallest = f64::INFINITY;
    let end = march_with(&mut simulation, steps, deadline, |simulation| {
        smallest = simulation.contacts().iter().map(|plane| plane.smallest_gap).fold(smallest, f64::min);
    });
    if let Some(trouble) = end.trouble() {
        return Err(trouble);
    }
    let outcome = if smallest >= -1e-12 { Outcome::Survives } else { Outcome::Deviates };
    Ok(Finding::new(outcome, smallest, end.note()))
}
