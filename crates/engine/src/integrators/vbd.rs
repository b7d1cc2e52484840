//! VBD, vertex block descent: Chen, Liu, Yang and Yuksel, Vertex block descent (2024), algorithm 1.

use fem_scene::IterationSettings;
use fem_scene::simulation::{Cause, Counters, History};

use super::descent::Descent;
use super::projection::PlaneContacts;
use super::{Convergence, Integrator};
use crate::forces::contact::planes::Planes;
use crate::model::state::State;
use crate::model::system::System;
use crate::number::Real;

/// VBD: each sweep moves every node to where the incremental potential of implicit Euler is least for it alone, by one step of Newton's
/// method. Sweeps converge to implicit Euler. Before that the forces between nodes are not equal and opposite, so that a step of few sweeps
/// does not conserve momentum.
pub struct Vbd<T: Real>(Descent<T>);

impl<T: Real> Vbd<T> {
    /// The nodes of a body.
    pub fn new(settings: &IterationSettings, system: &System<T>, planes: Option<&Planes>) -> Self {
        Self(Descent::new(settings, system, planes))
    }
}

impl<T: Real> Integrator<T> for Vbd<T> {
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
