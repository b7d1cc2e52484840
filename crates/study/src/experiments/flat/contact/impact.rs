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

/// A bar of 1 m in so many squares of two triangles of an order, without lateral contraction, which meets a wall at x = 0 with 0.1 m/s. A wave crosses
/// a square in two and a half steps.
pub fn bar(method: Integrator, cells: usize, order: usize) -> Result<Impact, String> {
    let width = 1.0 / cells as f64;
    let (dt, distance) = (0.04 * width, 2e-3 * width);
    let contact =
        if has_barrier(method) { format!("[contact]\nactivation_distance = {distance:e}\n") } else { String::new() };
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nrectangle = {{ size = [1, {width:e}], cells_per_unit = {cells}, pattern = \"kuhn\" }}\norder = {order}\n\
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
            steady.push(force / width);
        }
    }
    let change = momentum(&simulation) - before;
    Ok(Impact {
        duration: last - first,
        stress: steady.iter().sum::<f64>() / steady.len() as f64,
        impulse_error: (impulse / change - 1.0).abs(),
    })
}
