//! The traits [`Simulation`], [`Interactive`] and [`Diagnostics`] for the engine.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use fem_model::Integrator as IntegratorKind;
use fem_model::simulation::{
    Checkpoint, Click, Counters, Diagnostics, Energies, EnergyLedger, Failure, Interactive, Parameter, Part, Plane,
    PlaneContact, PlasticFlow, Pull, Reaction, Shape, Simulation,
};
use nalgebra::{DVector, Matrix3, Vector3};

use super::substep::is_judged;
use super::{Compiled, Simulator, checkpoint, parts};
use crate::boundary::rigid_modes;
use crate::integrators::LastStage;
use crate::model::reactions::{reactions, reactions_at};
use crate::model::state::State;
use crate::pick;
use fem_solvers::Real;

impl<T: Compiled> Simulation for Simulator<T> {
    fn name(&self) -> &str {
        &self.system.name
    }

    fn shape(&self) -> Arc<Shape> {
        self.system.shape.clone()
    }

    fn positions(&self) -> DVector<f64> {
        let u = self.system.numbering.to_mesh(&self.state.u);
        let V = self.system.shape.mesh.vertices();
        DVector::from_fn(3 * V.len(), |i, _| V[i / 3][i % 3] + u[i / 3][i % 3].as_f64())
    }

    fn velocities(&self) -> DVector<f64> {
        let v = self.system.numbering.to_mesh(&self.state.v);
        DVector::from_fn(3 * v.len(), |i, _| v[i / 3][i % 3].as_f64())
    }

    fn display_positions(&self) -> Vec<Vector3<f64>> {
        let nodes = self.nodes_now();
        match &self.skinning {
            Some(skinning) => {
                self.skinned_rows.fetch_add(skinning.rows(), Ordering::Relaxed);
                self.skinning_timer.time(|| skinning.apply(&nodes))
            }
            None => nodes,
        }
    }

    fn time(&self) -> f64 {
        self.state.time
    }

    fn steps(&self) -> usize {
        self.state.steps
    }

    fn dt(&self) -> f64 {
        self.dt
    }

    fn step(&mut self) -> Result<(), Failure> {
        T::step(self)
    }

    fn reset(&mut self) {
        self.system.apply_conditions_at(0.0);
        if let Some(plasticity) = self.system.elements.plasticity_mut() {
            plasticity.clear();
        }
        self.state = State::at_start(self.system.nodes(), &self.initial_velocity);
        self.last_good.copy_from(&self.state);
        self.forget();
    }

    fn checkpoint(&self) -> Checkpoint {
        checkpoint::of(self)
    }

    fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), String> {
        let outcome = checkpoint::restore(self, checkpoint);
        if outcome.is_err() {
            self.reset();
        }
        outcome
    }

    fn energies(&self) -> Energies {
        T::energies(self)
    }

    fn min_J(&self) -> (f64, usize) {
        T::min_J(self)
    }

    fn stresses(&self) -> Vec<Matrix3<f64>> {
        T::stresses(self)
    }

    fn integrator(&self) -> &'static str {
        self.kind.name()
    }

    fn display_vertices_outside(&self) -> usize {
        self.skinning.as_ref().map_or(0, |skinning| skinning.outside())
    }

    fn nodal_forces(&self) -> Option<DVector<f64>> {
        Some(stacked(&T::nodal_forces(self)))
    }

    fn counters(&self) -> Counters {
        let solver = self.integrator.solver().map(|solver| solver.counters()).unwrap_or_default();
        Counters {
            symbolic_factorizations: solver.symbolic_factorizations,
            solver_iterations: solver.iterations,
            solver_fallbacks: solver.fallbacks,
            skinning_rows: self.skinned_rows.load(Ordering::Relaxed),
            ..self.counters
        }
    }

    fn parts(&self) -> Vec<Part> {
        parts::parts(self)
    }
}

impl<T: Compiled> Interactive for Simulator<T> {
    fn next_integrator(&mut self) -> &'static str {
        T::next_integrator(self);
        self.kind.name()
    }

    fn parameters(&self) -> Vec<Parameter> {
        let mut parameters = vec![Parameter::dt(self.dt, (1e-5, 0.1))];
        if self.kind != IntegratorKind::Static {
            parameters.push(Parameter::substeps(self.substeps));
        }
        parameters.push(Parameter::drag(self.system.forces.drag.interaction.stiffness));
        parameters
    }

    fn apply_parameter(&mut self, key: &'static str, value: f64) {
        match key {
            "dt" => self.dt = value,
            "substeps" => self.substeps = value.round() as usize,
            _ => self.system.forces.drag.interaction.stiffness = value,
        }
        self.substep_dt = self.dt / self.substeps as f64;
        self.forget();
    }

    fn pick(&self, click: &Click) -> Vec<usize> {
        pick::nodes_under(click, &self.nodes_now(), &self.system.shape)
    }

    fn pull(&mut self, pull: Option<Pull>) {
        self.system.forces.drag.interaction.set_pull(pull);
        self.integrator.forget_forces();
        self.last_forces.forget();
    }
}

impl<T: Compiled> Diagnostics for Simulator<T> {
    fn substeps(&self) -> usize {
        self.substeps
    }

    fn energy_ledger(&self) -> Option<EnergyLedger> {
        is_judged(self.kind).then(|| T::energy_ledger(self))
    }

    fn failure_at_end(&self) -> Option<Failure> {
        T::failure_at_end(self)
    }

    fn estimated_error(&self) -> Option<f64> {
        self.control.as_ref().filter(|_| self.is_adaptive()).map(|control| control.error)
    }

    fn load_factor(&self) -> Option<f64> {
        self.integrator.moment(&self.state).load_factor
    }

    fn inverted_elements(&self) -> usize {
        T::inverted_elements(self)
    }

    fn critical_time_step(&self) -> Option<f64> {
        T::critical_time_step(self)
    }

    fn has_stress(&self) -> bool {
        self.system.elements.count() > 0
    }

    fn stresses_at_points(&self) -> Vec<Matrix3<f64>> {
        T::stresses_at_points(self)
    }

    fn material_of_elements(&self) -> Vec<usize> {
        self.system.elements.material_of_elements()
    }

    fn moduli_of_elements(&self) -> Vec<[f64; 2]> {
        self.system.elements.moduli_of_elements()
    }

    fn plastic_flow(&self) -> Option<PlasticFlow> {
        let plasticity = self.system.elements.plasticity()?;
        Some(PlasticFlow { strains: self.system.elements.plastic_strains()?, dissipated: plasticity.dissipated() })
    }

    fn reactions(&self) -> Vec<Reaction> {
        T::reactions(self)
    }

    fn contacts(&self) -> Vec<PlaneContact> {
        self.contacts_now()
    }

    fn notes(&self) -> Vec<String> {
        let stabilized = self.system.modulus_of_free_body.map(|_| rigid_modes::STABILIZED.to_owned());
        self.contact.iter().flat_map(|contact| contact.notes()).chain(stabilized).collect()
    }

    fn warnings(&self) -> Vec<String> {
        self.contact.iter().filter_map(|contact| contact.warning()).chain(self.hidden_inversion()).collect()
    }

    fn planes(&self) -> Vec<Plane> {
        self.planes_now()
    }

    fn weight(&self) -> Option<f64> {
        self.weight
    }

    fn contact_forces(&self) -> Option<DVector<f64>> {
        Some(stacked(&self.contact_forces_now()?))
    }

    fn lag_residual(&self) -> Option<f64> {
        self.lag_residual_now()
    }
}

impl<T: Real> Simulator<T> {
    pub(super) fn energies_now(&self) -> Energies {
        let Self { system, state, integrator, .. } = self;
        let potential = system.reported_potential(&state.u, integrator.moment(state));
        Energies { kinetic: system.mass.kinetic_energy(&state.v), potential }
    }

    pub(super) fn reactions_now(&self) -> Vec<Reaction> {
        let Self { system, state, last_good, integrator, .. } = self;
        if system.is_unconstrained() {
            return Vec::new();
        }
        self.reactions_timer.time(|| match integrator.last_stage() {
            Some(LastStage { part, acceleration }) => reactions_at(system, last_good, state, (part, acceleration)),
            None => reactions(system, last_good, state, integrator.moment(state)),
        })
    }

    pub(super) fn nodal_forces_now(&self) -> Vec<[f64; 3]> {
        let Self { system, state, last_good, integrator, .. } = self;
        let (mut force, mut damping_at) = (vec![[T::default(); 3]; system.nodes()], Vec::new());
        system.damping_displacements(last_good, state.time - last_good.time, &mut damping_at);
        system.force(&state.u, &state.v, &damping_at, integrator.moment(state), &mut force);
        system.numbering.to_mesh(&force).iter().map(|force| force.map(T::as_f64)).collect()
    }

    /// Positions of the mesh's nodes, m.
    fn nodes_now(&self) -> Vec<Vector3<f64>> {
        let u = self.system.numbering.to_mesh(&self.state.u);
        let V = self.system.shape.mesh.vertices();
        V.iter().zip(u).map(|(X, u)| X + Vector3::from(u.map(T::as_f64))).collect()
    }
}

/// The vectors of all nodes in one.
fn stacked(vectors: &[[f64; 3]]) -> DVector<f64> {
    DVector::from_column_slice(vectors.as_flattened())
}
