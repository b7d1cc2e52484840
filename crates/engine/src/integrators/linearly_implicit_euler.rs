//! Linearly implicit Euler: one Newton step of implicit Euler from the old positions, (M + dt² K) v⁺ = M v + dt f(u); Baraff and
//! Witkin, Large Steps in Cloth Simulation (1998). First order; no energy, no line search. Follower loads act on the surface at the
//! start of the step.

use fem_model::simulation::{Cause, Counters, History};

use super::followers::Followers;
use super::last_change::{extrapolate, finish};
use super::{Convergence, Integrator, Memory, momentum};
use crate::forces::{HessianKind, Moment};
use crate::model::state::State;
use crate::model::system::System;
use crate::newton::incremental_potential::{Increment, IncrementalPotential, Inertia, Workspace};
use fem_elements::history::{put, take};
use fem_elements::sparse::Block;
use fem_elements::vector::axpy;
use fem_solvers::{Real, Solver};

/// Linearly implicit Euler with its solver and vectors.
pub struct LinearlyImplicitEuler<T: Real> {
    solver: Solver<T>,
    /// Largest relative residual of an iterative solver.
    tolerance: f64,
    values: Vec<Block<T, 3>>,
    followers: Followers<T>,
    workspace: Workspace<T>,
    inertial: Vec<[T; 3]>,
    /// Displacements at which viscosity takes its matrix, m; empty without.
    stiffness_at: Vec<[T; 3]>,
    right: Vec<[T; 3]>,
    step: Vec<[T; 3]>,
    /// Change of velocity in the last step, m/s: an iterative solver starts from the same one.
    last_change: Vec<[T; 3]>,
    /// Increments of the constrained degrees of freedom, zero elsewhere.
    prescribed: Vec<[T; 3]>,
}

impl<T: Real> LinearlyImplicitEuler<T> {
    /// Allocates its vectors for a body.
    pub fn new(solver: Solver<T>, tolerance: f64, system: &System<T>) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        Self {
            solver,
            tolerance,
            values: vec![[[T::default(); 3]; 3]; system.pattern.blocks()],
            followers: Followers::new(system),
            workspace: Workspace::new(system.nodes()),
            inertial: zero(),
            stiffness_at: Vec::new(),
            right: zero(),
            step: zero(),
            last_change: zero(),
            prescribed: zero(),
        }
    }
}

impl<T: Real> Memory for LinearlyImplicitEuler<T> {
    fn accept(&mut self) {}

    fn forget(&mut self) {
        self.last_change.fill([T::default(); 3]);
    }

    fn forget_forces(&mut self) {}

    fn save(&self, history: &mut History) {
        if self.solver.is_iterative() {
            put(history, "linearly_implicit_euler.last_change", self.last_change.as_flattened());
        }
        // Every step has a matrix of its own.
        self.solver.save(false, history);
    }

    fn restore(&mut self, history: &History) -> Result<(), String> {
        if self.solver.is_iterative() {
            take(history, "linearly_implicit_euler.last_change", self.last_change.as_flattened_mut())?;
        }
        self.solver.restore(false, history)
    }
}

impl<T: Real> Integrator<T> for LinearlyImplicitEuler<T> {
    fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let Self {
            solver,
            values,
            followers,
            workspace,
            inertial,
            stiffness_at,
            right,
            step,
            last_change,
            prescribed,
            ..
        } = self;
        for (inertial, v) in inertial.iter_mut().zip(&state.v) {
            *inertial = v.map(|v| T::of(dt) * v);
        }
        let mut inertia = Inertia::new(system, inertial, dt);
        if system.has_viscosity() {
            stiffness_at.resize(state.u.len(), [T::default(); 3]);
            system.extrapolate_half((&state.u, &state.v), dt, stiffness_at);
            inertia.stiffness_at = Some(stiffness_at);
        }
        let increment = Increment { start: &state.u, end: Moment::at(state.time + dt), inertia: Some(inertia) };
        prescribed.fill([T::default(); 3]);
        followers.evaluate(system, &increment, prescribed);
        system.prescribe(&state.u, increment.end, prescribed);
        let potential = followers.potential(system, increment);
        counters.force_assemblies += 1;
        potential.linearized_gradient(prescribed, right, workspace);
        for right in right.as_flattened_mut() {
            *right = -*right;
        }
        step.fill([T::default(); 3]);
        prepare(&potential, step, solver, values, workspace, counters)?;
        extrapolate(step, inertial, last_change, dt);
        solver.solve(values, right, step, self.tolerance).map_err(Cause::Solver)?;
        system.dirichlet.clear_constrained(step);
        axpy(1.0, prescribed, step);
        momentum::restore(&potential, dt, 1.0, step);
        finish(step, dt, state, last_change);
        Ok(Convergence::Converged)
    }

    fn solver(&self) -> Option<&Solver<T>> {
        Some(&self.solver)
    }
}

/// Factors the Hessian at the start of the step, w = 0: the exact one, or the projected one where that is not positive definite.
fn prepare<T: Real>(
    potential: &IncrementalPotential<T>,
    w: &[[T; 3]],
    solver: &mut Solver<T>,
    values: &mut [Block<T, 3>],
    workspace: &mut Workspace<T>,
    counters: &mut Counters,
) -> Result<(), Cause> {
    let mut factor = |kind: HessianKind| {
        counters.stiffness_assemblies += 1;
        counters.factorizations += 1;
        counters.projections += if kind == HessianKind::Projected { potential.system.elements.count() } else { 0 };
        potential.hessian(w, kind, values, workspace);
        solver.prepare(values)
    };
    factor(HessianKind::Exact).or_else(|_| factor(HessianKind::Projected)).map_err(Cause::Solver)
}
