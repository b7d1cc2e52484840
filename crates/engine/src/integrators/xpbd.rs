//! XPBD, extended position-based dynamics: Macklin, Müller and Chentanez, XPBD: position-based simulation of compliant constrained
//! dynamics (2016), algorithm 1, for the material of the body.

use fem_scene::IterationSettings;
use fem_scene::simulation::{Cause, Counters, History};

use super::projection::{PlaneContacts, Rule, Sweeps};
use super::{Convergence, Integrator};
use crate::forces::contact::planes::Planes;
use crate::forces::springs::Spring;
use crate::model::state::State;
use crate::model::system::System;
use crate::number::Real;

/// XPBD: each sweep corrects every element and every spring once.
///
/// With the residual of the equation of motion, the stress of each element is an unknown, and sweeps converge to implicit Euler: the second
/// remedy (FP-PXPBD) of Chen, Han, Chen, Ma, Fedkiw and Teran, Primal residual reduction with extended position based dynamics and
/// hyperelasticity (2024). Without it each element has the one constraint C = √(2ψ) of the original method, whose sweeps converge
/// elsewhere wherever ∇C turns in the course of them.
pub struct Xpbd<T: Real>(Sweeps<T>);

impl<T: Real> Xpbd<T> {
    /// The constraints of a body.
    pub fn new(settings: &IterationSettings, system: &System<T>, planes: Option<&Planes>) -> Self {
        let springs: Vec<Spring<T>> = system.forces.all().flat_map(|(force, _)| force.springs()).copied().collect();
        let rule = if settings.residual { Rule::Stress } else { Rule::Energy };
        Self(Sweeps::new(system, &springs, planes, (settings.count, settings.tolerance), rule))
    }
}

impl<T: Real> Integrator<T> for Xpbd<T> {
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
