//! The interface to the window, the headless loop and the reports.

use std::sync::Arc;

use fem_model::Integrator;
use fem_model::simulation::{
    Cause, Checkpoint, Click, Counters, Energies, Failure, Interactive, Parameter, Part, Pull, Shape, Simulation,
    Undiagnosed,
};
use nalgebra::{DMatrix, DVector, Matrix3, Vector3};

use super::build::{INTEGRATORS, extent};
use super::constraints::stack;
use super::{AnchorSpring, AssignmentSetup, explain};
use crate::given::deformation_gradient;
use crate::{T_linear_tetrahedron, dphi_linear_tetrahedron_dX, dpsi_neo_hookean_dF, pick_nearest_vertices};

impl Simulation for AssignmentSetup {
    fn name(&self) -> &str {
        &self.name
    }

    fn shape(&self) -> Arc<Shape> {
        self.shape.clone()
    }

    fn positions(&self) -> DVector<f64> {
        self.constraints.all_coordinates(&self.q)
    }

    fn velocities(&self) -> DVector<f64> {
        self.constraints.all_velocities(&self.qdot)
    }

    fn display_positions(&self) -> Vec<Vector3<f64>> {
        let x = self.positions();
        let nodes = x.len() / 3;
        let Some(N) = &self.skinning else { return (0..nodes).map(|node| super::node(&x, node)).collect() };
        self.profile.count_skinning_rows(N.nrows());
        self.profile.skinning.time(|| {
            let skinned = N * DMatrix::from_fn(nodes, 3, |node, i| x[3 * node + i]);
            skinned.row_iter().map(|row| Vector3::new(row[0], row[1], row[2])).collect()
        })
    }

    fn time(&self) -> f64 {
        self.time
    }

    fn steps(&self) -> usize {
        self.steps_since_reset
    }

    fn dt(&self) -> f64 {
        self.dt
    }

    fn step(&mut self) -> Result<(), Failure> {
        self.profile.begin_step();
        let springs = self.springs(self.time + self.dt);
        let (mut q, mut qdot) = (self.q.clone(), self.qdot.clone());
        self.advance(&mut q, &mut qdot, &springs);
        let cause = self.cause_of_failure(&q, &qdot).or_else(|| self.stuck(&q, &qdot, &springs));
        if let Some(cause) = cause {
            return Err(self.failure(cause));
        }
        if self.has_missed_the_minimum(&q, &qdot, &springs) {
            self.profile.count_unconverged_step();
        }
        (self.q, self.qdot) = (q, qdot);
        self.time += self.dt;
        self.steps_since_reset += 1;
        self.profile.count_step();
        Ok(())
    }

    fn reset(&mut self) {
        self.q = self.constraints.free_coordinates(stack(self.shape.mesh.vertices()));
        self.qdot.fill(0.0);
        self.time = 0.0;
        self.steps_since_reset = 0;
    }

    fn checkpoint(&self) -> Checkpoint {
        Checkpoint {
            time: self.time,
            steps: self.steps_since_reset,
            positions: self.positions().as_slice().to_vec(),
            velocities: self.velocities().as_slice().to_vec(),
            ..Checkpoint::default()
        }
    }

    fn restore(&mut self, checkpoint: &Checkpoint) -> Result<(), String> {
        let coordinates = 3 * self.shape.mesh.vertices().len();
        for (name, list) in [("q", &checkpoint.positions), ("qdot", &checkpoint.velocities)] {
            if list.len() != coordinates {
                self.reset();
                return Err(format!("its `{name}` has {} numbers and not {coordinates}", list.len()));
            }
        }
        self.q = self.constraints.free_coordinates(DVector::from_column_slice(&checkpoint.positions));
        self.qdot = self.constraints.free_coordinates(DVector::from_column_slice(&checkpoint.velocities));
        (self.time, self.steps_since_reset) = (checkpoint.time, checkpoint.steps);
        Ok(())
    }

    fn energies(&self) -> Energies {
        let v = self.velocities();
        let elements = self.shape.mesh.tetrahedra().iter().zip(&self.v0);
        Energies {
            kinetic: elements.map(|(element, &v0)| T_linear_tetrahedron(&v, element, self.density, v0)).sum(),
            potential: self.potential(&self.q, &self.springs(self.time)),
        }
    }

    fn min_J(&self) -> (f64, usize) {
        self.min_J_at(&self.positions())
    }

    fn stresses(&self) -> Vec<Matrix3<f64>> {
        let x = self.positions();
        let stress = |element: &[usize; 4]| {
            let F = self.deformation_gradient(&x, element);
            let P = Matrix3::from_row_slice(dpsi_neo_hookean_dF(&F, self.C, self.D).as_slice());
            P * F.transpose() / F.determinant()
        };
        self.shape.mesh.tetrahedra().iter().map(stress).collect()
    }

    fn integrator(&self) -> &'static str {
        self.integrator.name()
    }

    fn display_vertices_outside(&self) -> usize {
        let is_outside = |weights: &[f64]| weights.iter().any(|&weight| weight < -1e-6);
        self.skinning.as_ref().map_or(0, |N| N.row_iter().filter(|row| is_outside(row.values())).count())
    }

    fn nodal_forces(&self) -> Option<DVector<f64>> {
        Some(self.force_on_nodes(&self.positions(), &self.springs(self.time)))
    }

    fn counters(&self) -> Counters {
        let solver = self.solver.borrow();
        Counters {
            factorizations: solver.factorizations,
            symbolic_factorizations: solver.symbolic_factorizations,
            ..self.profile.counters()
        }
    }

    fn parts(&self) -> Vec<Part> {
        explain::parts(self)
    }
}

impl Interactive for AssignmentSetup {
    fn next_integrator(&mut self) -> &'static str {
        self.integrator = self.integrator.next_in(&INTEGRATORS);
        self.integrator.name()
    }

    fn parameters(&self) -> Vec<Parameter> {
        let parameter =
            |key, label, unit, value, range, logarithmic| Parameter { key, label, unit, value, range, logarithmic };
        let mut parameters = vec![
            Parameter::dt(self.dt, (1e-4, 0.1)),
            parameter("C", "stiffness C", "Pa", self.C, (1e2, 1e9), true),
            parameter("D", "stiffness D", "Pa", self.D, (1e2, 1e9), true),
            parameter("density", "density", "kg/m³", self.density, (1.0, 2e4), true),
        ];
        if let Some((_, size)) = self.gravity {
            parameters.push(parameter("gravity", "gravity", "m/s²", size, (0.0, 30.0), false));
        }
        parameters.push(Parameter::drag(self.interaction.stiffness));
        parameters
    }

    fn apply_parameter(&mut self, key: &'static str, value: f64) {
        match key {
            "dt" => self.dt = value,
            "C" => self.C = value,
            "D" => self.D = value,
            "density" => self.density = value,
            "gravity" => self.gravity = self.gravity.map(|(direction, _)| (direction, value)),
            _ => self.interaction.stiffness = value,
        }
        self.weigh();
    }

    fn pick(&self, click: &Click) -> Vec<usize> {
        let x = self.positions();
        let V: Vec<_> = (0..x.len() / 3).map(|node| super::node(&x, node)).collect();
        let (F, radius) = (&self.shape.boundary, self.shape.pick_radius(&V));
        pick_nearest_vertices(&click.win, &click.view, &click.proj, &click.viewport, &V, F, radius)
    }

    fn pull(&mut self, pull: Option<Pull>) {
        self.interaction.set_pull(pull);
    }
}

impl Undiagnosed for AssignmentSetup {}

impl AssignmentSetup {
    fn deformation_gradient(&self, x: &DVector<f64>, element: &[usize; 4]) -> Matrix3<f64> {
        let V = self.shape.mesh.vertices();
        deformation_gradient(x, element, &dphi_linear_tetrahedron_dX(V, element, &V[element[0]]))
    }

    /// The minimum of J = det F over all elements, and its element.
    fn min_J_at(&self, x: &DVector<f64>) -> (f64, usize) {
        let determinants =
            self.shape.mesh.tetrahedra().iter().map(|element| self.deformation_gradient(x, element).determinant());
        determinants.enumerate().fold((f64::INFINITY, 0), |least, (i, J)| if J < least.0 { (J, i) } else { least })
    }

    fn cause_of_failure(&self, q: &DVector<f64>, qdot: &DVector<f64>) -> Option<Cause> {
        let (x, v) = (self.constraints.all_coordinates(q), self.constraints.all_velocities(qdot));
        if let Some(i) = (0..x.len()).find(|&i| !(x[i].is_finite() && v[i].is_finite())) {
            return Some(Cause::NotFinite { node: i / 3 });
        }
        Cause::inverted(self.min_J_at(&x))
    }

    /// [`Cause::Stuck`] if implicit Euler has accepted no direction, though the forces are not in balance.
    ///
    /// A body at rest accepts no direction either, but its residual is round-off of the external forces.
    fn stuck(&self, q: &DVector<f64>, qdot: &DVector<f64>, springs: &[AnchorSpring]) -> Option<Cause> {
        let has_moved = *qdot != self.qdot && qdot.iter().any(|&v| v != 0.0);
        if self.integrator != Integrator::ImplicitEuler || has_moved || qdot.is_empty() {
            return None;
        }
        let elastic = (self.C + self.D) * extent(self.shape.mesh.vertices()).powi(2);
        let (unbalanced, external) = self.unbalanced(q, qdot, springs);
        (unbalanced > 1e-6 * (external + elastic)).then_some(Cause::Stuck { unbalanced })
    }

    /// Returns true if a step of implicit Euler without the springs in its stiffness has ended with more than a thousandth of the external
    /// forces out of balance: the five Newton iterations of the course have not reached the minimum of its energy.
    fn has_missed_the_minimum(&self, q: &DVector<f64>, qdot: &DVector<f64>, springs: &[AnchorSpring]) -> bool {
        let is_explicit_in_springs = !self.has_springs_in_stiffness && !springs.is_empty();
        if self.integrator != Integrator::ImplicitEuler || !is_explicit_in_springs {
            return false;
        }
        let (unbalanced, external) = self.unbalanced(q, qdot, springs);
        unbalanced > 1e-3 * external
    }

    /// The largest entry of M (v⁺ − v)/Δt − f(q⁺) at the end of a step from the present state, and of the external forces and inertia in
    /// it, N.
    fn unbalanced(&self, q: &DVector<f64>, qdot: &DVector<f64>, springs: &[AnchorSpring]) -> (f64, f64) {
        let x = self.constraints.all_coordinates(q);
        let stiffness = self.interaction.stiffness;
        let of_springs = springs.iter().map(|spring| stiffness * (super::node(&x, spring.node) - spring.target).amax());
        let inertia = &self.M * &self.qdot / self.dt;
        let external =
            self.weight.iter().chain(&inertia).map(|force| force.abs()).chain(of_springs).fold(0.0, f64::max);
        let f = self.constraints.free_coordinates(self.force_on_nodes(&x, springs));
        ((&self.M * (qdot - &self.qdot) / self.dt - f).amax(), external)
    }

    fn failure(&self, cause: Cause) -> Failure {
        Failure::of_step(self.steps_since_reset, self.time, self.dt, self.integrator, cause)
    }
}
