//! PBD, position-based dynamics: Müller, Heidelberger, Hennix and Ratcliff, Position based dynamics (2007), algorithm 1.

use fem_scene::IterationSettings;
use fem_scene::simulation::{Cause, Counters, History};

use super::projection::{PlaneContacts, Rule, Sweeps};
use super::{Convergence, Integrator};
use crate::forces::contact::planes::Planes;
use crate::forces::springs::Spring;
use crate::model::state::State;
use crate::model::system::System;
use crate::number::Real;

/// PBD: each sweep brings the volume of every element (the area of a triangle) and the length of every edge nearer to that at rest. The
/// moduli of the material play no part: the stiffness comes from the time step and the number of sweeps.
pub struct Pbd<T: Real>(Sweeps<T>);

impl<T: Real> Pbd<T> {
    /// The constraints of a body. A stiffness k in \[0, 1\] becomes 1 − (1 − k)^(1/n) in each of n sweeps: section 3.3.
    pub fn new(settings: &IterationSettings, system: &System<T>, planes: Option<&Planes>) -> Self {
        let stiffness = 1.0 - (1.0 - settings.stiffness).powf(1.0 / settings.count as f64);
        let edges = edges(system);
        Self(Sweeps::new(system, &edges, planes, (settings.count, settings.tolerance), Rule::Volume { stiffness }))
    }
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

impl<T: Real> Integrator<T> for Pbd<T> {
    fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        self.0.step(system, state, dt, counters);
        Ok(Convergence::Converged)
    }

    fn forget(&mut self) {
        self.0.forget();
    }

    fn save(&self, history: &mut History) {
        self.0.save(history);
    }

    fn restore(&mut self, history: &History) -> Result<(), String> {
        self.0.restore(history)
    }

    fn is_unconditionally_stable(&self) -> bool {
        true
    }

    fn plane_contacts(&self) -> Option<&PlaneContacts> {
        self.0.contacts()
    }

    fn constraint_bytes(&self) -> usize {
        self.0.bytes()
    }
}
