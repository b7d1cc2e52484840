//! PBD, position-based dynamics: Müller, Heidelberger, Hennix and Ratcliff, Position based dynamics (2007), algorithm 1.

use fem_model::IterationSettings;

use super::projection::{Constraints, Rule};
use super::relaxation::Relaxed;
use crate::forces::contact::planes::Planes;
use crate::forces::springs::Spring;
use crate::model::system::System;
use fem_solvers::Real;

/// PBD: each sweep brings the volume of every element (the area of a triangle) and the length of every edge nearer to that at rest. The
/// moduli of the material have no effect: the stiffness depends on the time step and the number of sweeps.
pub type Pbd<T> = Relaxed<T, Constraints<T>>;

/// PBD for the elements and edges of a body. A stiffness k in \[0, 1\] becomes 1 − (1 − k)^(1/n) in each of n sweeps: section 3.3.
pub fn pbd<T: Real>(settings: &IterationSettings, system: &System<T>, planes: Option<&Planes>) -> Pbd<T> {
    let stiffness = 1.0 - (1.0 - settings.stiffness).powf(1.0 / settings.count as f64);
    let constraints = Constraints::new(system, &edges(system), Rule::Volume { stiffness });
    Relaxed::new(constraints, settings, system, planes)
}

/// A spring at rest for each edge of the mesh.
fn edges<T: Real>(system: &System<T>) -> Vec<Spring<T>> {
    let pairs_of = |corners: &[usize]| -> Vec<[u32; 2]> {
        let corners: Vec<u32> = corners.iter().map(|&node| system.numbering.engine_node[node]).collect();
        let pair = |i: usize, j: usize| [corners[i].min(corners[j]), corners[i].max(corners[j])];
        (0..corners.len()).flat_map(|j| (0..j).map(move |i| (i, j))).map(|(i, j)| pair(i, j)).collect()
    };
    let mut pairs: Vec<_> = system.shape.mesh.corners().flat_map(pairs_of).collect();
    pairs.sort_unstable();
    pairs.dedup();
    pairs.into_iter().map(|nodes| Spring::at_rest(nodes, nodes.map(|node| system.rest[node as usize]))).collect()
}
