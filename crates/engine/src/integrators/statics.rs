//! Static equilibrium, ∇V(u) = 0, by load stepping: loads and prescribed motions grow in equal parts, one in each step.

use fem_scene::simulation::{Cause, Counters, History};

use super::arc_length::ArcLength;
use super::followers::Followers;
use super::initial_guess::infeasible;
use super::{Convergence, Integrator};
use crate::forces::{HessianKind, Moment};
use crate::model::state::State;
use crate::model::system::System;
use crate::newton::Newton;
use crate::newton::incremental_potential::{Increment, IncrementalPotential, Workspace};
use crate::solvers::Solver;
use fem_elements::Real;
use fem_elements::history::{put, take};
use fem_elements::sparse::Block;
use fem_elements::vector::{axpy, max_norm};

/// Load stepping with its solver and vectors.
pub struct Statics<T: Real> {
    method: Method<T>,
    followers: Followers<T>,
    load_steps: usize,
    prescribed: Vec<[T; 3]>,
    step: Vec<[T; 3]>,
}

enum Method<T: Real> {
    Linear(Box<Linear<T>>),
    Newton(Box<Newton<T>>),
    ArcLength(Box<ArcLength<T>>),
}

/// K u = f with its solver and vectors.
struct Linear<T: Real> {
    solver: Solver<T>,
    tolerance: f64,
    values: Vec<Block<T, 3>>,
    workspace: Workspace<T>,
    undeformed: Vec<[T; 3]>,
    right: Vec<[T; 3]>,
    solution: Vec<[T; 3]>,
}

/// Machine epsilon above which a linear solution is refined, and the largest number of refinements.
const PRECISE: f64 = 1e-12;
const REFINEMENTS: usize = 4;

/// Largest number of times that a load step is halved.
const HALVINGS: i32 = 10;

impl<T: Real> Statics<T> {
    /// Allocates its vectors for a body; a linear one keeps only the solver of `newton`.
    pub fn new(newton: Newton<T>, system: &System<T>, load_steps: usize) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        let method = if system.is_linear() {
            Method::Linear(Box::new(Linear {
                tolerance: newton.limits().solver_tolerance,
                solver: newton.into_solver(),
                values: vec![[[T::default(); 3]; 3]; system.pattern.blocks()],
                workspace: Workspace::new(system.nodes()),
                undeformed: zero(),
                right: zero(),
                solution: zero(),
            }))
        } else {
            Method::Newton(Box::new(newton))
        };
        Self { method, followers: Followers::new(system), load_steps, prescribed: zero(), step: zero() }
    }

    /// The same along the equilibrium path, through limit points; only the solver and the limits of `newton` are kept.
    pub fn by_arc_length(newton: Newton<T>, system: &System<T>, load_steps: usize) -> Self {
        let limits = *newton.limits();
        let path = ArcLength::new(newton.into_solver(), limits, system, load_steps);
        let method = Method::ArcLength(Box::new(path));
        Self { method, followers: Followers::new(system), load_steps, prescribed: Vec::new(), step: Vec::new() }
    }

    /// Load factor after so many steps; it stays at 1 after the last load step.
    fn load_factor(&self, steps: usize) -> f64 {
        if let Method::ArcLength(path) = &self.method {
            return path.load_factor(steps);
        }
        steps.min(self.load_steps) as f64 / self.load_steps as f64
    }
}

impl<T: Real> Integrator<T> for Statics<T> {
    /// One load step.
    fn step(
        &mut self,
        system: &System<T>,
        state: &mut State<T>,
        dt: f64,
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let time = state.time + dt;
        let (from, to) = (self.load_factor(state.steps), self.load_factor(state.steps + 1));
        let Self { method, followers, prescribed, step, .. } = self;
        match method {
            Method::Linear(linear) => {
                linear.solve(system, Moment { time, load_factor: Some(to) }, &mut state.u, counters)?;
                Ok(Convergence::Converged)
            }
            Method::Newton(newton) => {
                let mut load_step = LoadStep { newton, system, time, followers, prescribed, step };
                load_step.advance(&mut state.u, (from, to), counters)
            }
            Method::ArcLength(path) => path.step(system, &mut state.u, (time, state.steps), counters),
        }
    }

    fn forget(&mut self) {
        if let Method::Newton(newton) = &mut self.method {
            newton.forget();
        }
    }

    fn save(&self, history: &mut History) {
        match &self.method {
            Method::Linear(linear) => {
                // An iterative solver starts from the last solution.
                put(history, "static.solution", linear.solution.as_flattened());
                linear.solver.save(false, history);
            }
            Method::Newton(newton) => newton.save(history),
            Method::ArcLength(path) => path.save(history),
        }
    }

    fn restore(&mut self, history: &History) -> Result<(), String> {
        match &mut self.method {
            Method::Linear(linear) => {
                take(history, "static.solution", linear.solution.as_flattened_mut())?;
                linear.solver.restore(false, history)
            }
            Method::Newton(newton) => newton.restore(history),
            Method::ArcLength(path) => path.restore(history),
        }
    }

    fn moment(&self, state: &State<T>) -> Moment {
        Moment { time: state.time, load_factor: Some(self.load_factor(state.steps)) }
    }

    fn solver(&self) -> Option<&Solver<T>> {
        Some(match &self.method {
            Method::Linear(linear) => &linear.solver,
            Method::Newton(newton) => newton.solver(),
            Method::ArcLength(path) => &path.solver,
        })
    }

    fn has_line_search(&self) -> bool {
        matches!(self.method, Method::Newton(_))
    }
}

impl<T: Real> Linear<T> {
    /// Writes the solution of K u = f into `u`; prescribed displacements move to the right-hand side.
    fn solve(
        &mut self,
        system: &System<T>,
        moment: Moment,
        u: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<(), Cause> {
        let Self { solver, tolerance, values, workspace, undeformed, right, solution } = self;
        let increment = Increment { start: undeformed, end: moment, inertia: None };
        let potential = IncrementalPotential { system, increment, followers: &[] };
        u.fill([T::default(); 3]);
        system.prescribe(undeformed, moment, u);
        counters.force_assemblies += 1;
        potential.linearized_gradient(u, right, workspace);
        for right in right.as_flattened_mut() {
            *right = -*right;
        }
        counters.stiffness_assemblies += 1;
        counters.factorizations += 1;
        potential.hessian(undeformed, HessianKind::Exact, values, workspace);
        solver.prepare(values).map_err(Cause::Solver)?;
        solver.solve(values, right, solution, *tolerance).map_err(Cause::Solver)?;
        system.dirichlet.clear_constrained(solution);
        axpy(1.0, solution, u);
        if T::EPSILON.as_f64() > PRECISE { self.refine(system, moment, u) } else { Ok(()) }
    }

    /// Iterative refinement, Wilkinson, Rounding Errors in Algebraic Processes (1963): the factor of an ill-conditioned matrix loses
    /// digits that the forces of the elements keep.
    fn refine(&mut self, system: &System<T>, moment: Moment, u: &mut [[T; 3]]) -> Result<(), Cause> {
        let Self { solver, tolerance, values, right, solution, .. } = self;
        for _ in 0..REFINEMENTS {
            system.gradient(u, moment, right);
            for right in right.as_flattened_mut() {
                *right = -*right;
            }
            system.dirichlet.clear_constrained(right);
            solution.fill([T::default(); 3]);
            solver.solve(values, right, solution, *tolerance).map_err(Cause::Solver)?;
            system.dirichlet.clear_constrained(solution);
            axpy(1.0, solution, u);
            if max_norm(solution) <= T::EPSILON.as_f64() * max_norm(u) {
                break;
            }
        }
        Ok(())
    }
}

/// One load step of a nonlinear body.
struct LoadStep<'a, T: Real> {
    newton: &'a mut Newton<T>,
    system: &'a System<T>,
    time: f64,
    followers: &'a mut Followers<T>,
    prescribed: &'a mut Vec<[T; 3]>,
    step: &'a mut Vec<[T; 3]>,
}

impl<T: Real> LoadStep<'_, T> {
    /// From one load factor to another, in smaller parts where Newton's method fails.
    fn advance(
        &mut self,
        u: &mut [[T; 3]],
        (from, to): (f64, f64),
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let whole = to - from;
        let (mut at, mut part) = (from, whole);
        let mut convergence = Convergence::Converged;
        loop {
            let next = if at + part >= to - 1e-9 * whole { to } else { at + part };
            let outcome = self.equilibrate(u, next, counters);
            let is_smallest = part <= whole * 0.5f64.powi(HALVINGS);
            match outcome {
                Ok(reached) if reached == Convergence::Converged || is_smallest => {
                    axpy(1.0, self.step, u);
                    if reached == Convergence::NotConverged {
                        convergence = reached;
                    }
                    at = next;
                    part *= 2.0;
                }
                Err(cause) if is_smallest => return Err(cause),
                _ => part *= 0.5,
            }
            if at >= to {
                return Ok(convergence);
            }
        }
    }

    /// Writes the increment from u to equilibrium at a load factor into `step`.
    fn equilibrate(&mut self, u: &[[T; 3]], load_factor: f64, counters: &mut Counters) -> Result<Convergence, Cause> {
        let Self { newton, system, time, followers, prescribed, step } = self;
        let end = Moment { time: *time, load_factor: Some(load_factor) };
        let increment = Increment { start: u, end, inertia: None };
        step.fill([T::default(); 3]);
        followers.evaluate(system, &increment, step);
        system.prescribe(u, end, prescribed);
        newton.predict(&followers.potential(system, increment), prescribed, step, counters)?;
        system.make_feasible(u, end, step);
        let start = match newton.start(&followers.potential(system, increment), step, counters) {
            Some(start) => start,
            None => {
                step.copy_from_slice(prescribed);
                system.make_feasible(u, end, step);
                let start = newton.start(&followers.potential(system, increment), step, counters);
                start.ok_or_else(|| infeasible(system, u, prescribed))?
            }
        };
        followers.minimize(newton, system, increment, start, step, counters)
    }
}
