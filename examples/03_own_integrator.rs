//! 3. A time integration loop of one's own over the engine's system and state: the symplectic method of Forest and Ruth.
//!
//! `cargo run --release --example 03_own_integrator`

use std::error::Error;

use fem_engine::forces::Moment;
use fem_engine::integrators::{Accelerations, Stage};
use fem_engine::model::state::State;
use fem_engine::model::system::System;
use fem_engine::simulator::Simulator;
use fem_mesh::{Pattern, box_mesh};
use fem_model::simulation::{Cause, Counters};
use fem_model::{Axis, Body, Elastic, Integrator, Law, Material, Method, Selector};

/// Adds `factor` x to y.
fn add(factor: f64, x: &[[f64; 3]], y: &mut [[f64; 3]]) {
    for (y, x) in y.as_flattened_mut().iter_mut().zip(x.as_flattened()) {
        *y += factor * x;
    }
}

/// Steps from rest to `end` (s), and returns the largest error of the total energy on the way, J.
///
/// Drifts and kicks of the fourth-order method of E. Forest and R. D. Ruth, Physica D 43, 1990.
fn largest_energy_error(system: &System<f64>, end: f64, steps: usize) -> Result<f64, Cause> {
    let theta = 1.0 / (2.0 - 2f64.cbrt());
    let drifts = [0.5 * theta, 0.5 * (1.0 - theta), 0.5 * (1.0 - theta), 0.5 * theta];
    let kicks = [theta, 1.0 - 2.0 * theta, theta, 0.0];
    let (dt, mut state, mut counters) = (end / steps as f64, State::at_rest(system.nodes()), Counters::default());
    let (mut accelerations, mut a) = (Accelerations::new(system), vec![[0.0; 3]; system.nodes()]);
    let mut largest: f64 = 0.0;
    for _ in 0..steps {
        accelerations.begin(system, &mut state, dt, &mut a)?;
        let mut after = 0.0;
        for (drift, kick) in drifts.into_iter().zip(kicks) {
            add(drift * dt, &state.v, &mut state.u);
            after += drift;
            if kick != 0.0 {
                let stage = Stage { after, weight: kick };
                accelerations.at(system, (&mut state.u, &mut state.v), stage, &mut a, &mut counters)?;
                add(kick * dt, &a, &mut state.v);
            }
        }
        accelerations.end(system, &mut state);
        state.time += dt;
        // A body at rest has no energy.
        let energy = system.potential(&state.u, Moment::at(state.time)).value + system.mass.kinetic_energy(&state.v);
        largest = largest.max(energy.abs());
    }
    Ok(largest)
}

/// The largest error of the energy in 1 s with 80 and with 160 steps, J.
pub fn run() -> Result<[f64; 2], Box<dyn Error>> {
    let rubber = Material::new(Law::StableNeoHookean(Elastic::new(1e4, 0.3)), 1000.0);
    let body = Body::new(box_mesh([1.0, 0.5, 0.5], 2, Pattern::default())?, rubber)?;
    let body = body.gravity([0.0, 0.0, -1.0])?.fix(&Selector::least(Axis::X))?;
    let simulator = Simulator::<f64>::new(body, &Method::new(Integrator::Verlet, 0.01))?;
    let error = |steps| largest_energy_error(simulator.system(), 1.0, steps).map_err(|cause| format!("{cause:?}"));
    Ok([error(80)?, error(160)?])
}

#[allow(dead_code)] // the test calls `run`
fn main() -> Result<(), Box<dyn Error>> {
    let [coarse, fine] = run()?;
    println!("largest error of the energy: {coarse:.3e} J, with half of the time step {fine:.3e} J");
    println!("observed order {:.2}", (coarse / fine).log2());
    Ok(())
}
