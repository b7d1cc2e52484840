//! Single precision compared with double precision.

use fem_engine::simulator::Compiled;
use fem_model::simulation::Simulation;
use fem_model::{Integrator, Precision};
use nalgebra::{DVector, Vector3};

use super::stiffness_and_step::{DT, YOUNG};
use super::*;

const FAMILY: &str = "single precision";

/// Tolerance of Newton's method in double precision; single precision has its own.
const TOLERANCE: f64 = 1e-12;

/// Steps of the integrators in time.
const STEPS: usize = 50;

/// Largest difference of displacements, relative to the largest displacement. Round-off in single precision decides some 1e-4 of it after 50 steps
/// without damping.
const SAME: f64 = 3e-4;

const MARGIN_IS: &str =
    "largest difference from double precision / 3e-4 of the largest displacement, round-off; must be at most 1";

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
    let mut add = |name, setup, place| cases.push(compared(name, setup, place));
    let sagging = "clamped body, sagging";
    let methods = [(Integrator::ImplicitEuler, 0.005), (Integrator::Static, 1.0)];
    for (law, (integrator, dt)) in pairs(["linear", "corotated", "st_venant_kirchhoff"], methods) {
        add(sagging, clamped(integrator, law, 1e5, dt), |x| *x);
    }
    for law in NEO_HOOKEAN {
        for (&young, dt) in pairs(if quick { &YOUNG[..1] } else { &YOUNG }, DT) {
            add(sagging, clamped(Integrator::ImplicitEuler, law, young, dt), |x| *x);
        }
        for &(integrator, dt) in if quick { &METHODS[3..9] } else { &METHODS } {
            add(sagging, clamped(integrator, law, 1e5, dt), |x| *x);
        }
        let setup = || clamped(Integrator::ImplicitEuler, law, 1e5, 0.02);
        add("shifted by (1e6, -1e6, 1e6) m, sagging", setup(), |x| x + Vector3::new(1e6, -1e6, 1e6));
        add("scaled by 1e-6, sagging", setup(), |x| 1e-6 * x);
        add("scaled by 1e6, sagging", setup(), |x| 1e6 * x);
    }
}

/// Position of a node of a box of 2 × 1 × 1 m.
pub type Place = fn(&Vector3<f64>) -> Vector3<f64>;

pub fn compared(name: &str, setup: Setup, place: Place) -> Case {
    let case = format!("{name} under a weight of a quarter of E times its cross-section");
    let parameters = format!("E = {:e} Pa, dt = {:e} s", setup.young, setup.dt);
    Case {
        margin_is: MARGIN_IS,
        ..setup.case(FAMILY, case, parameters, move |setup, deadline| difference(setup, place, deadline))
    }
}

fn difference(setup: &Setup, place: Place, deadline: Deadline) -> Result<Finding, Finding> {
    let length = (place(&Vector3::new(2.0, 0.0, 0.0)) - place(&Vector3::zeros())).norm();
    let setup = setup.clone().with(gravity([0.0, 0.0, -setup.young / (4.0 * setup.density * length)]));
    let double = end::<f64>(&setup.clone().newton(TOLERANCE), place, deadline)?;
    let single = end::<f32>(&setup.set(|method| method.precision = Precision::F32), place, deadline)?;
    let apart = (&double - single).amax() / double.amax();
    Ok(Finding::within(apart / SAME, format!("{apart:.2e} of a displacement of {:.2e} m", double.amax())))
}

/// Displacements at the end, m.
fn end<T: Compiled>(setup: &Setup, place: Place, deadline: Deadline) -> Result<DVector<f64>, Finding> {
    let mut simulation = setup.build_on::<T>(moved_box([2.0, 1.0, 1.0], 1, place)?)?;
    let start = simulation.positions();
    let steps = if setup.integrator == Integrator::Static { 1 } else { STEPS };
    march(&mut simulation, steps, deadline).survived()?;
    Ok(simulation.positions() - start)
}
