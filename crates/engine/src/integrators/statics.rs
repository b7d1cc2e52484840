//! Static equilibrium, ∇V(u) = 0, by load stepping: loads and prescribed motions grow in equal parts, one in each step, and those with a
//! curve follow it over the pseudo-time that the steps count.

use fem_model::simulation::{Cause, Counters, History};

use super::arc_length::ArcLength;
use super::balance::{Sizes, sizes};
use super::load_step::LoadStep;
use super::{Convergence, Integrator, Memory};
use crate::forces::{HessianKind, Moment};
use crate::model::state::State;
use crate::model::system::System;
use crate::newton::incremental_potential::{Increment, IncrementalPotential, Workspace};
use crate::newton::{Newton, NewtonLimits};
use fem_elements::history::{put, take};
use fem_elements::sparse::Block;
use fem_elements::vector::{axpy, max_norm, norm};
use fem_solvers::{Real, Solver};

/// Load stepping with its solver and vectors.
pub struct Statics<T: Real> {
    method: Method<T>,
    load_steps: usize,
}

enum Method<T: Real> {
    Linear(Box<Linear<T>>),
    Newton(Box<LoadStep<T>>),
    ArcLength(Box<ArcLength<T>>),
}

/// K u = f with its solver and vectors.
struct Linear<T: Real> {
    /// `None` while Newton's method has it.
    solver: Option<Solver<T>>,
    limits: NewtonLimits,
    values: Vec<Block<T, 3>>,
    workspace: Workspace<T>,
    undeformed: Vec<[T; 3]>,
    right: Vec<[T; 3]>,
    solution: Vec<[T; 3]>,
}

/// Machine epsilon above which a linear solution is refined, and the largest number of refinements.
const PRECISE: f64 = 1e-12;
const REFINEMENTS: usize = 100;

/// Relative residual of an update whose size alone matters.
const ESTIMATED: f64 = 1e-2;

/// Change of a refinement, as a part of the displacements, up to which rounding errors are what keeps it from falling.
const ROUNDING: f64 = 1e-4;

impl<T: Real> Statics<T> {
    /// Allocates its vectors for a body; a linear one keeps only the solver of `newton`.
    pub fn new(newton: Newton<T>, system: &System<T>, load_steps: usize) -> Self {
        let zero = || vec![[T::default(); 3]; system.nodes()];
        let method = if system.may_be_linear() {
            Method::Linear(Box::new(Linear {
                limits: *newton.limits(),
                solver: Some(newton.into_solver()),
                values: vec![[[T::default(); 3]; 3]; system.pattern.blocks()],
                workspace: Workspace::new(system.nodes()),
                undeformed: zero(),
                right: zero(),
                solution: zero(),
            }))
        } else {
            Method::Newton(Box::new(LoadStep::new(newton, system)))
        };
        Self { method, load_steps }
    }

    /// The same along the equilibrium path, through limit points; only the solver and the limits of `newton` are kept.
    pub fn by_arc_length(newton: Newton<T>, system: &System<T>, load_steps: usize) -> Self {
        let limits = *newton.limits();
        let path = ArcLength::new(newton.into_solver(), limits, system, load_steps);
        Self { method: Method::ArcLength(Box::new(path)), load_steps }
    }

    /// Load factor after so many steps; it stays at 1 after the last load step.
    fn load_factor(&self, steps: usize) -> f64 {
        if let Method::ArcLength(path) = &self.method {
            return path.load_factor(steps);
        }
        steps.min(self.load_steps) as f64 / self.load_steps as f64
    }
}

impl<T: Real> Memory for Statics<T> {
    fn accept(&mut self) {}

    fn forget(&mut self) {
        if let Method::Newton(load_step) = &mut self.method {
            load_step.newton.forget();
        }
    }

    fn forget_forces(&mut self) {}

    fn save(&self, history: &mut History) {
        match &self.method {
            Method::Linear(linear) => {
                // An iterative solver starts from the last solution.
                put(history, "static.solution", linear.solution.as_flattened());
                linear.solver.iter().for_each(|solver| solver.save(false, history));
            }
            Method::Newton(load_step) => load_step.newton.save(history),
            Method::ArcLength(path) => path.save(history),
        }
    }

    fn restore(&mut self, history: &History) -> Result<(), String> {
        match &mut self.method {
            Method::Linear(linear) => {
                take(history, "static.solution", linear.solution.as_flattened_mut())?;
                linear.solver.as_mut().map_or(Ok(()), |solver| solver.restore(false, history))
            }
            Method::Newton(load_step) => load_step.newton.restore(history),
            Method::ArcLength(path) => path.restore(history),
        }
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
        let start = self.moment(state);
        let end = Moment { time: state.time + dt, load_factor: Some(self.load_factor(state.steps + 1)) };
        match &mut self.method {
            Method::Linear(linear) => linear.advance(system, &mut state.u, (start, end), counters),
            Method::Newton(load_step) => load_step.advance(system, &mut state.u, (start, end), counters),
            Method::ArcLength(path) => path.step(system, &mut state.u, (end.time, state.steps), counters),
        }
    }

    fn moment(&self, state: &State<T>) -> Moment {
        Moment { time: state.time, load_factor: Some(self.load_factor(state.steps)) }
    }

    fn solver(&self) -> Option<&Solver<T>> {
        match &self.method {
            Method::Linear(linear) => linear.solver.as_ref(),
            Method::Newton(load_step) => Some(load_step.newton.solver()),
            Method::ArcLength(path) => Some(&path.solver),
        }
    }
}

impl<T: Real> Linear<T> {
    /// Solves once. If the forces at the solution are not those of their linearization, Newton's method takes the load step.
    fn advance(
        &mut self,
        system: &System<T>,
        u: &mut [[T; 3]],
        (start, end): (Moment, Moment),
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let mut solver = self.solver.take().expect("every load step gives the solver back");
        let before = u.to_vec();
        let outcome = self.solve(&mut solver, system, end, u, counters);
        let is_solved = match outcome {
            Ok(_) => self.has_linear_forces(&mut solver, system, end, u),
            // The matrix of forces without a Hessian is that of the elements.
            Err(_) => system.forces.nodes_of_hessians().is_some_and(|nodes| nodes.is_empty()),
        };
        if is_solved {
            self.solver = Some(solver);
            return outcome;
        }
        u.copy_from_slice(&before);
        let newton = Newton::new(self.limits, solver, system.nodes(), system.pattern.blocks());
        let mut load_step = LoadStep::new(newton, system);
        let outcome = load_step.advance(system, u, (start, end), counters);
        self.solver = Some(load_step.newton.into_solver());
        outcome
    }

    /// Returns true if ∇V(u) = ∇V(0) + ∇²V(0) u for the energy V of the forces: then the one solve has found equilibrium. A difference
    /// counts by the update that it causes, as in Newton's method.
    fn has_linear_forces(&mut self, solver: &mut Solver<T>, system: &System<T>, moment: Moment, u: &[[T; 3]]) -> bool {
        let Self { undeformed, right: linear, values, limits, .. } = self;
        let (mut difference, mut update) = (vec![[T::default(); 3]; u.len()], vec![[T::default(); 3]; u.len()]);
        linear.fill([T::default(); 3]);
        system.add_gradient_of_forces(undeformed, moment, linear);
        system.add_external_hessian_times(undeformed, moment, u, linear);
        system.add_gradient_of_forces(u, moment, &mut difference);
        axpy(-1.0, linear, &mut difference);
        system.dirichlet.clear_constrained(&mut difference);
        let is_exact = norm(&difference) == 0.0;
        let is_known = is_exact || solver.solve(values, &difference, &mut update, ESTIMATED).is_ok();
        // NaN fails the comparison.
        let is_small = norm(&update) <= limits.tolerance * system.length;
        is_known && is_small && system.energy_of_forces(u, moment).value.is_finite()
    }

    /// Writes the solution of K u = f into `u`; prescribed displacements move to the right-hand side.
    fn solve(
        &mut self,
        solver: &mut Solver<T>,
        system: &System<T>,
        moment: Moment,
        u: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        let Self { limits, values, workspace, undeformed, right, solution, .. } = self;
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
        solver.solve(values, right, solution, limits.solver_tolerance).map_err(Cause::Solver)?;
        system.dirichlet.clear_constrained(solution);
        axpy(1.0, solution, u);
        let is_precise = T::EPSILON.as_f64() <= PRECISE
            && (solver.is_iterative() || {
                let Sizes { unbalanced, largest, .. } = sizes(system, u, moment, right);
                unbalanced <= PRECISE.sqrt() * largest
            });
        if is_precise { Ok(Convergence::Converged) } else { self.refine(solver, system, moment, u) }
    }

    /// Iterative refinement, Wilkinson, Rounding Errors in Algebraic Processes (1963): the factor of an ill-conditioned matrix loses
    /// digits that the forces of the elements keep.
    fn refine(
        &mut self,
        solver: &mut Solver<T>,
        system: &System<T>,
        moment: Moment,
        u: &mut [[T; 3]],
    ) -> Result<Convergence, Cause> {
        let Self { limits, values, right, solution, .. } = self;
        let mut before = f64::INFINITY;
        for _ in 0..REFINEMENTS {
            system.gradient(u, moment, right);
            for right in right.as_flattened_mut() {
                *right = -*right;
            }
            system.dirichlet.clear_constrained(right);
            solution.fill([T::default(); 3]);
            solver.solve(values, right, solution, limits.solver_tolerance).map_err(Cause::Solver)?;
            system.dirichlet.clear_constrained(solution);
            axpy(1.0, solution, u);
            let (change, size) = (max_norm(solution), max_norm(u));
            if change <= T::EPSILON.as_f64() * size || change >= before && change <= ROUNDING * size {
                return Ok(Convergence::Converged);
            }
            // NaN fails the comparison.
            if !(change < before) {
                break;
            }
            before = change;
        }
        Ok(Convergence::NotConverged)
    }
}
