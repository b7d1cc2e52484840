//! Neighbouring elements with very different stiffness or density.

use fem_engine::simulator::Simulator;
use fem_model::Integrator;

use crate::stability::case::{Case, Finding};
use crate::stability::forecast::excite;
use crate::stability::march::march;
use crate::stability::scene_text::{CLAMPED, SceneText, gravity, refused};

const FAMILY: &str = "material contrast";

/// The half of larger x, relative to the half at the clamp.
#[derive(Clone, Copy, Debug)]
struct Contrast {
    name: &'static str,
    /// Young's modulus at the clamp, Pa.
    young_at_clamp: f64,
    young: f64,
    density: f64,
}

const CONTRASTS: [Contrast; 4] = [
    Contrast { name: "1e9 Pa on 1e2 Pa", young_at_clamp: 1e2, young: 1e7, density: 1.0 },
    Contrast { name: "1e2 Pa on 1e9 Pa", young_at_clamp: 1e9, young: 1e-7, density: 1.0 },
    Contrast { name: "density ratio 1e6", young_at_clamp: 1e5, young: 1.0, density: 1e6 },
    Contrast { name: "density ratio 1e-6", young_at_clamp: 1e5, young: 1.0, density: 1e-6 },
];

/// Integrators and time steps, s; Verlet takes its own.
const METHODS: [(Integrator, f64); 6] = [
    (Integrator::ImplicitEuler, 1e-5),
    (Integrator::ImplicitEuler, 0.01),
    (Integrator::ImplicitEuler, 1.0),
    (Integrator::LinearlyImplicitEuler, 0.01),
    (Integrator::Static, 1.0),
    (Integrator::Verlet, 1.0),
];

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    for contrast in CONTRASTS {
        for model in ["neo_hookean", "stable_neo_hookean"] {
            for (integrator, dt) in METHODS {
                let text = SceneText { young: contrast.young_at_clamp, dt, ..SceneText::finer(integrator, model) };
                cases.push(case(contrast, text.with(CLAMPED), if quick { 20 } else { 200 }));
            }
        }
    }
}

fn case(contrast: Contrast, text: SceneText, steps: usize) -> Case {
    let steps = if text.integrator == Integrator::Static { 1 } else { steps };
    let soft = text.young * contrast.young.min(1.0);
    let heavy = text.density * contrast.density.max(1.0);
    // A hundredth of the stiffness of the softer half.
    let mut text = text.with(&gravity([0.0, 0.0, -0.01 * soft / heavy]));
    let step = if text.integrator == Integrator::Verlet {
        "0.9 of the largest stable step".to_owned()
    } else {
        format!("{:e} s", text.dt)
    };
    let parameters = format!("at the clamp E = {:e} Pa, 1e3 kg/m3; dt = {step}, {steps} steps", text.young);
    text.clone().case(FAMILY, contrast.name, parameters, move |deadline| {
        if text.integrator == Integrator::Verlet {
            text.dt = 0.9 * 2.0 / excite(&mut build(&text, contrast)?, 0.0)?.omega;
        }
        Ok(march(&mut build(&text, contrast)?, steps, deadline).survival())
    })
}

fn build(text: &SceneText, contrast: Contrast) -> Result<Simulator<f64>, Finding> {
    let (scene, mut body) = text.scene_and_body()?;
    let mesh = &body.shape.mesh;
    let is_beyond = |nodes: &[usize]| nodes.iter().map(|&node| mesh.vertices()[node].x).sum::<f64>() > 4.0;
    let beyond: Vec<bool> = mesh.corners().map(is_beyond).collect();
    let factors = |factor: f64| beyond.iter().map(|&beyond| if beyond { factor } else { 1.0 }).collect();
    (body.stiffness_factors, body.density_factors) = (factors(contrast.young), factors(contrast.density));
    Simulator::new(body, &scene.method()).map_err(|refusal| refused(scene.refused(refusal)))
}
