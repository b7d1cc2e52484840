//! Ten thousand steps and more, and time steps that change within a run.

use fem_model::Integrator;
use fem_model::simulation::{Interactive, Simulation};
use nalgebra::Vector3;

use super::*;

const FAMILY: &str = "long runs";

/// Adds the family.
pub fn add(cases: &mut Vec<Case>, quick: bool) {
    let steps = if quick { 2000 } else { 20_000 };
    for law in NEO_HOOKEAN {
        let setup = |integrator, dt| Setup { dt, ..Setup::small(integrator, law) }.with(clamp);
        for (integrator, dt, decays) in LASTING {
            cases.push(lasting(setup(integrator, dt), steps, decays));
        }
        cases.extend(CHANGING.map(|(integrator, dts)| changing(setup(integrator, dts[0]), dts)));
    }
}

/// Integrators and time steps, s, with which the energy decays, or does not drift.
const LASTING: [(Integrator, f64, bool); 8] = [
    (Integrator::Verlet, 1e-3, false),
    (Integrator::SemiImplicitEuler, 1e-3, false),
    (Integrator::Rk4, 1e-3, false),
    (Integrator::ImplicitEuler, 0.01, true),
    (Integrator::ImplicitEuler, 1.0, true),
    (Integrator::ImplicitMidpoint, 0.01, false),
    (Integrator::Newmark, 0.01, false),
    (Integrator::Bdf2, 0.01, true),
];

const ENERGY: &str = "change of the mean energy between the two halves / 1 %; must be at most 1";
const DECAY: &str = "largest energy over the initial energy; must be at most 1";

/// Bends the body.
fn bent(X: &Vector3<f64>) -> Vector3<f64> {
    X + Vector3::new(0.0, 0.0, 0.05 * X.x * X.x)
}

/// A bent body, released.
fn lasting(setup: Setup, steps: usize, decays: bool) -> Case {
    let name = if decays { "energy never grows" } else { "energy does not drift" };
    let parameters = format!("E = 1e5 Pa, dt = {:e} s, {steps} steps", setup.dt);
    Case {
        margin_is: if decays { DECAY } else { ENERGY },
        ..setup.case(FAMILY, name, parameters, move |setup, deadline| watched(setup, steps, decays, deadline))
    }
}

fn watched(setup: &Setup, steps: usize, decays: bool, deadline: Deadline) -> Result<Finding, Finding> {
    let mut simulation = setup.build()?;
    place(&mut simulation, bent);
    let start = simulation.energies().total();
    let mut energies = Vec::with_capacity(steps);
    let end = march_with(&mut simulation, steps, deadline, |simulation| energies.push(simulation.energies().total()));
    end.survived()?;
    let mean = |part: &[f64]| part.iter().sum::<f64>() / part.len() as f64;
    let (first, second) = energies.split_at(steps / 2);
    let drift = (mean(second) - mean(first)) / start;
    let largest = energies.iter().fold(0.0, |largest: f64, &energy| largest.max(energy)) / start;
    let last = energies.last().copied().unwrap_or_default() / start;
    let note = format!("energy over initial energy: at most {largest:.6}, last {last:.3e}; drift {drift:.1e}");
    Ok(Finding::within(if decays { largest } else { drift.abs() / 0.01 }, note))
}

/// Time steps in turn, s; all below the stability limit.
const CHANGING: [(Integrator, [f64; 3]); 6] = [
    (Integrator::ImplicitEuler, [0.01, 1e-4, 0.1]),
    (Integrator::LinearlyImplicitEuler, [0.01, 1e-4, 0.002]),
    (Integrator::Newmark, [0.01, 1e-4, 0.02]),
    (Integrator::Bdf2, [0.01, 1e-4, 0.1]),
    (Integrator::Verlet, [1e-3, 1e-5, 3e-3]),
    (Integrator::Rk4, [1e-3, 1e-5, 3e-3]),
];

fn changing(setup: Setup, dts: [f64; 3]) -> Case {
    let parameters = format!("E = 1e5 Pa, dt = {dts:?} s in turn, 10 steps each, 100 times");
    Case {
        margin_is: "largest energy / 1.1 times the initial energy; must be at most 1",
        ..setup.case(FAMILY, "time step that changes", parameters, move |setup, deadline| changed(setup, dts, deadline))
    }
}

fn changed(setup: &Setup, dts: [f64; 3], deadline: Deadline) -> Result<Finding, Finding> {
    let mut simulation = setup.build()?;
    place(&mut simulation, bent);
    let start = simulation.energies().total();
    let mut largest: f64 = 0.0;
    for round in 0..100 {
        let set = simulation.set_parameter("dt", dts[round % 3]);
        set.map_err(|problem| Finding::plain(Outcome::Refused, problem))?;
        let end = march_with(&mut simulation, 10, deadline, |simulation| {
            largest = largest.max(simulation.energies().total());
        });
        end.survived()?;
    }
    Ok(Finding::within(largest / (1.1 * start), format!("largest energy {:.4} of the initial one", largest / start)))
}
