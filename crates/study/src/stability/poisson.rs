//! Nearly incompressible: what survives, and what locks.

use super::case::{Case, Finding, Outcome};
use super::march::{SMALLEST_J, march};
use super::scene_text::{CLAMPED, LAWS, Text, gravity};
use fem_engine::cantilever::{expected_tip_displacement, tip_displacement};
use fem_scene::simulation::Simulation;

const FAMILY: &str = "Poisson's ratio";

const POISSON: [f64; 6] = [0.0, 0.3, 0.45, 0.49, 0.499, 0.4999];

/// The case that tells of locking.
pub const CANTILEVER: &str = "slender cantilever beside Timoshenko's";

/// A tip that moves by less than this part of what theory says is locked.
const LOCKED: f64 = 0.5;

/// Adds the chapter.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let laws: &[&str] = if quick { &LAWS[3..] } else { &LAWS };
    for poisson in POISSON {
        for &model in laws {
            for (integrator, steps) in [("implicit_euler", if quick { 10 } else { 50 }), ("static", 1)] {
                let text = Text { poisson, young: 1e6, ..Text::finer(integrator, model) };
                cases.push(sagging(text.with(CLAMPED).with(&gravity([0.0, 0.0, -9.81])), steps));
            }
        }
        let cells: &[usize] = if quick { &[4] } else { &[2, 4, 6] };
        cases.extend(cells.iter().map(|&cells| cantilever(poisson, cells)));
    }
}

fn sagging(text: Text, steps: usize) -> Case {
    Case {
        family: FAMILY,
        case: "clamped body, sagging under its weight".to_owned(),
        parameters: format!("nu = {}, E = {:e} Pa, dt = {:e} s, {steps} steps", text.poisson, text.young, text.dt),
        integrator: text.integrator.to_owned(),
        material: text.model.to_owned(),
        expected: Outcome::Survives,
        margin_is: SMALLEST_J,
        seed: None,
        work: Box::new(move |clock| match text.build() {
            Ok(mut simulation) => march(&mut simulation, steps, clock).survival(),
            Err(finding) => finding,
        }),
    }
}

/// What linear tetrahedra make of a slender beam. Near ν = ½ they lock at any of these meshes, and that is what must be found:
/// who mends it mends the table.
fn cantilever(poisson: f64, cells: usize) -> Case {
    // Two cells across are too coarse for any beam, and lock sooner.
    let locks = poisson > if cells > 2 { 0.48 } else { 0.44 };
    let mesh = format!("box = {{ size = [8, 1, 1], cells_per_unit = {cells} }}");
    let end = "[[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\nforce_per_area = [0, 0, -50]\n";
    let text = Text { mesh, poisson, young: 1e6, dt: 1.0, ..Text::small("static", "linear") }.with(CLAMPED).with(end);
    Case {
        family: FAMILY,
        case: CANTILEVER.to_owned(),
        parameters: format!("nu = {poisson}, 8 x 1 x 1 m, {cells} cells a metre"),
        integrator: "static".to_owned(),
        material: "linear".to_owned(),
        expected: if locks { Outcome::Locks } else { Outcome::Survives },
        margin_is: "deflection of the tip over that of theory; 1 is right, below 0.5 is locked",
        seed: None,
        work: Box::new(move |clock| {
            let (mut simulation, scene) = match (text.build(), text.scene()) {
                (Ok(simulation), Ok(scene)) => (simulation, scene),
                (Err(finding), _) => return finding,
                (_, Err(error)) => return super::scene_text::refused(error),
            };
            let end = march(&mut simulation, 1, clock);
            if let Some(trouble) = end.trouble() {
                return trouble;
            }
            let theory = expected_tip_displacement(&scene).unwrap_or_default();
            let part = tip_displacement(&simulation).dot(&theory) / theory.norm_squared();
            let outcome = if part < LOCKED { Outcome::Locks } else { Outcome::Survives };
            let nodes = simulation.shape().mesh.vertices.len();
            Finding::new(outcome, part, format!("the tip moves {:.4} of {:.4e} m; {nodes} nodes", part, theory.norm()))
        }),
    }
}
