//! Linear solvers of A x = b behind one type: what depends on the pattern alone is done once, by [`Solver::new`]; what depends
//! on the values by [`Solver::prepare`]; what depends on b by [`Solver::solve`].

mod amd;
mod block_jacobi;
mod cg;
mod cholesky;
mod csc;
mod incomplete_cholesky;
mod large;
mod lu;
mod multigrid;
mod product;
mod refine;
mod ssor;
mod supernodal;

#[cfg(test)]
pub(crate) mod beam;
#[cfg(test)]
mod tests;

use std::fmt;
use std::sync::Arc;
use std::time::Instant;

pub use amd::amd_order;
pub use product::product;

use block_jacobi::BlockJacobi;
use cg::{Work, conjugate_gradients};
use cholesky::Cholesky;
use incomplete_cholesky::IncompleteCholesky;
use lu::Lu;
use multigrid::Multigrid;
use refine::refine;
use ssor::Ssor;

use crate::model::numbering::Ordering;
use crate::number::Real;
use crate::profile::Timer;
use crate::sparse::{Pattern, Stored};

pub use fem_scene::simulation::Breakdown;

/// What a solve took.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Solved {
    /// Iterations; none where the preparation alone was good enough.
    pub iterations: usize,
}

/// A way to solve linear systems.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolverChoice {
    /// A = L Lᵀ.
    Cholesky,
    /// A = L U with row exchanges.
    Lu,
    /// Conjugate gradients.
    Cg,
    /// Conjugate gradients with a preconditioner.
    Pcg(Preconditioner),
}

impl SolverChoice {
    /// Which blocks the patterns for it must store.
    pub fn stored(self) -> Stored {
        match self {
            SolverChoice::Cholesky | SolverChoice::Pcg(Preconditioner::Ssor) => Stored::Lower,
            SolverChoice::Lu | SolverChoice::Cg | SolverChoice::Pcg(_) => Stored::Full,
        }
    }

    /// In which order the rows should be: a factor should fill in little, sweeps should pass from one end to the other.
    pub fn numbering(self) -> Ordering {
        match self {
            SolverChoice::Cholesky | SolverChoice::Lu => Ordering::Dissected,
            SolverChoice::Cg | SolverChoice::Pcg(_) => Ordering::Swept,
        }
    }
}

/// What conjugate gradients are preconditioned with.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Preconditioner {
    /// The diagonal blocks.
    BlockJacobi,
    /// A Cholesky factor with the places of the matrix.
    IncompleteCholesky,
    /// Smoothed aggregation.
    Multigrid,
    /// Symmetric sweeps of Gauss and Seidel, and a coarse grid; the iteration itself runs in single precision.
    Ssor,
}

impl fmt::Display for SolverChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Cholesky => "Cholesky's factor, symbolic part once",
            Self::Lu => "LU factor with row exchanges",
            Self::Cg => "conjugate gradients",
            Self::Pcg(Preconditioner::BlockJacobi) => "conjugate gradients with the blocks of the diagonal",
            Self::Pcg(Preconditioner::IncompleteCholesky) => "conjugate gradients with an incomplete Cholesky factor",
            Self::Pcg(Preconditioner::Multigrid) => "conjugate gradients with a multigrid cycle",
            Self::Pcg(Preconditioner::Ssor) => {
                "conjugate gradients with symmetric sweeps and a coarse grid, in single precision"
            }
        })
    }
}

/// What a solver did so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counters {
    /// Times that a pattern was analysed.
    pub symbolic_factorizations: usize,
    /// Times that a factor or a preconditioner was computed.
    pub factorizations: usize,
    /// Systems that were solved.
    pub solves: usize,
    /// Iterations of all solves.
    pub iterations: usize,
}

/// A solver for matrices of one pattern. After its first preparation and solve it allocates nothing.
pub struct Solver<T: Real> {
    pattern: Arc<Pattern>,
    method: Method<T>,
    work: Work<T>,
    counters: Counters,
    preparing: Timer,
    solving: Timer,
}

enum Method<T> {
    Cholesky(Cholesky<T>),
    Lu(Box<Lu<T>>),
    Cg,
    BlockJacobi(BlockJacobi<T>),
    IncompleteCholesky(IncompleteCholesky<T>),
    Multigrid(Box<Multigrid>),
    Ssor(Box<Ssor>),
}

impl<T: Real> Solver<T> {
    /// Analyses a pattern, of which [`stored`](SolverChoice::stored) blocks are stored. `rest` holds the places of the rows' nodes at rest, in m.
    pub fn new(kind: SolverChoice, pattern: &Arc<Pattern>, rest: &[[f64; 3]]) -> Self {
        let method = match kind {
            SolverChoice::Cholesky => Method::Cholesky(Cholesky::new(pattern)),
            SolverChoice::Lu => Method::Lu(Box::new(Lu::new(pattern))),
            SolverChoice::Cg => Method::Cg,
            SolverChoice::Pcg(Preconditioner::BlockJacobi) => Method::BlockJacobi(BlockJacobi::new(pattern)),
            SolverChoice::Pcg(Preconditioner::Multigrid) => Method::Multigrid(Box::new(Multigrid::new(pattern, rest))),
            SolverChoice::Pcg(Preconditioner::Ssor) => Method::Ssor(Box::new(Ssor::new(pattern, rest))),
            SolverChoice::Pcg(Preconditioner::IncompleteCholesky) => {
                Method::IncompleteCholesky(IncompleteCholesky::new(pattern))
            }
        };
        let counters = Counters { symbolic_factorizations: 1, ..Counters::default() };
        Self {
            pattern: Arc::clone(pattern),
            method,
            work: Work::new(pattern.rows()),
            counters,
            preparing: Timer::default(),
            solving: Timer::default(),
        }
    }

    /// Computes the factor or the preconditioner of a matrix. After an error the preparation is of no use.
    pub fn prepare(&mut self, values: &[[[T; 3]; 3]]) -> Result<(), Breakdown> {
        self.counters.factorizations += 1;
        let Self { method, preparing, .. } = self;
        preparing.time(|| match method {
            Method::Cholesky(method) => method.prepare(values),
            Method::Lu(method) => method.prepare(values),
            Method::Cg => Ok(()),
            Method::BlockJacobi(method) => method.prepare(values),
            Method::Multigrid(method) => method.prepare(values),
            Method::IncompleteCholesky(method) => method.prepare(values),
            Method::Ssor(method) => method.prepare(values),
        })
    }

    /// Solves A x = b to ‖b − A x‖ ≤ `tolerance` ‖b‖, by the preparation of this matrix or of one that is close to it.
    ///
    /// Iterative methods start from the x that is given, direct ones from the factor's solution. What the preparation leaves is
    /// removed by conjugate gradients, with the preparation as preconditioner. After an error, x is the last iterate.
    pub fn solve(
        &mut self,
        values: &[[[T; 3]; 3]],
        b: &[[T; 3]],
        x: &mut [[T; 3]],
        tolerance: f64,
    ) -> Result<Solved, Breakdown> {
        let (rows, start) = (self.pattern.rows(), Instant::now());
        let solved = self.refine(values, &b[..rows], &mut x[..rows], tolerance);
        self.solving.add(start.elapsed());
        solved
    }

    fn refine(
        &mut self,
        values: &[[[T; 3]; 3]],
        b: &[[T; 3]],
        x: &mut [[T; 3]],
        tolerance: f64,
    ) -> Result<Solved, Breakdown> {
        self.counters.solves += 1;
        if matches!(self.method, Method::Cholesky(_) | Method::Lu(_)) {
            self.method.apply(b, x);
        }
        let Self { pattern, method, work, .. } = self;
        let A = |x: &[[T; 3]], y: &mut [[T; 3]]| product(pattern, values, x, y);
        // The largest entry of a positive definite matrix is on its diagonal.
        let entries = || pattern.diagonal().flat_map(|block| (0..3).map(move |i| values[block][i][i].as_f64().abs()));
        let size = || entries().fold(0.0, f64::max);
        let mut corrections = 0;
        if let Method::Ssor(method) = method {
            let correct = |r: &[[T; 3]], x: &mut [[T; 3]], tolerance: f64| method.correct(r, x, tolerance);
            let refined = refine(A, correct, b, x, tolerance, work)?;
            corrections = refined.iterations;
            if refined.done {
                self.counters.iterations += corrections;
                return Ok(Solved { iterations: corrections });
            }
        }
        let solved = conjugate_gradients(A, |r, z| method.apply(r, z), size, b, x, tolerance, work)?;
        let iterations = corrections + solved.iterations;
        self.counters.iterations += iterations;
        Ok(Solved { iterations })
    }

    /// z = P⁻¹ r, where P is what was prepared: the matrix itself as a factor, or the preconditioner.
    pub fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        let rows = self.pattern.rows();
        let Self { method, solving, .. } = self;
        solving.time(|| method.apply(&r[..rows], &mut z[..rows]));
    }

    /// Whether a solve iterates, on the matrix that it is given, and the preparation is a preconditioner only.
    pub fn is_iterative(&self) -> bool {
        !matches!(self.method, Method::Cholesky(_) | Method::Lu(_))
    }

    /// Whether the preparation is a copy of the matrix: of no use for another one.
    pub fn copies_matrix(&self) -> bool {
        matches!(self.method, Method::Ssor(_))
    }

    /// What it did so far.
    pub fn counters(&self) -> Counters {
        self.counters
    }

    /// How often it has prepared and solved, and for how long.
    pub fn meters(&self) -> (&Timer, &Timer) {
        (&self.preparing, &self.solving)
    }

    /// Whether a preconditioner is what it prepares.
    pub fn has_preconditioner(&self) -> bool {
        matches!(self.method, Method::BlockJacobi(_) | Method::IncompleteCholesky(_) | Method::Multigrid(_))
    }

    /// Bytes of what it prepares.
    pub fn prepared_bytes(&self) -> usize {
        self.bytes() - self.work.bytes()
    }

    /// Bytes that it holds, the pattern apart. Those of an LU factor are not counted: faer does not tell.
    pub fn bytes(&self) -> usize {
        let method = match &self.method {
            Method::Cholesky(method) => method.bytes(),
            Method::Lu(method) => method.bytes(),
            Method::Cg => 0,
            Method::BlockJacobi(method) => method.bytes(),
            Method::Multigrid(method) => method.bytes(),
            Method::IncompleteCholesky(method) => method.bytes(),
            Method::Ssor(method) => method.bytes(),
        };
        method + self.work.bytes()
    }
}

impl<T: Real> Method<T> {
    fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        match self {
            Method::Cholesky(method) => method.apply(r, z),
            Method::Lu(method) => method.apply(r, z),
            Method::Cg => z.copy_from_slice(r),
            Method::BlockJacobi(method) => method.apply(r, z),
            Method::Multigrid(method) => method.apply(r, z),
            Method::IncompleteCholesky(method) => method.apply(r, z),
            Method::Ssor(method) => method.apply(r, z),
        }
    }
}
