//! Elements a million times longer than thick.

use nalgebra::Vector3;

use super::case::{Case, Clock, Finding, Outcome};
use super::march::{SMALLEST_J, march};
use super::matrix::excite;
use super::scene_text::{CLAMPED, Text, gravity, moved_box};
use fem_mesh::TetrahedralMesh;

const FAMILY: &str = "slivers";

/// Edge over thickness.
const ASPECT: f64 = 1e6;

/// Adds the chapter.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    for thin in [Thin::Sheet, Thin::Needle] {
        for model in ["neo_hookean", "stable_neo_hookean"] {
            for integrator in ["implicit_euler", "linearly_implicit_euler", "static", "verlet"] {
                cases.push(sliver(thin, model, integrator, if quick { 10 } else { 100 }));
            }
        }
    }
}

#[derive(Clone, Copy, Debug)]
enum Thin {
    /// A layer of elements between two blocks, thin in one direction.
    Sheet,
    /// Two layers that cross: elements that are thin in two.
    Needle,
}

/// 0, 1, 2, 3 become 0, 1, 1 + thickness, 2 + thickness.
fn thinned(x: f64) -> f64 {
    if x > 1.5 { x - 1.0 + 1.0 / ASPECT } else { x }
}

fn mesh(thin: Thin) -> Result<TetrahedralMesh, Finding> {
    match thin {
        Thin::Sheet => moved_box([3.0, 1.0, 1.0], 1, |x| Vector3::new(thinned(x.x), x.y, x.z)),
        Thin::Needle => moved_box([3.0, 3.0, 1.0], 1, |x| Vector3::new(thinned(x.x), thinned(x.y), x.z)),
    }
}

fn sliver(thin: Thin, model: &'static str, integrator: &'static str, steps: usize) -> Case {
    let text = Text::small(integrator, model).with(CLAMPED).with(&gravity([0.0, 0.0, -2.0]));
    let steps = if integrator == "static" { 1 } else { steps };
    let step = if integrator == "verlet" { "half of the largest stable step".to_owned() } else { "0.01 s".to_owned() };
    let name = match thin {
        Thin::Sheet => "a layer of flat elements",
        Thin::Needle => "crossing layers with needles",
    };
    Case {
        family: FAMILY,
        case: name.to_owned(),
        parameters: format!("aspect {ASPECT:e}, dt = {step}, {steps} steps"),
        integrator: integrator.to_owned(),
        material: model.to_owned(),
        expected: Outcome::Survives,
        margin_is: SMALLEST_J,
        seed: None,
        work: Box::new(move |clock| tried(text, thin, steps, clock).unwrap_or_else(|finding| finding)),
    }
}

fn tried(mut text: Text, thin: Thin, steps: usize, clock: Clock) -> Result<Finding, Finding> {
    if text.integrator == "verlet" {
        let omega = excite(&mut text.build_on(mesh(thin)?)?, 0.0)?.omega;
        text.dt = 1.0 / omega;
    }
    let mut simulation = text.build_on(mesh(thin)?)?;
    Ok(march(&mut simulation, steps, clock).survival())
}
