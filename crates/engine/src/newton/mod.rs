//! Newton's method for a step of implicit Euler: robust, and sparing with Hessians.
//!
//! A factor of the Hessian is kept as long as it leads on quickly, across iterations and across steps; what has changed since is
//! learnt from the gradients ([`Lbfgs`]). Where progress is slow the Hessian is assembled anew: as it is, as long as it is
//! positive definite, else projected element by element, else with a growing shift of its diagonal. Every step goes downhill in
//! energy; where differences of energies drown in round-off, in the slope.

mod forcing;
mod hessian;
pub mod incremental_potential;
pub mod lbfgs;
mod limits;
mod line_search;

pub use limits::Limits;

use crate::model::system::Energy;
use crate::newton::incremental_potential::{IncrementalPotential, Scratch};
use crate::newton::lbfgs::Lbfgs;
use crate::number::Real;
use crate::solvers::Solver;
use crate::sparse::Block;
use crate::vector::{dot, max_norm, norm};
use fem_scene::simulation::{Breakdown, Cause, Counters};

/// Newton's method, with all that it keeps.
pub struct Newton<T: Real> {
    limits: Limits,
    solver: Solver<T>,
    values: Vec<Block<T, 3>>,
    history: Lbfgs<T>,
    scratch: Scratch<T>,
    gradient: Vec<[T; 3]>,
    next_gradient: Vec<[T; 3]>,
    direction: Vec<[T; 3]>,
    right: Vec<[T; 3]>,
    next: Vec<[T; 3]>,
    /// How good the kept factor is.
    factor: Factor,
    /// Iterations of the first solve with the preconditioner that is kept; none before there is one, or where it is worn out.
    iterations_at_first: Option<usize>,
    /// Whether the next solve is the first with a new preconditioner.
    is_new: bool,
    /// Whether an iterative solver's kept matrix has led on too slowly in this step to begin the next one with.
    is_outworn: bool,
}

/// What the kept factor belongs to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Factor {
    /// None is there, or it leads on too slowly.
    Stale,
    /// An earlier Hessian.
    Kept,
    /// The Hessian where the iteration is.
    Fresh,
    /// The same, projected.
    FreshProjected,
}

/// What is known of an iteration.
struct Iterate {
    energy: Energy,
    /// Size of the last update, m.
    size: f64,
    /// Ratio of the last two sizes; none before there are two.
    rate: Option<f64>,
    /// Norm of the gradient, N, and of the one before it.
    norms: (f64, f64),
    /// Relative residual that the last direction was solved to; 0 where it is exact.
    forcing: f64,
}

/// Iterations with a kept factor that cost as much as a new Hessian and its factor.
const PRICE_OF_A_FACTOR: f64 = 7.0;

impl<T: Real> Newton<T> {
    /// For a body of so many nodes, and matrices of so many blocks.
    pub fn new(limits: Limits, solver: Solver<T>, nodes: usize, blocks: usize) -> Self {
        let zero = || vec![[T::default(); 3]; nodes];
        Self {
            limits,
            solver,
            values: vec![[[T::default(); 3]; 3]; blocks],
            history: Lbfgs::new(nodes),
            scratch: Scratch::new(nodes),
            gradient: zero(),
            next_gradient: zero(),
            direction: zero(),
            right: zero(),
            next: zero(),
            factor: Factor::Stale,
            iterations_at_first: None,
            is_new: false,
            is_outworn: false,
        }
    }

    /// The kept factor belongs to something else: a parameter or the integrator has changed.
    pub fn forget(&mut self) {
        self.factor = Factor::Stale;
        self.iterations_at_first = None;
        self.history.clear();
    }

    /// When it ends.
    pub fn limits(&self) -> &Limits {
        &self.limits
    }

    /// The linear solver.
    pub fn solver(&self) -> &Solver<T> {
        &self.solver
    }

    /// The linear solver alone.
    pub fn into_solver(self) -> Solver<T> {
        self.solver
    }

    /// Whether the energy is finite, so that a step can start there.
    pub fn can_start(&mut self, objective: &IncrementalPotential<T>, w: &[[T; 3]], counters: &mut Counters) -> bool {
        counters.energy_evaluations += 1;
        counters.force_assemblies += 1;
        objective.energy_and_gradient(w, &mut self.gradient, &mut self.scratch).value.is_finite()
    }

    /// Moves w, at which [`can_start`](Self::can_start) has just said yes, to the minimum. Says whether it came as near as the
    /// tolerance asks.
    pub fn minimize(
        &mut self,
        objective: &IncrementalPotential<T>,
        w: &mut [[T; 3]],
        counters: &mut Counters,
    ) -> Result<bool, Cause> {
        if self.factor != Factor::Stale {
            self.factor = Factor::Kept;
        }
        self.is_outworn = false;
        let energy = objective.energy_and_gradient(w, &mut self.gradient, &mut self.scratch);
        let norm = norm(&self.gradient);
        let mut at = Iterate { energy, size: f64::INFINITY, rate: None, norms: (norm, norm), forcing: 0.0 };
        let tolerance = self.limits.tolerance * objective.system.length;
        for iteration in 0..self.limits.max_iterations {
            if at.norms.0 == 0.0 {
                return Ok(true);
            }
            counters.newton_iterations += 1;
            let moved = self.advance(objective, w, &mut at, counters)?;
            if !moved || at.left() <= tolerance {
                if iteration as f64 > PRICE_OF_A_FACTOR || self.is_outworn {
                    self.factor = Factor::Stale;
                }
                return Ok(true);
            }
            self.judge(&at, tolerance);
        }
        self.factor = Factor::Stale;
        Ok(false)
    }

    /// One iteration: a direction, and a step along it. False where the energy is as low as round-off lets it be.
    fn advance(
        &mut self,
        objective: &IncrementalPotential<T>,
        w: &mut [[T; 3]],
        at: &mut Iterate,
        counters: &mut Counters,
    ) -> Result<bool, Cause> {
        loop {
            if self.factor == Factor::Stale {
                self.prepare(objective, w, false, counters)?;
            }
            let slope = self.find_direction(at, self.limits.tolerance * objective.system.length);
            if slope < 0.0
                && let Some(length) = self.search(objective, w, at, slope, counters)
            {
                self.accept(w, at, length);
                return Ok(true);
            }
            // Downhill there is nothing left: a better Hessian may still know a way.
            match self.factor {
                Factor::Kept | Factor::Stale => self.factor = Factor::Stale,
                Factor::Fresh => self.prepare(objective, w, true, counters)?,
                Factor::FreshProjected => return self.end_of_the_way(objective, at),
            }
        }
    }

    /// Solves for the direction, and returns the slope along it: not below zero where there is no way down.
    fn find_direction(&mut self, at: &mut Iterate, tolerance: f64) -> f64 {
        for (right, g) in self.right.iter_mut().zip(&self.gradient) {
            *right = g.map(|g| -g);
        }
        let solved = if self.solver.is_iterative() {
            at.forcing = at.next_forcing(tolerance).max(self.limits.solver_tolerance);
            self.solve(at.forcing)
        } else {
            let Self { solver, history, direction, right, .. } = self;
            direction.copy_from_slice(right);
            let apply = |x: &mut [[T; 3]]| {
                right.copy_from_slice(x);
                solver.apply(right, x);
                Ok::<(), Breakdown>(())
            };
            history.apply(direction, apply).is_ok()
        };
        if solved { dot(&self.gradient, &self.direction) } else { f64::NAN }
    }

    fn accept(&mut self, w: &mut [[T; 3]], at: &mut Iterate, length: f64) {
        w.copy_from_slice(&self.next);
        if !self.solver.is_iterative() {
            self.history.push(length, &self.direction, &self.gradient, &self.next_gradient);
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

    /// Decides whether the factor is worth keeping: not where more iterations are left than a new one costs.
    fn judge(&mut self, at: &Iterate, tolerance: f64) {
        if self.solver.is_iterative() {
            return self.judge_matrix(at, tolerance);
        }
        let Some(rate) = at.rate else { return };
        let left = (tolerance / at.size).ln() / rate.ln();
        // A rate that is no progress makes it negative or NaN.
        if !(rate < 1.0 && left <= PRICE_OF_A_FACTOR) {
            self.factor = Factor::Stale;
        }
    }

    /// No direction leads down any more: either that is the minimum, as far as numbers go, or something is wrong.
    fn end_of_the_way(&self, objective: &IncrementalPotential<T>, at: &Iterate) -> Result<bool, Cause> {
        // What is left to move is less than what is asked for.
        if max_norm(&self.direction) <= self.limits.tolerance * objective.system.length {
            return Ok(false);
        }
        let unbalanced = max_norm(&self.gradient);
        let round_off = T::EPSILON.as_f64() * at.energy.terms / objective.system.length;
        if unbalanced <= 1e6 * round_off {
            return Ok(false);
        }
        Err(Cause::Stuck { unbalanced })
    }
}
