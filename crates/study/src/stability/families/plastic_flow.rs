//! Plastic flow: fast and slow creep, low yield, stiff bodies, large strains. The dissipated energy never falls.

use fem_model::Integrator;
use fem_model::simulation::Simulation;

use crate::stability::case::{Case, Finding, Outcome};
use crate::stability::march::march_with;
use crate::stability::scene_text::{CLAMPED, SceneText};
use crate::study::Deadline;

const FAMILY: &str = "plastic flow";

/// Meshes of a solid and of a flat bar of 2 m.
const BODIES: [(&str, &str); 2] = [
    ("solid", "box = { size = [2, 1, 1], pattern = \"kuhn\", cells_per_unit = 1 }"),
    ("flat", "rectangle = { size = [2, 1], pattern = \"kuhn\", cells_per_unit = 2 }"),
];

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let bodies = if quick { &BODIES[1..] } else { &BODIES[..] };
    for (name, mesh) in bodies {
        let text = |model, young| SceneText {
            mesh: (*mesh).to_owned(),
            young,
            ..SceneText::small(Integrator::ImplicitEuler, model)
        };
        for young in if quick { vec![1e5] } else { vec![1e2, 1e5, 1e12] } {
            for creep in [1e-3, 1.0, 1e9] {
                for yield_strain in [1e-12, 0.05] {
                    let flow = format!(
                        "model = \"additive\"\nyield_strain = {yield_strain:e}\ncreep = {creep:e}\nmaximum = 0.6\n"
                    );
                    let parameters =
                        format!("{name}, E = {young:e} Pa, yield strain {yield_strain:e}, creep {creep:e}/s");
                    cases.extend(driven(&text("corotated", young), &flow, &parameters));
                }
            }
            for (yields, hardening) in [(1e-9, 0.0), (1e-2, 0.0), (1e-2, 1e-1), (1e3, 0.0)] {
                let (stress, modulus) = (yields * young, hardening * young);
                let flow = format!("model = \"j2\"\nyield_stress = {stress:e}\nhardening = {modulus:e}\n");
                let parameters =
                    format!("{name}, E = {young:e} Pa, yield stress {stress:e} Pa, hardening {modulus:e} Pa");
                cases.extend(driven(&text("hencky", young), &flow, &parameters));
            }
        }
    }
}

/// The bar pulled to twice its length, and squashed to half of it, to and fro, each way in as many passages of a wave at every stiffness.
fn driven(text: &SceneText, flow: &str, parameters: &str) -> [Case; 2] {
    let half = 5.0 / (text.young / text.density).sqrt();
    [("pulled to twice its length and back", 2.0), ("squashed to half its length and back", -1.0)].map(|(case, distance)| {
        let curve = format!("curve = {{ table = [[0, 0], [{half:e}, 1], [{:e}, 0]] }}", 2.0 * half);
        let motion = format!(
            "[[prescribed]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\ndisplacement = [{distance}, 0, 0]\n{curve}\n"
        );
        let text = text.clone().with(CLAMPED).with(&motion).with(&format!("[plasticity]\n{flow}"));
        let text = SceneText { dt: half / 25.0, ..text };
        Case {
            margin_is: "smallest J",
            ..text.clone().case(FAMILY, case, parameters.to_owned(), move |deadline| watched(&text, deadline))
        }
    })
}

fn watched(text: &SceneText, deadline: Deadline) -> Result<Finding, Finding> {
    let mut simulation = text.build()?;
    let dissipated = |simulation: &dyn Simulation| simulation.plastic_flow().map_or(f64::NAN, |flow| flow.dissipated);
    let (mut before, mut falls) = (0.0, false);
    let end = march_with(&mut simulation, 60, deadline, |simulation| {
        let now = dissipated(simulation);
        falls |= !(now >= before);
        before = now;
    });
    let finding = end.survival();
    Ok(if falls { Finding::plain(Outcome::Deviates, "the dissipated energy falls".to_owned()) } else { finding })
}
