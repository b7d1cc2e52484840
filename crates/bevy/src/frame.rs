//! The state of a body after one step.

use bevy::math::DVec3;
use fem_model::simulation::Simulation;

use crate::surface::{Surface, Topology};

/// The state after a step, as the main thread gets it.
pub struct Frame {
    /// Number of steps since the start.
    pub step: usize,
    /// Simulated time, s.
    pub time: f64,
    /// Positions of the nodes, m.
    pub nodes: Vec<DVec3>,
    /// The surface.
    pub surface: Surface,
}

impl Frame {
    /// The state of a simulation now.
    pub fn of(simulation: &dyn Simulation, topology: &Topology) -> Self {
        let nodes = simulation.positions().as_slice().chunks_exact(3).map(DVec3::from_slice).collect();
        let surface = topology.surface(&simulation.display_positions());
        Self { step: simulation.steps(), time: simulation.time(), nodes, surface }
    }
}
