//! VBD, vertex block descent: Chen, Liu, Yang and Yuksel, Vertex block descent (2024), algorithm 1.

use fem_model::IterationSettings;

use super::descent::Descent;
use super::relaxation::Relaxed;
use crate::forces::contact::planes::Planes;
use crate::model::system::System;
use fem_solvers::Real;

/// VBD: each sweep minimises the incremental potential of implicit Euler over the displacement of each node in turn, by one step of
/// Newton's method. Sweeps converge to implicit Euler. Before that the forces between nodes are not equal and opposite, so that a step
/// of few sweeps does not conserve momentum.
pub type Vbd<T> = Relaxed<T, Descent<T>>;

/// VBD for the nodes of a body.
pub fn vbd<T: Real>(settings: &IterationSettings, system: &System<T>, planes: Option<&Planes>) -> Vbd<T> {
    Relaxed::new(Descent::new(settings, system), settings, system, planes)
}
