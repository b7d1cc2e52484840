//! A bar that hits a wall: the wave of compression runs to its free end and back.

use fem_model::Integrator;
use fem_model::simulation::{Diagnostics, Simulation};

use super::{has_barrier, momentum};
use crate::scenes::{double, step};

/// 2 L/c for the bar of 1 m and c = 10 m/s, s.
pub const DURATION: f64 = 0.2;
/// ρ c v, Pa.
pub const STRESS: f64 = 1000.0;

/// An impact.
pub struct Impact {
    /// Time in contact, s.
    pub duration: f64,
    /// Mean stress of the wall while the wave runs, Pa.
    pub stress: f64,
    /// Relative difference of the wall's impulse and the change of momentum.
    pub impulse_error: f64,
}

/// A bar of 1 m in 100 squares without lateral contraction, which meets a wall at x = 0 with 0.1 m/s.
pub fn bar(method: Integrator) -> Result<Impact, String> {
    let dt = 4e-4;
    let contact = if has_barrier(method) { "[contact]\nactivation_distance = 2e-5\n" } else { "" };
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nrectangle = {{ size = [1, 0.01], cells_per_unit = 100, pattern = \"kuhn\" }}\n\
         [material]\nmodel = \"linear\"\nyoung = 1e5\npoisson = 0\ndensity = 1000\n\
         [time]\ndt = {dt:e}\nintegrator = \"{}\"\n\
         [[planes]]\npoint = [-1e-6, 0, 0]\nnormal = [1, 0, 0]\n{contact}\
         [[initial_velocity]]\nvelocity = [-0.1, 0, 0]\n",
        method.name()
    );
    let mut simulation = double(&text, None)?;
    let before = momentum(&simulation);
    let (mut first, mut last, mut impulse, mut steady) = (f64::INFINITY, 0.0, 0.0, Vec::new());
    while simulation.time() < 0.3 {
        step(&mut simulation)?;
        let (time, force) = (simulation.time(), simulation.contacts()[0].force[0]);
        impulse += dt * force;
        if force > 0.0 {
            (first, last) = (f64::min(first, time), time);
        }
        if (0.04..0.16).contains(&time) {
            steady.push(force / 0.01);
        }
    }
    let change = momentum(&simulation) - before;
    Ok(Impact {
        duration: last - first,
        stress: steady.iter().sum::<f64>() / steady.len() as f64,
        impulse_error: (impulse / change - 1.0).abs(),
    })
}
