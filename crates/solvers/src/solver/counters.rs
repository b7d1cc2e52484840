//! Counters of a solver.

/// Operations that a solver has carried out.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct SolverCounters {
    /// Analyses of a sparsity pattern.
    pub symbolic_factorizations: usize,
    /// Computations of a factor or a preconditioner.
    pub factorizations: usize,
    /// Linear systems.
    pub solves: usize,
    /// Iterations of all solves.
    pub iterations: usize,
    /// Matrices that were factored because the iterative solver broke down.
    pub fallbacks: usize,
}
