//! A body in the engine's form: the undeformed body, its material, its constraints and the forces on it. These are constant in
//! a run, apart from a user's interaction, the release of nodes and the internal variables of plastic elements.

use std::sync::Arc;

use fem_elements::solids::Solids;
use fem_model::element::shares::{lumped_mass_shares, mass_shares};
use fem_model::simulation::Shape;
use fem_model::{Body, Damping, Interaction, with_elements};
use nalgebra::{Matrix3, Vector3};

use super::mass::{Mass, element_masses};
use crate::boundary::dirichlet::{DirichletConditions, fully_constrained_nodes};
use crate::forces::drag::{self, DragSprings};
use crate::forces::{Energy, Forces, HessianKind, Moment, Potential, mass_spring};
use crate::profile::Profile;
use fem_elements::materials::AnyLaw;
use fem_elements::sparse::{Block, Pattern};
use fem_elements::vector::triple;
use fem_solvers::Real;
use fem_solvers::numbering::{Numbering, Ordering};

/// A body in the engine's numbering: free nodes first, fully constrained ones last.
pub struct System<T: Real> {
    /// Name of the scene.
    pub name: String,
    /// Undeformed meshes, in their own numbering.
    pub shape: Arc<Shape>,
    /// The engine's numbers of the nodes.
    pub numbering: Numbering,
    /// Undeformed positions in the engine's numbering, m.
    pub rest: Vec<Vector3<f64>>,
    /// Undeformed elastic elements and their materials; none in a mass-spring body.
    pub elements: Box<dyn Solids<T>>,
    /// Sparsity of the stiffness matrix, whose rows are the nodes that are not fully constrained; without rows if the method needs no
    /// matrix, until [`prepare_matrix`](Self::prepare_matrix).
    pub pattern: Arc<Pattern>,
    /// Mass of all nodes.
    pub mass: Mass<T>,
    /// Row sums of the mass, kg; empty where a node is constrained.
    pub node_masses: Vec<T>,
    /// Mass of the body, kg.
    pub total_mass: f64,
    /// Dirichlet conditions.
    pub dirichlet: DirichletConditions,
    /// Forces beside the body's own elasticity.
    pub forces: Forces<T>,
    /// Mean force of the obstacles on each node in the last step of an explicit method, N; empty without.
    pub contact_force: Vec<[T; 3]>,
    /// Effective shear modulus of the springs of a mass-spring body, Pa; zero for a body of elastic elements.
    pub spring_modulus: f64,
    /// Shear modulus of a body that can move as a rigid body, which `static` has to stabilize, Pa; `None` for others.
    pub modulus_of_free_body: Option<f64>,
    /// Damping, where the scene asks for some.
    pub damping: Option<Damping>,
    /// Length of the undeformed body, m: `BodyMesh::length`.
    pub length: f64,
    /// Calls and time of its parts so far.
    pub profile: Profile,
}

/// Forces of a user's own, given the engine's numbers of the nodes.
pub type OwnForces<'a, T> = &'a dyn Fn(&Numbering) -> Vec<Box<dyn Potential<T>>>;

/// Internal forces do not depend on the time.
pub(super) const INTERNAL: Moment = Moment { time: 0.0, load_factor: None };

impl<T: Real> System<T> {
    /// Builds the parts that the scene names, without a matrix.
    pub(super) fn of_body(body: &Body, law: Option<AnyLaw<T::Single>>, ordering: Ordering, own: OwnForces<T>) -> Self {
        with_elements!(&body.shape.mesh, elements => Self::of_elements(elements, body, law, ordering, own))
    }

    fn of_elements<const N: usize>(
        elements: &[[usize; N]],
        body: &Body,
        law: Option<AnyLaw<T::Single>>,
        ordering: Ordering,
        own: OwnForces<T>,
    ) -> Self {
        let mesh = &body.shape.mesh;
        let fully_constrained = fully_constrained_nodes(body);
        let numbering = Numbering::new(ordering, mesh.vertices(), elements, &fully_constrained);
        let corners = numbering.elements(elements);
        let rest: Vec<_> = numbering.mesh_node.iter().map(|&node| mesh.vertices()[node as usize]).collect();
        let own = own(&numbering);
        let (name, shape) = (body.name.clone(), Arc::new(body.shape.clone()));
        let drag =
            DragSprings::new(Interaction::new(body.drag, drag::pull_modulus(body) * mesh.length()), &shape, &numbering);
        let forces = Forces::new(body, drag, &numbering, own);
        let masses = element_masses(body);
        let mass = match body.lumped_mass {
            true => Mass::lumped(rest.len(), &corners, &masses, &lumped_mass_shares(mesh.element())),
            false => Mass::consistent(rest.len(), &corners, &masses, &mass_shares(mesh.element())),
        };
        let dirichlet = DirichletConditions::new(body, &numbering);
        Self {
            elements: T::solids(body, law, &rest, &numbering.engine_node),
            length: mesh.length(),
            total_mass: masses.iter().sum(),
            node_masses: if dirichlet.is_empty() { mass.row_sums() } else { Vec::new() },
            name,
            modulus_of_free_body: None,
            spring_modulus: mass_spring::shear_modulus(body),
            damping: body.damping,
            shape,
            pattern: Arc::new(Pattern::none()),
            dirichlet,
            numbering,
            rest,
            mass,
            forces,
            contact_force: Vec::new(),
            profile: Profile::default(),
        }
    }

    /// Updates the Dirichlet conditions that apply at a time, s. Returns whether they have changed.
    pub fn apply_conditions_at(&mut self, time: f64) -> bool {
        let has_changed = self.dirichlet.apply_at(time, self.rest.len());
        if has_changed {
            self.node_masses = if self.is_unconstrained() { self.mass.row_sums() } else { Vec::new() };
        }
        has_changed
    }

    /// Number of nodes.
    pub fn nodes(&self) -> usize {
        self.rest.len()
    }

    /// Number of nodes that are not fully constrained.
    pub fn free(&self) -> usize {
        self.numbering.free
    }

    /// Returns true if no Dirichlet condition applies now.
    pub fn is_unconstrained(&self) -> bool {
        self.dirichlet.is_empty()
    }

    /// Returns true if one linear solve may find equilibrium: elements are linear, and no force is known to be none of that.
    pub fn may_be_linear(&self) -> bool {
        self.elements.is_linear() && self.forces.active().all(|(potential, _)| potential.may_be_quadratic())
    }

    /// Potential energy: that of the elements and of all conservative forces, zero in the undeformed body.
    pub fn potential(&self, u: &[[T; 3]], moment: Moment) -> Energy {
        let elastic = self.elements.energy(u);
        Energy::of(elastic) + self.energy_of_forces(u, moment)
    }

    /// Potential energy and its gradient (N) in one pass over the elements.
    pub fn potential_and_gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) -> Energy {
        gradient.fill([T::default(); 3]);
        let elastic = self.profile.energies.time(|| self.elements.add_energy_and_gradient(u, gradient));
        self.add_gradient_of_forces(u, moment, gradient);
        Energy::of(elastic) + self.energy_of_forces(u, moment)
    }

    /// Gradient of [`potential`](Self::potential), N: minus the conservative forces on the nodes.
    pub fn gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) {
        self.elastic_gradient(u, gradient);
        self.add_gradient_of_forces(u, moment, gradient);
    }

    /// All forces on the nodes, N: elastic, external, follower, contact and damping forces. Damping takes its stiffness at `u_damping`.
    pub fn force(&self, u: &[[T; 3]], v: &[[T; 3]], u_damping: &[[T; 3]], moment: Moment, force: &mut [[T; 3]]) {
        self.undamped_force(u, moment, force);
        self.add_damping_force(u_damping, v, force);
    }

    /// The same without damping forces, N.
    pub fn undamped_force(&self, u: &[[T; 3]], moment: Moment, force: &mut [[T; 3]]) {
        self.elastic_gradient(u, force);
        self.add_gradient_of_forces(u, moment, force);
        self.add_follower_gradient(u, moment, force);
        for force in force.as_flattened_mut() {
            *force = -*force;
        }
        for (force, contact) in force.iter_mut().zip(&self.contact_force) {
            *force = triple(|i| force[i] + contact[i]);
        }
    }

    /// Adds minus the forces of follower loads on the deformed surface, N.
    pub fn add_follower_gradient(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) {
        for (potential, timer) in self.forces.active() {
            if let Some(follower) = potential.follower() {
                timer.time(|| follower.add_follower_gradient(u, moment, gradient));
            }
        }
    }

    /// Adds `factor` K(u), the Hessian of the body's own energy: elements and springs between its nodes, N/m.
    pub fn add_stiffness(&self, factor: T, u: &[[T; 3]], kind: HessianKind, values: &mut [Block<T, 3>]) {
        self.add_stiffness_of_elements(factor, u, kind, values);
        self.add_internal_hessian(factor, u, kind, values);
    }

    /// Adds `factor` times the Hessian of the elements' energy, N/m.
    pub fn add_stiffness_of_elements(&self, factor: T, u: &[[T; 3]], kind: HessianKind, values: &mut [Block<T, 3>]) {
        let Self { profile, elements, .. } = self;
        match kind {
            HessianKind::Exact => profile.stiffness.time(|| elements.add_stiffness(factor, u, values)),
            HessianKind::Projected => profile.projection.time(|| elements.add_projected_stiffness(factor, u, values)),
        }
    }

    /// Adds `factor` times the Hessian of the springs between the body's nodes, N/m.
    pub fn add_internal_hessian(&self, factor: T, u: &[[T; 3]], kind: HessianKind, values: &mut [Block<T, 3>]) {
        self.add_hessians_of(|force| force.is_internal(), factor, (u, INTERNAL), kind, values);
    }

    /// Adds the Hessian of the external forces, N/m.
    pub fn add_external_hessian(&self, u: &[[T; 3]], moment: Moment, kind: HessianKind, values: &mut [Block<T, 3>]) {
        self.add_hessians_of(|force| !force.is_internal(), T::one(), (u, moment), kind, values);
    }

    /// Adds `factor` times the Hessian of some forces at displacements and a moment, N/m.
    pub fn add_hessians_of(
        &self,
        is_meant: impl Fn(&dyn Potential<T>) -> bool,
        factor: T,
        (u, moment): (&[[T; 3]], Moment),
        kind: HessianKind,
        values: &mut [Block<T, 3>],
    ) {
        for (potential, timer) in self.forces.active().filter(|(potential, _)| is_meant(*potential)) {
            timer.time(|| potential.add_hessian(factor, u, moment, kind, &self.pattern, values));
        }
    }

    /// Adds `factor` K(u) d without a matrix, N.
    pub fn add_stiffness_times(&self, factor: T, u: &[[T; 3]], d: &[[T; 3]], product: &mut [[T; 3]]) {
        self.elements.add_stiffness_times(factor, u, d, product);
        self.add_internal_hessian_times(factor, u, d, product);
    }

    /// Adds the Hessian of the external forces times d without a matrix, N.
    pub fn add_external_hessian_times(&self, u: &[[T; 3]], moment: Moment, d: &[[T; 3]], product: &mut [[T; 3]]) {
        for (potential, _) in self.forces.active().filter(|(potential, _)| !potential.is_internal()) {
            potential.add_hessian_times(T::one(), u, moment, d, product);
        }
    }

    /// Adds `factor` M x.
    pub fn add_mass_times(&self, factor: T, x: &[[T; 3]], product: &mut [[T; 3]]) {
        self.profile.mass.time(|| self.mass.add_times(factor, x, product));
    }

    /// Overwrites the constrained entries of an increment, m, with the difference from `start` to the prescribed displacements at a moment.
    /// Free entries stay.
    pub fn prescribe(&self, start: &[[T; 3]], moment: Moment, step: &mut [[T; 3]]) {
        if self.dirichlet.has_motion() {
            self.profile.prescribed.time(|| self.dirichlet.prescribe(&self.rest, moment, start, step));
        } else {
            self.dirichlet.clear_constrained(step);
        }
    }

    /// Energy for reports: that of the elements and of all forces that have a potential, follower loads included, J.
    pub fn reported_potential(&self, u: &[[T; 3]], moment: Moment) -> f64 {
        let elastic = self.elements.energy(u);
        let potentials = self.forces.active().filter(|(potential, _)| !potential.is_dissipative());
        let energies = potentials.map(|(potential, _)| {
            let of_follower = potential.follower().map_or(0.0, |follower| follower.reported_energy(u, moment));
            potential.energy(u, moment).value + of_follower
        });
        // A body that touches an obstacle at the start has no energy of contact yet.
        elastic + energies.filter(|energy| *energy != f64::INFINITY).sum::<f64>()
    }

    /// Cauchy stress of each element of the mesh, Pa: the mean of its quadrature points.
    pub fn stresses(&self, u: &[[T; 3]], moment: Moment) -> Vec<Matrix3<f64>> {
        let mean = |points: &[Matrix3<f64>]| points.iter().sum::<Matrix3<f64>>() / points.len() as f64;
        self.stresses_at_points(u, moment).chunks_exact(self.elements.points_per_element()).map(mean).collect()
    }

    /// Cauchy stress at each quadrature point, Pa: those of the mesh's first element, then those of the next.
    pub fn stresses_at_points(&self, u: &[[T; 3]], moment: Moment) -> Vec<Matrix3<f64>> {
        let mut stresses = self.elements.cauchy_stresses_at_points(u);
        for force in self.forces.all().filter_map(|(force, _)| force.in_elements()) {
            force.add_stresses(u, moment, &mut stresses);
        }
        stresses
    }

    /// Changes the increment of a step, an initial guess, where a force would be infeasible, m. Constrained entries stay.
    pub fn make_feasible(&self, start: &[[T; 3]], moment: Moment, increment: &mut [[T; 3]]) {
        let barriers = self.forces.active().filter_map(|(force, _)| force.barrier());
        if barriers.fold(false, |changed, barrier| changed | barrier.make_feasible(start, moment, increment)) {
            self.prescribe(start, moment, increment);
        }
    }

    fn elastic_gradient(&self, u: &[[T; 3]], gradient: &mut [[T; 3]]) {
        gradient.fill([T::default(); 3]);
        self.profile.forces.time(|| self.elements.add_gradient(u, gradient));
    }

    /// Energy of the forces beside the body's own elasticity.
    pub fn energy_of_forces(&self, u: &[[T; 3]], moment: Moment) -> Energy {
        self.forces.active().map(|(potential, _)| potential.energy(u, moment)).sum()
    }

    /// Adds the gradient of the energies of the forces beside the body's own elasticity, N.
    pub fn add_gradient_of_forces(&self, u: &[[T; 3]], moment: Moment, gradient: &mut [[T; 3]]) {
        for (potential, timer) in self.forces.active() {
            timer.time(|| potential.add_gradient(u, moment, gradient));
        }
    }
}
