//! A solver for matrices of one sparsity pattern.

mod checkpoint;
mod compiled;
mod counters;

pub use compiled::Real;
pub use counters::SolverCounters;

use std::sync::Arc;

use super::ApproximateInverse;
use super::assembly::Assembly;
#[cfg(feature = "gpu")]
use super::assembly::DeviceElements;
use super::choice::SolverChoice;
use super::device;
use super::direct::{Lu, SupernodalCholesky, cholesky_for_directions};
use super::fallback::DirectFallback;
use super::krylov::{LinearSystem, Workspace, conjugate_gradients, parts, product, refine};
use super::memory::available_memory;
use super::parts::Part;
use super::preconditioners::{self, Identity};
use fem_elements::sparse::{Block, Pattern, Stored};
use fem_model::Timer;
use fem_model::simulation::Breakdown;

/// A solver for matrices of one sparsity pattern. It allocates nothing after the first [`prepare`](Self::prepare) and
/// [`solve`](Self::solve).
pub struct Solver<T: Real> {
    choice: SolverChoice,
    pattern: Arc<Pattern>,
    /// The parts of the matrix for products.
    parts: Part,
    inverse: Box<dyn ApproximateInverse<T>>,
    /// True if the matrix was assembled by the inverse itself, and only there.
    has_own_matrix: bool,
    fallback: Option<DirectFallback<T>>,
    workspace: Workspace<T>,
    counters: SolverCounters,
    preparing: Timer,
    solving: Timer,
    /// Bytes of a factor that another part keeps in its place.
    elsewhere: usize,
}

impl<T: Real> Solver<T> {
    /// Analyses a pattern that stores the blocks of [`SolverChoice::stored`]. `rest` holds the undeformed positions of the
    /// rows' nodes, m.
    pub fn new(choice: SolverChoice, pattern: &Arc<Pattern>, rest: &[[f64; 3]]) -> Self {
        <T as Real>::new(choice, pattern, rest)
    }

    pub(super) fn analysed(choice: SolverChoice, pattern: &Arc<Pattern>, rest: &[[f64; 3]]) -> Self {
        let inverse: Box<dyn ApproximateInverse<T>> = match choice {
            SolverChoice::Cholesky => Box::new(SupernodalCholesky::new(pattern)),
            SolverChoice::Lu => Box::new(Lu::new(pattern)),
            SolverChoice::Cg => Box::new(Identity),
            SolverChoice::Pcg(preconditioner) => preconditioners::build(preconditioner, pattern, rest),
            SolverChoice::Gpu(precision) => device::solver(precision, pattern, rest),
        };
        Self::with_inverse(choice, pattern, inverse)
    }

    /// The same for directions of Newton's method, where [`apply`](Self::apply) needs a few digits only: a Cholesky factor in single
    /// precision where the matrix allows it. [`solve`](Self::solve) reaches its tolerance all the same.
    pub fn for_directions(choice: SolverChoice, pattern: &Arc<Pattern>, rest: &[[f64; 3]]) -> Self {
        T::for_directions(choice, pattern, rest)
    }

    pub(super) fn analysed_for_directions(choice: SolverChoice, pattern: &Arc<Pattern>, rest: &[[f64; 3]]) -> Self {
        match choice {
            SolverChoice::Cholesky => Self::with_inverse(choice, pattern, cholesky_for_directions(pattern)),
            SolverChoice::Lu | SolverChoice::Cg | SolverChoice::Gpu(_) | SolverChoice::Pcg(_) => {
                Self::analysed(choice, pattern, rest)
            }
        }
    }

    fn with_inverse(choice: SolverChoice, pattern: &Arc<Pattern>, inverse: Box<dyn ApproximateInverse<T>>) -> Self {
        Self {
            choice,
            parts: parts(pattern),
            pattern: Arc::clone(pattern),
            inverse,
            has_own_matrix: false,
            fallback: None,
            workspace: Workspace::new(pattern.rows()),
            counters: SolverCounters { symbolic_factorizations: 1, ..SolverCounters::default() },
            preparing: Timer::default(),
            solving: Timer::default(),
            elsewhere: 0,
        }
    }

    /// Stands for a factor of so many bytes that another part keeps, and times.
    pub fn in_place_of(pattern: &Arc<Pattern>, bytes: usize) -> Self {
        Self { elsewhere: bytes, ..Self::with_inverse(SolverChoice::Cholesky, pattern, Box::new(Identity)) }
    }

    /// Factors the matrix where the iterative solver breaks down and a factor fits into memory: for a matrix that is positive definite unless
    /// the scene is wrong.
    pub fn with_direct_fallback(self) -> Self {
        self.with_direct_fallback_within(available_memory())
    }

    /// The same where a factor takes no more than so many bytes, if there is a limit. Without a factor nothing tells whether the matrix is
    /// positive definite, and a breakdown says that the iteration has not converged.
    pub fn with_direct_fallback_within(mut self, limit: Option<usize>) -> Self {
        let has_factor = self.choice.stored() == Stored::Lower && self.choice.is_iterative();
        self.fallback = has_factor.then(|| DirectFallback::within(limit));
        self
    }

    /// Computes the factor or the preconditioner for the values of a matrix. After an error it must be called again before
    /// [`solve`](Self::solve) and [`apply`](Self::apply).
    pub fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        T::prepare(self, values)
    }

    pub(super) fn prepare_or_fall_back(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        self.counters.factorizations += 1;
        self.has_own_matrix = false;
        let Self { inverse, preparing, .. } = self;
        let outcome = preparing.time(|| inverse.prepare(values));
        if let Some(fallback) = &mut self.fallback {
            fallback.is_in_use = false;
        }
        outcome.or_else(|breakdown| self.fall_back(values, breakdown))
    }

    /// Factors the matrix after a breakdown, or returns the breakdown where the solver does not [fall back](Self::with_direct_fallback).
    fn fall_back(&mut self, values: &[Block<T, 3>], breakdown: Breakdown) -> Result<(), Breakdown> {
        let Self { fallback, pattern, preparing, counters, .. } = self;
        let Some(fallback) = fallback.as_mut().filter(|fallback| !fallback.is_in_use) else { return Err(breakdown) };
        counters.symbolic_factorizations += usize::from(fallback.bytes() == 0);
        preparing.time(|| fallback.prepare(pattern, values, breakdown))?;
        counters.fallbacks += 1;
        Ok(())
    }

    /// Receives the elements whose matrices a graphics device then assembles; other solvers ignore them.
    #[cfg(feature = "gpu")]
    pub fn set_elements(&mut self, elements: &DeviceElements) {
        self.inverse.set_elements(elements);
    }

    /// Returns true if the solver [assembles](Self::assemble) matrices.
    pub fn assembles(&self) -> bool {
        self.inverse.assembles()
    }

    /// Assembles a matrix where it is solved with, and prepares it, if the solver [can](Self::assembles). Until the next
    /// [`prepare`](Self::prepare) it solves with this matrix, whatever values it is given.
    pub fn assemble(&mut self, matrix: &Assembly<T>) -> Result<(), Breakdown> {
        self.counters.factorizations += 1;
        self.has_own_matrix = true;
        let Self { inverse, preparing, .. } = self;
        preparing.time(|| inverse.assemble(matrix))
    }

    /// The smallest relative residual that [`solve`](Self::solve) reaches with the matrix of [`assemble`](Self::assemble).
    pub fn smallest_tolerance(&self) -> f64 {
        if self.has_own_matrix { self.inverse.smallest_tolerance() } else { 0.0 }
    }

    /// The matrix of [`assemble`](Self::assemble), where that is in use.
    pub fn own_matrix(&self) -> Option<Vec<Block<T, 3>>> {
        self.has_own_matrix.then(|| self.inverse.assembled().ok()).flatten()
    }

    /// Solves A x = b to ‖b − A x‖ ≤ `tolerance` ‖b‖, with the factor or preconditioner of this matrix or of a similar one.
    /// Returns the number of iterations, 0 if the factor's solution is accurate enough.
    ///
    /// Iterative methods start from the given x, direct ones from the factor's solution. Conjugate gradients reduce the
    /// residual that remains, preconditioned by the factor or preconditioner. After an error x is the last iterate.
    pub fn solve(
        &mut self,
        values: &[Block<T, 3>],
        b: &[[T; 3]],
        x: &mut [[T; 3]],
        tolerance: f64,
    ) -> Result<usize, Breakdown> {
        T::solve(self, values, b, x, tolerance)
    }

    pub(super) fn solve_or_fall_back(
        &mut self,
        values: &[Block<T, 3>],
        b: &[[T; 3]],
        x: &mut [[T; 3]],
        tolerance: f64,
    ) -> Result<usize, Breakdown> {
        self.counters.solves += 1;
        match self.iterate(values, b, x, tolerance) {
            Err(breakdown) => {
                self.fall_back(values, breakdown)?;
                self.iterate(values, b, x, tolerance)
            }
            solved => solved,
        }
    }

    /// One attempt at a solution, by the factor of the [fallback](Self::with_direct_fallback) where that is in use.
    fn iterate(
        &mut self,
        values: &[Block<T, 3>],
        b: &[[T; 3]],
        x: &mut [[T; 3]],
        tolerance: f64,
    ) -> Result<usize, Breakdown> {
        let Self { choice, pattern, parts, inverse, fallback, workspace, solving, .. } = self;
        let mut fallback = fallback.as_mut().filter(|fallback| fallback.is_in_use);
        let (b, x) = (&b[..pattern.rows()], &mut x[..pattern.rows()]);
        let has_own_matrix = self.has_own_matrix;
        let iterations = solving.time(|| {
            if has_own_matrix {
                x.fill([T::default(); 3]);
                return inverse.correct(b, x, tolerance.max(inverse.smallest_tolerance()));
            }
            let A = |x: &[[T; 3]], y: &mut [[T; 3]]| product(pattern, parts, values, x, y);
            let mut corrections = 0;
            if let Some(factor) = &mut fallback {
                factor.apply(b, x);
            } else if !choice.is_iterative() {
                inverse.apply(b, x);
            } else if choice.copies_matrix() {
                let refined = {
                    let least = inverse.smallest_tolerance();
                    refine(A, |r, x, t| inverse.correct(r, x, t), b, x, (tolerance, least), workspace)?
                };
                if refined.converged {
                    return Ok(refined.iterations);
                }
                corrections = refined.iterations;
            }
            let P = |r: &[[T; 3]], z: &mut [[T; 3]]| match &mut fallback {
                Some(factor) => factor.apply(r, z),
                None => inverse.apply(r, z),
            };
            let largest_entry = || largest_entry(pattern, values);
            let system = LinearSystem { A, largest_entry, b, tolerance };
            Ok(corrections + conjugate_gradients(system, P, x, workspace, &mut |_| {})?)
        })?;
        self.counters.iterations += iterations;
        Ok(iterations)
    }

    /// z = P⁻¹ r, with P the factorised matrix or the preconditioner.
    pub fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        T::apply(self, r, z);
    }

    pub(super) fn apply_inverse(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        let Self { pattern, inverse, fallback, solving, .. } = self;
        let (r, z) = (&r[..pattern.rows()], &mut z[..pattern.rows()]);
        solving.time(|| match fallback.as_mut().filter(|fallback| fallback.is_in_use) {
            Some(factor) => factor.apply(r, z),
            None => inverse.apply(r, z),
        });
    }

    /// Returns true if a solve iterates with the matrix that it is given, so that the prepared matrix only preconditions.
    pub fn is_iterative(&self) -> bool {
        self.choice.is_iterative()
    }

    /// Returns true if [`prepare`](Self::prepare) copies the matrix, so that a solve with another matrix is slow.
    pub fn copies_matrix(&self) -> bool {
        self.choice.copies_matrix()
    }

    /// Returns true if [`prepare`](Self::prepare) computes a preconditioner.
    pub fn has_preconditioner(&self) -> bool {
        self.choice.has_preconditioner()
    }

    /// Operations so far.
    pub fn counters(&self) -> SolverCounters {
        self.counters
    }

    /// Calls and time of [`prepare`](Self::prepare), and of [`solve`](Self::solve) and [`apply`](Self::apply).
    pub fn timers(&self) -> (&Timer, &Timer) {
        (&self.preparing, &self.solving)
    }

    /// Bytes of the factor or the preconditioner.
    pub fn prepared_bytes(&self) -> usize {
        self.inverse.bytes()
    }

    /// Allocated bytes without the pattern.
    pub fn bytes(&self) -> usize {
        let fallback = self.fallback.as_ref().map_or(0, |fallback| fallback.bytes());
        self.inverse.bytes() + self.workspace.bytes() + fallback + self.elsewhere
    }
}

/// The largest entry of a positive definite matrix, which is on its diagonal.
fn largest_entry<T: Real>(pattern: &Pattern, values: &[Block<T, 3>]) -> f64 {
    let entries = pattern.diagonal().flat_map(|block| (0..3).map(move |i| values[block][i][i].as_f64().abs()));
    entries.fold(0.0, f64::max)
}
