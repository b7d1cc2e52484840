//! Linear solvers and number types.

use serde::Deserialize;

/// Settings of the linear solver.
#[derive(Clone, Debug, PartialEq)]
pub struct SolverSettings {
    /// The solver.
    pub kind: SolverKind,
    /// Relative residual of the iterative solvers; `None` for the pipeline's default.
    pub tolerance: Option<f64>,
    /// Preconditioner of `pcg`.
    pub preconditioner: Preconditioner,
    /// Number type on the graphics device of `gpu`.
    pub precision: Precision,
}

/// Number type that the engine computes with.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Precision {
    /// 8 bytes, 16 digits.
    #[default]
    F64,
    /// 4 bytes, 7 digits: enough for pictures, not for measurements.
    F32,
}

/// Linear solvers.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum SolverKind {
    /// Sparse Cholesky factorization of a symmetric positive definite matrix.
    Cholesky,
    /// Sparse LU factorization.
    Lu,
    /// Conjugate gradients.
    Cg,
    /// Preconditioned conjugate gradients.
    Pcg,
    /// Steepest descent, for teaching.
    SteepestDescent,
    /// Conjugate directions, for teaching: the iterates of `cg` by Gram–Schmidt's method; it keeps every direction, and is refused for more
    /// than 1000 nodes.
    ConjugateDirections,
    /// Conjugate gradients on the graphics device.
    Gpu,
}

/// Preconditioners of the conjugate gradients.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Preconditioner {
    /// Block Jacobi: the inverse of each node's 3×3 block.
    #[default]
    BlockJacobi,
    /// A Cholesky factor with the sparsity pattern of the matrix.
    IncompleteCholesky,
    /// Multigrid by smoothed aggregation.
    Multigrid,
    /// SSOR, symmetric Gauss–Seidel sweeps, with a coarse grid; the iteration runs in single precision.
    Ssor,
}
