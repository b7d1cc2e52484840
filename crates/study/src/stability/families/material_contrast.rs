//! Neighbouring elements with very different stiffness or density.

use fem_engine::simulator::Simulator;
use fem_model::Integrator;

use super::*;

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
    for ((contrast, law), (integrator, dt)) in pairs(pairs(CONTRASTS, NEO_HOOKEAN), METHODS) {
        let setup = Setup { young: contrast.young_at_clamp, dt, ..Setup::finer(integrator, law) };
        cases.push(case(contrast, setup.with(clamp), if quick { 20 } else { 200 }));
    }
}

fn case(contrast: Contrast, setup: Setup, steps: usize) -> Case {
    let steps = if setup.integrator == Integrator::Static { 1 } else { steps };
    let soft = setup.young * contrast.young.min(1.0);
    let heavy = setup.density * contrast.density.max(1.0);
    // A hundredth of the stiffness of the softer half.
    let setup = setup.with(gravity([0.0, 0.0, -0.01 * soft / heavy]));
    let step = if setup.integrator == Integrator::Verlet {
        "0.9 of the largest stable step".to_owned()
    } else {
        format!("{:e} s", setup.dt)
    };
    let parameters = format!("at the clamp E = {:e} Pa, 1e3 kg/m3; dt = {step}, {steps} steps", setup.young);
    setup.case(FAMILY, contrast.name, parameters, move |setup, deadline| {
        let mut setup = setup.clone();
        if setup.integrator == Integrator::Verlet {
            setup.dt = 0.9 * 2.0 / excite(&mut build(&setup, contrast)?, 0.0)?.omega;
        }
        Ok(march(&mut build(&setup, contrast)?, steps, deadline).survival())
    })
}

fn build(setup: &Setup, contrast: Contrast) -> Result<Simulator<f64>, Finding> {
    let mut body = setup.body()?;
    let mesh = &body.shape.mesh;
    let is_beyond = |nodes: &[usize]| nodes.iter().map(|&node| mesh.vertices()[node].x).sum::<f64>() > 4.0;
    let beyond: Vec<bool> = mesh.corners().map(is_beyond).collect();
    let factors = |factor: f64| beyond.iter().map(|&beyond| if beyond { factor } else { 1.0 }).collect();
    (body.stiffness_factors, body.density_factors) = (factors(contrast.young), factors(contrast.density));
    Simulator::new(body, &setup.method()).map_err(refused)
}
