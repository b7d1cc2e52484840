//! Newton's method for the minimum of the incremental potential: robust, with as few Hessians as possible.
//!
//! A factor of the Hessian is kept, across iterations and across steps, as long as it converges quickly; limited-memory BFGS updates
//! it from the gradients (`Lbfgs`). Where convergence is slow the Hessian is assembled again: the exact one as long as it is
//! positive definite, else the one projected element by element, else that one with a growing shift of its diagonal. Every step
//! decreases the energy; where its change is within rounding error, the directional derivative.

mod direction;
mod forcing;
mod hessian;
mod increment;
pub mod incremental_potential;
mod lbfgs;
mod limits;
mod line_search;
mod saddle_point;
mod second_derivative;

pub use limits::NewtonLimits;

use fem_model::simulation::{Cause, Counters, History};

use crate::forces::{Energy, HessianKind};
use crate::model::system::System;
use fem_elements::history::{put, put_flag, put_option, take, take_flag, take_option};
use fem_elements::sparse::Block;
use fem_elements::vector::{max_norm, norm};
use fem_solvers::{Real, Solver};
pub use incremental_potential::LastEvaluation;
use incremental_potential::{IncrementalPotential, Workspace};
use lbfgs::Lbfgs;
use saddle_point::SaddlePoint;

/// Convergence of the iteration of a step. A method without an iteration always converges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Convergence {
    /// The step solves its equations to the tolerance.
    Converged,
    /// The iteration ended before that.
    NotConverged,
}

/// Newton's method, with the vectors and the factor that it keeps.
pub struct Newton<T: Real> {
    limits: NewtonLimits,
    solver: Solver<T>,
    /// The solver of a body with pressures.
    saddle_point: Option<Box<SaddlePoint>>,
    values: Vec<Block<T, 3>>,
    lbfgs: Lbfgs<T>,
    workspace: Workspace<T>,
    gradient: Vec<[T; 3]>,
    next_gradient: Vec<[T; 3]>,
    direction: Vec<[T; 3]>,
    right: Vec<[T; 3]>,
    next: Vec<[T; 3]>,
    /// The kept factor.
    factor: Factor,
    /// 1/τ² of the last Hessian, 1/s²; `None` if there is none, or none of a motion.
    inertia_of_hessian: Option<T>,
    /// Iterations of the first solve with the kept preconditioner; `None` where it has to be refactored.
    first_iterations: Option<usize>,
    /// True if the next solve is the first with a new preconditioner.
    is_new_preconditioner: bool,
    /// True if an iterative solver converged too slowly with the kept matrix in this step to keep it for the next one.
    is_matrix_outdated: bool,
}

/// The Hessian that the kept factor belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Factor {
    /// There is no factor, or it converges too slowly.
    Stale,
    /// An earlier Hessian.
    Kept,
    /// The exact Hessian of this iterate.
    Fresh,
    /// The projected Hessian of this iterate.
    FreshProjected,
}

/// The energy at the start of an iteration, evaluated; the gradient there is kept by [`Newton`].
pub struct Start(Energy);

/// Progress of the iteration.
struct Iterate {
    energy: Energy,
    /// Size of the last update, m, and of the part of its direction that was not feasible.
    size: f64,
    left_out: f64,
    /// Ratio of the last two sizes, from the second iteration on.
    rate: Option<f64>,
    /// Norm of the gradient, N, and that of the previous iterate.
    norms: (f64, f64),
    /// Forcing term: relative residual of the last linear solve; 0 for a direct solver.
    forcing: f64,
}

/// A new Hessian and its factor cost as much as so many iterations with a kept factor.
const COST_OF_A_FACTOR: f64 = 7.0;

impl<T: Real> Newton<T> {
    /// Allocates vectors for so many nodes and a matrix of so many blocks.
    pub fn new(limits: NewtonLimits, solver: Solver<T>, nodes: usize, blocks: usize) -> Self {
        let zero = || vec![[T::default(); 3]; nodes];
        Self {
            limits,
            solver,
            saddle_point: None,
            values: vec![[[T::default(); 3]; 3]; blocks],
            lbfgs: Lbfgs::new(nodes),
            workspace: Workspace::new(nodes),
            gradient: zero(),
            next_gradient: zero(),
            direction: zero(),
            right: zero(),
            next: zero(),
            factor: Factor::Stale,
            inertia_of_hessian: None,
            first_iterations: None,
            is_new_preconditioner: false,
            is_matrix_outdated: false,
        }
    }

    /// The same with pressures as unknowns; `None` if the body has none.
    pub fn with_pressures(limits: NewtonLimits, system: &System<T>) -> Option<Self> {
        let saddle_point = Box::new(SaddlePoint::new(system, system.forces.mixed()?));
        let solver = Solver::in_place_of(&system.pattern, saddle_point.bytes());
        let newton = Self::new(limits, solver, system.nodes(), system.pattern.blocks());
        Some(Self { saddle_point: Some(saddle_point), ..newton })
    }

    /// Drops the kept factor: a parameter or the state has changed.
    pub fn forget(&mut self) {
        (self.factor, self.inertia_of_hessian) = (Factor::Stale, None);
        self.first_iterations = None;
        self.lbfgs.clear();
    }

    /// Adds the kept factor and the data that decide how long it is kept.
    pub fn save(&self, history: &mut History) {
        let (is_kept, first_iterations) = (self.factor != Factor::Stale, self.first_iterations);
        put_flag(history, "newton.is_matrix_kept", is_kept);
        put_option(history, "newton.first_iterations", first_iterations.map(|count| count as f64));
        put_flag(history, "newton.is_new_preconditioner", self.is_new_preconditioner);
        self.saddle_point.iter().for_each(|saddle_point| saddle_point.save(history));
        self.solver.save(is_kept || first_iterations.is_some(), history);
        if is_kept {
            put_option(history, "newton.inertia", self.inertia_of_hessian.map(|inertia| inertia.as_f64()));
            let own = self.solver.own_matrix();
            let values = own.as_ref().unwrap_or(&self.values);
            put(history, "newton.values", values.as_flattened().as_flattened());
            self.lbfgs.save(history);
        }
    }

    /// Restores the data that [`save`](Self::save) has added.
    pub fn restore(&mut self, history: &History) -> Result<(), String> {
        self.forget();
        let is_kept = take_flag(history, "newton.is_matrix_kept")?;
        let first_iterations = take_option(history, "newton.first_iterations")?;
        // No solve takes more iterations than fit into 32 bits.
        self.first_iterations = first_iterations.map(|count| count as u32 as usize);
        self.is_new_preconditioner = take_flag(history, "newton.is_new_preconditioner")?;
        self.saddle_point.as_mut().map_or(Ok(()), |saddle_point| saddle_point.restore(history))?;
        self.solver.restore(is_kept || first_iterations.is_some(), history)?;
        if is_kept {
            take(history, "newton.values", self.values.as_flattened_mut().as_flattened_mut())?;
            self.solver.prepare_again(&self.values)?;
            self.lbfgs.restore(history)?;
            self.factor = Factor::Kept;
            self.inertia_of_hessian = take_option(history, "newton.inertia")?.map(T::of);
        }
        Ok(())
    }

    /// Its limits.
    pub fn limits(&self) -> &NewtonLimits {
        &self.limits
    }

    /// Sets the largest change of a coordinate in the last iteration, as a part of the body's length.
    pub fn set_tolerance(&mut self, tolerance: f64) {
        self.limits.tolerance = tolerance;
    }

    /// The linear solver.
    pub fn solver(&self) -> &Solver<T> {
        &self.solver
    }

    /// Keeps the linear solver alone.
    pub fn into_solver(self) -> Solver<T> {
        self.solver
    }

    /// The last evaluation, which is that of the solution after a step.
    pub fn last_evaluation(&self) -> &LastEvaluation<T> {
        &self.workspace.last
    }

    /// Evaluates the energy and its gradient at w. Returns `None` if the energy is not finite: the iteration cannot start there.
    pub fn start(
        &mut self,
        potential: &IncrementalPotential<T>,
        w: &[[T; 3]],
        counters: &mut Counters,
    ) -> Option<Start> {
        counters.energy_evaluations += 1;
        counters.force_assemblies += 1;
        let energy = potential.energy_and_gradient(w, &mut self.gradient, &mut self.workspace);
        energy.value.is_finite().then_some(Start(energy))
    }

    /// Moves w to the minimum of the potential, from the [`start`](Self::start) that was evaluated last.
    pub fn minimize(
        &mut self,
        potential: &IncrementalPotential<T>,
        Start(energy): Start,
        w: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<Convergence, Cause> {
        if let Some(mixed) = potential.system.forces.mixed() {
            return self.find_saddle_point(potential, mixed, energy, w, counters);
        }
        self.factor =
            if self.factor == Factor::Stale || !self.serves(potential) { Factor::Stale } else { Factor::Kept };
        self.is_matrix_outdated = false;
        let norm = norm(&self.gradient);
        let mut at =
            Iterate { energy, size: f64::INFINITY, left_out: 0.0, rate: None, norms: (norm, norm), forcing: 0.0 };
        let tolerance = self.limits.tolerance * potential.system.length;
        let scale = potential.system.forces.smallest_scale();
        for iteration in 0..self.limits.max_iterations {
            if at.norms.0 == 0.0 {
                return Ok(Convergence::Converged);
            }
            counters.newton_iterations += 1;
            let moved = self.iterate(potential, w, &mut at, counters)?;
            if !moved || at.remaining_update(scale) <= tolerance {
                if iteration as f64 > COST_OF_A_FACTOR || self.is_matrix_outdated {
                    self.factor = Factor::Stale;
                }
                return Ok(Convergence::Converged);
            }
            self.review_factor(&at, tolerance);
        }
        self.factor = Factor::Stale;
        Ok(Convergence::NotConverged)
    }

    /// One iteration: a direction and a line search. Returns false where rounding error allows no further decrease.
    fn iterate(
        &mut self,
        potential: &IncrementalPotential<T>,
        w: &mut [[T; 3]],
        at: &mut Iterate,
        counters: &mut Counters,
    ) -> Result<bool, Cause> {
        loop {
            if self.factor == Factor::Stale {
                self.prepare(potential, w, HessianKind::Exact, counters)?;
            }
            let derivative = self.find_direction(at, self.limits.tolerance * potential.system.length);
            if derivative < 0.0
                && let Some(length) = self.line_search(potential, w, at, derivative, counters)
            {
                self.accept(w, at, length);
                return Ok(true);
            }
            // No decrease along this direction: a newer Hessian, then the projected one, may give a better direction.
            match self.factor {
                Factor::Kept | Factor::Stale => self.factor = Factor::Stale,
                Factor::Fresh => self.prepare(potential, w, HessianKind::Projected, counters)?,
                Factor::FreshProjected => return self.check_stationary(potential, at),
            }
        }
    }

    fn accept(&mut self, w: &mut [[T; 3]], at: &mut Iterate, length: f64) {
        w.copy_from_slice(&self.next);
        if !self.solver.is_iterative() {
            self.lbfgs.push(length, &self.direction, &self.gradient, &self.next_gradient);
        }
        std::mem::swap(&mut self.gradient, &mut self.next_gradient);
        let size = length * max_norm(&self.direction);
        at.rate = at.size.is_finite().then_some(size / at.size);
        at.size = size;
        at.norms = (norm(&self.gradient), at.norms.0);
        if self.factor == Factor::Fresh || self.factor == Factor::FreshProjected {
            self.factor = Factor::Kept;
        }
    }

    /// Drops the factor where it would take more iterations to converge than a new one costs.
    fn review_factor(&mut self, at: &Iterate, tolerance: f64) {
        if self.solver.is_iterative() {
            return self.review_matrix(at, tolerance);
        }
        let Some(rate) = at.rate else { return };
        let remaining = (tolerance / at.size).ln() / rate.ln();
        // A rate of 1 and more makes it negative or NaN.
        if !(rate < 1.0 && remaining <= COST_OF_A_FACTOR) {
            self.factor = Factor::Stale;
        }
    }

    /// Ends the iteration if no direction decreases the energy: the iterate is the minimum to rounding error, or Newton's method has
    /// failed.
    fn check_stationary(&self, potential: &IncrementalPotential<T>, at: &Iterate) -> Result<bool, Cause> {
        if max_norm(&self.direction) <= self.limits.tolerance * potential.system.length {
            return Ok(false);
        }
        let unbalanced = max_norm(&self.gradient);
        let round_off = T::EPSILON.as_f64() * at.energy.terms / potential.system.length;
        if unbalanced <= 1e6 * round_off {
            return Ok(false);
        }
        Err(Cause::Stuck { unbalanced })
    }
}
