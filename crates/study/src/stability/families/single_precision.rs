//! Single precision compared with double precision.

use fem_engine::simulator::Compiled;
use fem_model::Integrator;
use fem_model::simulation::Simulation;
use nalgebra::{DVector, Vector3};

use super::stiffness_and_step::{DT, YOUNG};
use crate::stability::case::{Case, Finding};
use crate::stability::forecast::clamped;
use crate::stability::march::march;
use crate::stability::scene_text::{SceneText, gravity, moved_box};
use crate::study::Deadline;

const FAMILY: &str = "single precision";

/// Tolerance of Newton's method in double precision; single precision has its own.
const TOLERANCE: &str = "[newton]\ntolerance = 1e-12\n";

/// Steps of the integrators in time.
const STEPS: usize = 50;

/// Largest difference of displacements, relative to the largest displacement.
const SAME: f64 = 1e-4;

const MARGIN_IS: &str =
    "largest difference from double precision / 1e-4 of the largest displacement, round-off; must be at most 1";

/// Integrators and time steps, s; all below the stability limits of E = 1e5 Pa.
const METHODS: [(Integrator, f64); 10] = [
    (Integrator::SemiImplicitEuler, 0.002),
    (Integrator::Rk2, 0.001),
    (Integrator::Rk4, 0.002),
    (Integrator::Verlet, 0.002),
    (Integrator::LinearlyImplicitEuler, 0.005),
    (Integrator::ImplicitMidpoint, 0.005),
    (Integrator::Newmark, 0.005),
    (Integrator::GeneralizedAlpha, 0.005),
    (Integrator::Bdf2, 0.005),
    (Integrator::Static, 1.0),
];

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    for model in ["linear", "corotated", "st_venant_kirchhoff"] {
        for (integrator, dt) in [(Integrator::ImplicitEuler, 0.005), (Integrator::Static, 1.0)] {
            cases.push(compared("clamped body, sagging", clamped(integrator, model, 1e5, dt), |x| *x));
        }
    }
    for model in ["neo_hookean", "stable_neo_hookean"] {
        let mut add = |name, text, place| cases.push(compared(name, text, place));
        for &young in if quick { &YOUNG[..1] } else { &YOUNG } {
            for dt in DT {
                add("clamped body, sagging", clamped(Integrator::ImplicitEuler, model, young, dt), |x| *x);
            }
        }
        for &(integrator, dt) in if quick { &METHODS[3..9] } else { &METHODS } {
            add("clamped body, sagging", clamped(integrator, model, 1e5, dt), |x| *x);
        }
        let text = || clamped(Integrator::ImplicitEuler, model, 1e5, 0.02);
        add("shifted by (1e6, -1e6, 1e6) m, sagging", text(), |x| x + Vector3::new(1e6, -1e6, 1e6));
        add("scaled by 1e-6, sagging", text(), |x| 1e-6 * x);
        add("scaled by 1e6, sagging", text(), |x| 1e6 * x);
    }
}

/// Position of a node of a box of 2 × 1 × 1 m.
pub type Place = fn(&Vector3<f64>) -> Vector3<f64>;

pub fn compared(name: &str, text: SceneText, place: Place) -> Case {
    let case = format!("{name} under a weight of a quarter of E times its cross-section");
    let parameters = format!("E = {:e} Pa, dt = {:e} s", text.young, text.dt);
    Case {
        margin_is: MARGIN_IS,
        ..text.clone().case(FAMILY, case, parameters, move |deadline| difference(&text, place, deadline))
    }
}

fn difference(text: &SceneText, place: Place, deadline: Deadline) -> Result<Finding, Finding> {
    let length = (place(&Vector3::new(2.0, 0.0, 0.0)) - place(&Vector3::zeros())).norm();
    let weight = gravity([0.0, 0.0, -text.young / (4.0 * text.density * length)]);
    let tolerance = if text.integrator.has_newton() { TOLERANCE } else { "" };
    let double = end::<f64>(&text.clone().with(&weight).with(tolerance), place, deadline)?;
    let single = SceneText { rest: format!("precision = \"f32\"\n{}", text.rest), ..text.clone() };
    let single = end::<f32>(&single.with(&weight), place, deadline)?;
    let apart = (&double - single).amax() / double.amax();
    Ok(Finding::within(apart / SAME, format!("{apart:.2e} of a displacement of {:.2e} m", double.amax())))
}

/// Displacements at the end, m.
fn end<T: Compiled>(text: &SceneText, place: Place, deadline: Deadline) -> Result<DVector<f64>, Finding> {
    let mut simulation = text.build_on_as::<T>(moved_box([2.0, 1.0, 1.0], 1, place)?)?;
    let start = simulation.positions();
    let march = march(&mut simulation, if text.integrator == Integrator::Static { 1 } else { STEPS }, deadline);
    match march.trouble() {
        Some(trouble) => Err(trouble),
        None => Ok(simulation.positions() - start),
    }
}
