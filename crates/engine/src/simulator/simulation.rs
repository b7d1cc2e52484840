//! What the window, the headless loop and the reports see.

use std::sync::Arc;
use std::sync::atomic::Ordering;

use nalgebra::{DVector, Matrix3, Vector3};

use super::build::{integrators, solver_choice};
use super::stepper::Stepper;
use super::{Simulator, parts, reactions};
use crate::forces::acting::Acting;
use crate::forces::pulls::{AnchorSpring, Pulls};
use crate::materials::{AnyLaw, cauchy_stress};
use crate::model::state::State;
use crate::number::Real;
use crate::pick;
use crate::tensor::from_fn;
use fem_scene::simulation::{
    Cause, Click, Counters, Energies, Failure, Parameter, Part, Pull, Reaction, Shape, Simulation,
};

impl<T: Real> Simulation for Simulator<T> {
    fn name(&self) -> &str {
        &self.system.name
    }

    fn shape(&self) -> Arc<Shape> {
        self.system.shape.clone()
    }

    fn positions(&self) -> DVector<f64> {
        let u = self.system.order.to_mesh(&self.state.u);
        let V = &self.system.shape.mesh.vertices;
        DVector::from_fn(3 * V.len(), |i, _| V[i / 3][i % 3] + u[i / 3][i % 3].as_f64())
    }

    fn velocities(&self) -> DVector<f64> {
        let v = self.system.order.to_mesh(&self.state.v);
        DVector::from_fn(3 * v.len(), |i, _| v[i / 3][i % 3].as_f64())
    }

    fn display_positions(&self) -> Vec<Vector3<f64>> {
        let nodes = self.nodes_now();
        match &self.skinning {
            Some(skinning) => {
                self.skinned_rows.fetch_add(skinning.rows(), Ordering::Relaxed);
                self.skinned.time(|| skinning.apply(&nodes))
            }
            None => nodes,
        }
    }

    fn time(&self) -> f64 {
        self.state.time
    }

    fn dt(&self) -> f64 {
        self.dt
    }

    fn step(&mut self) -> Result<(), Failure> {
        let Self { stepper, system, state, springs, dt, counters, last_good, pull, drag_stiffness, .. } = self;
        let pulls = Pulls { system, hand: pull.as_ref(), stiffness: *drag_stiffness };
        pulls.at(state.time + *dt, springs);
        last_good.copy_from(state);
        let outcome = stepper.step(&pulls, springs, state, *dt, counters).and_then(|()| self.check());
        if let Err(cause) = outcome {
            self.state.copy_from(&self.last_good);
            self.stepper.forget();
            return Err(self.failure(cause));
        }
        self.state.steps += 1;
        self.state.time = self.last_good.time + self.dt;
        self.counters.steps += 1;
        Ok(())
    }

    fn reset(&mut self) {
        self.state = crate::model::state::State::at_rest(self.system.nodes());
        self.last_good.copy_from(&self.state);
        self.stepper.forget();
    }

    fn energies(&self) -> Energies {
        let (system, State { u, v, steps, .. }) = (&self.system, &self.state);
        let springs = self.springs_now();
        let own = system.potential(u, Acting { pulls: &springs, load: None }).value;
        let of_loads = Acting { pulls: &[], load: system.dead_load.as_deref() }.potential(u).value;
        let part = self.stepper.load_fraction(*steps);
        let potential = own + part * (of_loads + system.pressure_potential(u));
        Energies { kinetic: system.mass.kinetic_energy(v), potential }
    }

    fn min_J(&self) -> (f64, usize) {
        let (J, element) = self.system.elements.min_det_F(&self.state.u);
        (J.as_f64(), element)
    }

    fn stresses(&self) -> Vec<Matrix3<f64>> {
        let (mesh, x) = (&self.system.shape.mesh, self.nodes_now());
        let Some(law) = AnyLaw::<f64>::new(&self.material) else { return Vec::new() };
        let stress = |(number, element): (usize, &[usize; 4])| {
            let edges = |of: &[Vector3<f64>]| {
                let [a, b, c, d] = element.map(|node| of[node]);
                Matrix3::from_columns(&[b - a, c - a, d - a])
            };
            let (rest, now) = (edges(&mesh.vertices), edges(&x));
            let G = (now - rest) * rest.try_inverse().unwrap_or_default();
            let stress = cauchy_stress(&law, &from_fn(|i, j| G[(i, j)]));
            let factor = self.system.stiffer.get(number).copied().unwrap_or(1.0);
            Matrix3::from_fn(|i, j| factor * stress[i][j])
        };
        mesh.elements.iter().enumerate().map(stress).collect()
    }

    fn integrator(&self) -> &'static str {
        self.integrator.name()
    }

    fn next_integrator(&mut self) -> &'static str {
        let all = integrators(self.method.integrator);
        self.integrator = self.integrator.next_in(all);
        let choice = solver_choice(&self.method, self.system.nodes());
        self.stepper = Stepper::new(&self.method, &self.system, self.integrator, choice);
        self.integrator.name()
    }

    fn parameters(&self) -> Vec<Parameter> {
        vec![Parameter::dt(self.dt, (1e-5, 0.1)), Parameter::drag(self.drag_stiffness)]
    }

    fn apply_parameter(&mut self, key: &'static str, value: f64) {
        match key {
            "dt" => self.dt = value,
            _ => self.drag_stiffness = value,
        }
        self.stepper.forget();
    }

    fn pick(&self, click: &Click) -> Vec<usize> {
        pick::nodes_under(click, &self.nodes_now(), &self.system.shape)
    }

    fn pull(&mut self, pull: Option<Pull>) {
        self.pull = pull;
    }

    fn display_vertices_outside(&self) -> usize {
        self.skinning.as_ref().map_or(0, |skinning| skinning.outside())
    }

    fn reactions(&self) -> Vec<Reaction> {
        if self.system.is_unheld() {
            return Vec::new();
        }
        self.reacted.time(|| reactions::reactions(self))
    }

    fn counters(&self) -> Counters {
        let solver = self.stepper.solver().map(|solver| solver.counters()).unwrap_or_default();
        Counters {
            symbolic_factorizations: solver.symbolic_factorizations,
            solver_iterations: solver.iterations,
            skinning_rows: self.skinned_rows.load(Ordering::Relaxed),
            ..self.counters
        }
    }

    fn parts(&self) -> Vec<Part> {
        parts::parts(self)
    }
}

impl<T: Real> Simulator<T> {
    /// Positions of the mesh's nodes, m.
    fn nodes_now(&self) -> Vec<Vector3<f64>> {
        let u = self.system.order.to_mesh(&self.state.u);
        let V = &self.system.shape.mesh.vertices;
        V.iter().zip(u).map(|(X, u)| X + Vector3::from(u.map(T::as_f64))).collect()
    }

    /// The pulls now.
    pub(super) fn springs_now(&self) -> Vec<AnchorSpring<T>> {
        let mut springs = Vec::new();
        let pulls = Pulls { system: &self.system, hand: self.pull.as_ref(), stiffness: self.drag_stiffness };
        pulls.at(self.state.time, &mut springs);
        springs
    }

    /// Whether the state that a step has led to can be handed on.
    fn check(&self) -> Result<(), Cause> {
        if let Some(node) = self.state.first_not_finite() {
            return Err(Cause::NotFinite { node: self.system.order.mesh_node[node] as usize });
        }
        if self.system.law.allows_inversion() {
            return Ok(());
        }
        Cause::inverted(self.min_J()).map_or(Ok(()), Err)
    }

    fn failure(&self, cause: Cause) -> Failure {
        Failure::of_step(self.state.steps, self.state.time, self.dt, self.integrator, cause)
    }
}
