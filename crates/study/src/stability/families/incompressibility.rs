//! Nearly incompressible materials: survival, and volumetric locking.

use fem_engine::cantilever::{expected_tip_displacement, tip_displacement};
use fem_model::Integrator;
use fem_model::simulation::Simulation;

use crate::scenes::{Elements, LINEAR, WITHOUT_LOCKING};
use crate::space::locking::{RATIOS, ratios};
use crate::stability::case::{Case, Finding, Outcome};
use crate::stability::march::march;
use crate::stability::scene_text::{CLAMPED, LAWS, SceneText, gravity};

const FAMILY: &str = "Poisson's ratio";

/// The case that shows locking.
pub const CANTILEVER: &str = "slender cantilever against Timoshenko's beam theory";

/// A cantilever locks if its tip deflection is below this share of theory.
const LOCKED: f64 = 0.5;

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let laws: &[&str] = if quick { &LAWS[3..] } else { &LAWS };
    for poisson in RATIOS {
        for &model in laws {
            for (integrator, steps) in
                [(Integrator::ImplicitEuler, if quick { 10 } else { 50 }), (Integrator::Static, 1)]
            {
                let text = SceneText { poisson, young: 1e6, ..SceneText::finer(integrator, model) };
                cases.push(sagging(text.with(CLAMPED).with(&gravity([0.0, 0.0, -9.81])), steps));
            }
        }
        let cells: &[usize] = if quick { &[4] } else { &[2, 4, 6] };
        cases.extend(cells.iter().map(|&cells| cantilever(LINEAR, poisson, cells)));
    }
    for elements in WITHOUT_LOCKING {
        let all: Vec<f64> = ratios(elements).collect();
        let shown = if quick { &all[all.len() - 1..] } else { &all };
        cases.extend(shown.iter().map(|&poisson| cantilever(elements, poisson, 2)));
    }
}

fn sagging(text: SceneText, steps: usize) -> Case {
    let parameters = format!("nu = {}, E = {:e} Pa, dt = {:e} s, {steps} steps", text.poisson, text.young, text.dt);
    text.surviving(FAMILY, "clamped body, sagging under its weight", parameters, steps)
}

/// A slender beam. Near ν = ½ linear elements lock on all these meshes, and the study expects that, as it expects that the others do not.
fn cantilever(elements: Elements, poisson: f64, cells: usize) -> Case {
    // Two cells across lock sooner.
    let locks = elements == LINEAR && poisson > if cells > 2 { 0.48 } else { 0.44 };
    let mesh = format!("box = {{ size = [8, 1, 1], pattern = \"kuhn\", cells_per_unit = {cells} }}");
    let end = "[[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\nforce_per_area = [0, 0, -50]\n";
    let text =
        SceneText { mesh, elements, poisson, young: 1e6, dt: 1.0, ..SceneText::small(Integrator::Static, "linear") };
    let text = text.with(CLAMPED).with(end);
    let parameters = format!("nu = {poisson}, 8 x 1 x 1 m, {cells} cells per metre");
    Case {
        expected: if locks { Outcome::Locks } else { Outcome::Survives },
        margin_is: "tip deflection over that of theory; 1 is exact, below 0.5 counts as locked",
        ..text.clone().case(FAMILY, CANTILEVER, parameters, move |deadline| {
            let (scene, body) = text.scene_and_body()?;
            let mut simulation = text.build()?;
            if let Some(trouble) = march(&mut simulation, 1, deadline).trouble() {
                return Ok(trouble);
            }
            let theory = expected_tip_displacement(&body, &scene.method()).unwrap_or_default();
            let part = tip_displacement(&simulation).dot(&theory) / theory.norm_squared();
            let outcome = if part < LOCKED { Outcome::Locks } else { Outcome::Survives };
            let nodes = simulation.shape().mesh.vertices().len();
            let note = format!("tip deflection {:.4} of {:.4e} m; {nodes} nodes", part, theory.norm());
            Ok(Finding::new(outcome, part, note))
        })
    }
}
