//! A block at rest on the barrier of a floor.

use fem_model::simulation::{Diagnostics, Simulation};

use crate::scenes::double;

/// Weight of the block of 1000 kg, N.
pub const WEIGHT: f64 = 9810.0;
/// The activation distance of a block of 1 m, m.
pub const ACTIVATION: f64 = 1e-3;

/// A block at rest.
pub struct Block {
    /// Distance from the floor, m.
    pub gap: f64,
    /// The distance at which the barrier's force is the weight, m.
    pub root: f64,
    /// Force of the floor, N.
    pub force: f64,
    /// Steps that have not converged.
    pub unconverged: usize,
}

/// A square of 1 m of this Young's modulus (Pa) after 40 s. Displacements of steel are so small that round-off leaves nine
/// digits of a step; steps in which it leaves fewer are counted.
pub fn block(young: f64) -> Result<Block, String> {
    let text = format!(
        "pipeline = \"engine\"\n[mesh]\nrectangle = {{ size = [1, 1], cells_per_unit = 1 }}\n[material]\nmodel = \"corotated\"\n\
         young = {young:e}\npoisson = 0.3\ndensity = 1000\n[time]\ndt = 0.02\nintegrator = \"implicit_euler\"\n[newton]\ntolerance = 1e-9\n\
         [gravity]\nacceleration = [0, -9.81, 0]\n[[planes]]\npoint = [0, -5e-4, 0]\nnormal = [0, 1, 0]\n"
    );
    let mut simulation = double(&text, None)?;
    for _ in 0..2000 {
        simulation.step().map_err(|failure| failure.to_string())?;
    }
    let contact = &simulation.contacts()[0];
    let unconverged = simulation.counters().unconverged_steps;
    Ok(Block { gap: contact.smallest_gap, root: root(young), force: contact.force[1], unconverged })
}

/// The nodes below share the lower side of 1 m²: κ |b'(gap/d̂)| · 1 m² = m g with κ of the shear modulus and the pressure under the weight;
/// by bisection.
fn root(young: f64) -> f64 {
    let stiffness = young / 2.6 + WEIGHT;
    let (mut lower, mut upper) = (1e-6, 1.0);
    for _ in 0..200 {
        let middle = 0.5 * (lower + upper);
        *(if -stiffness * slope(middle) > WEIGHT { &mut lower } else { &mut upper }) = middle;
    }
    lower * ACTIVATION
}

/// b'(s) of the barrier b(s) = −(s − 1)² ln s, Li et al. (2020).
fn slope(s: f64) -> f64 {
    -2.0 * (s - 1.0) * s.ln() - (s - 1.0).powi(2) / s
}
