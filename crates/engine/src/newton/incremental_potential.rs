//! The incremental potential: its minimum is a step of implicit Euler, or equilibrium.

pub use super::increment::{Increment, Inertia, StepEnd};

use crate::forces::Energy;
use crate::model::system::System;
use fem_elements::vector::{axpy, clear, dot, subtract_from, triple};
use fem_solvers::Real;

/// E(w) = ‖w − ŵ‖²_M / (2 τ²) + c (w − w̌)ᵀ C (w − w̌) / 2 + V(u₀ + w) + W(u₀ + s w) κ/s, C = α M + β K(u_d) + D(u_d), for the displacement
/// increment w: its minimum solves M (w − ŵ)/τ² + c C (w − w̌) = f(u₀ + w) + κ f_o(u₀ + s w). With τ = dt, c = 1/dt, w̌ = 0 and s = κ = 1
/// it is a step of implicit Euler; without the first two terms it is equilibrium.
///
/// V is the energy of the body and of its loads, W that of the obstacles. In a method of second order w is the increment up to a stage
/// within the step, and s w the one up to its end.
///
/// The unknown is the increment instead of the new displacement, so that velocities w/dt are exact in single precision.
#[derive(Clone, Copy)]
pub struct IncrementalPotential<'a, T: Real> {
    /// The body.
    pub system: &'a System<T>,
    /// The increment.
    pub increment: Increment<'a, T>,
    /// Gradient of the follower loads, kept fixed, N; empty where there are none.
    pub followers: &'a [[T; 3]],
}

/// Vectors for evaluations, kept from step to step.
#[derive(Clone, Debug, Default)]
pub struct Workspace<T> {
    pub(super) u: Vec<[T; 3]>,
    pub(super) difference: Vec<[T; 3]>,
    product: Vec<[T; 3]>,
    /// Displacements at the end of the step, m; empty until they are needed.
    pub(super) end: Vec<[T; 3]>,
    pub(super) last: LastEvaluation<T>,
}

/// Terms of the last evaluation of an incremental potential: after a step, those of its solution. The energy ledger takes their work.
#[derive(Clone, Debug, Default)]
pub struct LastEvaluation<T> {
    /// Reactions on the constrained degrees of freedom, N; empty without prescribed motions.
    pub reactions: Vec<[T; 3]>,
    /// Forces of damping against the motion, N; empty without.
    pub damping: Vec<[T; 3]>,
}

impl<T: Real> Workspace<T> {
    /// Allocates vectors for so many nodes.
    pub fn new(nodes: usize) -> Self {
        let zero = || vec![[T::default(); 3]; nodes];
        Self { u: zero(), difference: zero(), product: zero(), end: Vec::new(), last: LastEvaluation::default() }
    }

    pub(super) fn set_u(&mut self, start: &[[T; 3]], w: &[[T; 3]]) {
        self.u.copy_from_slice(start);
        axpy(1.0, w, &mut self.u);
    }

    /// Sets the displacements at the end of the step, u₀ + s w.
    pub(super) fn set_end(&mut self, start: &[[T; 3]], ratio: f64, w: &[[T; 3]]) {
        self.end.resize(start.len(), [T::default(); 3]);
        self.end.copy_from_slice(start);
        axpy(ratio, w, &mut self.end);
    }
}

impl<T: Real> IncrementalPotential<'_, T> {
    /// E(w), and its gradient with zero entries at constrained degrees of freedom, N.
    pub fn energy_and_gradient(&self, w: &[[T; 3]], gradient: &mut [[T; 3]], workspace: &mut Workspace<T>) -> Energy {
        let Increment { start, end, inertia } = self.increment;
        workspace.set_u(start, w);
        let potential = match self.end_with_obstacles() {
            None => self.system.potential_and_gradient(&workspace.u, end, gradient),
            Some(step_end) => {
                let own = self.system.own_potential_and_gradient(&workspace.u, end, gradient);
                own + self.add_obstacles(step_end, w, gradient, workspace)
            }
        };
        let of_followers = self.add_followers(&workspace.u, gradient);
        let kinetic = inertia.map_or(Energy::default(), |inertia| self.add_inertia(&inertia, w, gradient, workspace));
        if self.system.dirichlet.has_motion() {
            let reactions = &mut workspace.last.reactions;
            reactions.resize(gradient.len(), [T::default(); 3]);
            self.system.dirichlet.copy_constrained(gradient, reactions);
        }
        self.system.dirichlet.clear_constrained(gradient);
        potential + of_followers + kinetic
    }

    /// Minimum of det F over the elements whose law does not allow inversion.
    pub fn min_det_F(&self, w: &[[T; 3]], workspace: &mut Workspace<T>) -> f64 {
        workspace.set_u(self.increment.start, w);
        self.system.elements.min_det_F_of_barriers(&workspace.u).0.as_f64()
    }

    /// Magnitude of the terms that cancel within E(w), J.
    pub fn cancelled(&self, w: &[[T; 3]], workspace: &mut Workspace<T>) -> f64 {
        workspace.set_u(self.increment.start, w);
        self.system.elements.cancelled(&workspace.u)
    }

    /// The largest multiple of `direction` from w up to which every force stays feasible.
    pub fn largest_step(&self, w: &[[T; 3]], direction: &[[T; 3]], workspace: &mut Workspace<T>) -> f64 {
        let Some(StepEnd { moment, ratio, .. }) = self.end_with_obstacles() else {
            workspace.set_u(self.increment.start, w);
            return self.system.largest_step(&workspace.u, self.increment.end, direction);
        };
        workspace.set_end(self.increment.start, ratio, w);
        // A direction that is longer by a factor can be followed to a smaller multiple of it.
        self.system.largest_step(&workspace.end, moment, direction) / ratio
    }

    /// The end of the step, if it is not that of the increment and the body has obstacles.
    pub(super) fn end_with_obstacles(&self) -> Option<StepEnd> {
        self.increment.step_end().filter(|_| self.system.forces.has_obstacles())
    }

    /// Adds the gradient of W κ/s at the end of the step, and returns that energy.
    fn add_obstacles(
        &self,
        StepEnd { moment, ratio, weight }: StepEnd,
        w: &[[T; 3]],
        gradient: &mut [[T; 3]],
        workspace: &mut Workspace<T>,
    ) -> Energy {
        workspace.set_end(self.increment.start, ratio, w);
        let Workspace { end, product, .. } = workspace;
        let Energy { value, terms } = self.system.obstacle_energy_and_gradient(end, moment, product);
        axpy(weight, product, gradient);
        let factor = weight / ratio;
        Energy { value: factor * value, terms: factor * terms }
    }

    /// Adds the fixed gradient of the follower loads, and returns the energy g·u that it is the gradient of.
    fn add_followers(&self, u: &[[T; 3]], gradient: &mut [[T; 3]]) -> Energy {
        let mut energy = Energy::default();
        for ((sum, g), u) in gradient.iter_mut().zip(self.followers).zip(u) {
            let mut work = 0.0;
            for i in 0..3 {
                sum[i] += g[i];
                work += g[i].as_f64() * u[i].as_f64();
            }
            energy = energy + Energy::of(work);
        }
        energy
    }

    /// Adds the gradient of inertia and damping, and returns their energy.
    fn add_inertia(
        &self,
        inertia: &Inertia<T>,
        w: &[[T; 3]],
        gradient: &mut [[T; 3]],
        workspace: &mut Workspace<T>,
    ) -> Energy {
        let Workspace { difference, product, last, .. } = workspace;
        difference.copy_from_slice(inertia.inertial);
        subtract_from(w, difference);
        clear(product);
        self.system.add_mass_times(inertia.over_dt2, difference, product);
        let mut energy = Energy::of(add_and_multiply(difference, product, gradient));
        if let Some(rates) = inertia.damping {
            let moved = inertia.moved(w, difference);
            clear(product);
            let stiffness_at = inertia.stiffness_at.unwrap_or(self.increment.start);
            self.system.add_damping_times(rates, stiffness_at, moved, product);
            energy = energy + Energy::of(add_and_multiply(moved, product, gradient));
            last.damping.resize(product.len(), [T::default(); 3]);
            std::mem::swap(&mut last.damping, product);
        }
        energy
    }

    /// The gradient at the increment `prescribed` of E to second order about w = 0, with zero entries at constrained degrees of
    /// freedom, N. It needs neither an energy nor a matrix.
    pub fn linearized_gradient(&self, prescribed: &[[T; 3]], gradient: &mut [[T; 3]], workspace: &mut Workspace<T>) {
        let Self { system, increment: Increment { start, end, inertia }, .. } = *self;
        match self.end_with_obstacles() {
            None => system.gradient(start, end, gradient),
            Some(StepEnd { moment, weight, .. }) => {
                system.own_potential_and_gradient(start, end, gradient);
                system.obstacle_energy_and_gradient(start, moment, &mut workspace.product);
                axpy(weight, &workspace.product, gradient);
            }
        }
        self.add_followers(start, gradient);
        let mut stiffness = T::of(1.0);
        if let Some(inertia) = inertia {
            let increments = prescribed.iter().zip(inertia.inertial);
            for (difference, (prescribed, inertial)) in workspace.difference.iter_mut().zip(increments) {
                *difference = triple(|i| prescribed[i] - inertial[i]);
            }
            system.add_mass_times(inertia.over_dt2, &workspace.difference, gradient);
            if let Some(mut rates) = inertia.damping {
                if system.damps_by_stiffness() && !system.has_viscosity() {
                    stiffness += std::mem::take(&mut rates.stiffness);
                }
                if system.dirichlet.has_motion() {
                    let stiffness_at = inertia.stiffness_at.filter(|_| system.has_viscosity());
                    system.add_damping_times(rates, stiffness_at.unwrap_or(start), prescribed, gradient);
                }
            }
        }
        if system.dirichlet.has_motion() {
            let profile = &system.profile;
            profile.prescribed.time(|| {
                system.add_stiffness_times(stiffness, start, prescribed, gradient);
                system.add_external_hessian_times(start, end, prescribed, gradient);
            });
        }
        system.dirichlet.clear_constrained(gradient);
    }
}

/// sum += y; returns ½ x · y.
fn add_and_multiply<T: Real>(x: &[[T; 3]], y: &[[T; 3]], sum: &mut [[T; 3]]) -> f64 {
    axpy(1.0, y, sum);
    0.5 * dot(x, y)
}
