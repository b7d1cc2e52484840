//! Linear solvers and number types.

use serde::{Deserialize, Serialize};

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
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Precision {
    /// 8 bytes, 16 digits.
    #[default]
    F64,
    /// 4 bytes, 7 digits: enough for pictures, not for measurements.
    F32,
}

/// Linear solvers.
#[derive(Clone, Copy, Debug, Deserialize, Serialize, PartialEq, Eq)]
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
    /// Conjugate gradients on the graphics device.
    Gpu,
}

/// Preconditioners of the conjugate gradients.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Preconditioner {
    /// Block Jacobi: the inverse of each node's 3×3 block.
    #[default]
    BlockJacobi,
    /// Multigrid by smoothed aggregation.
    Multigrid,
    /// SSOR, symmetric Gauss–Seidel sweeps, with a coarse grid; the iteration runs in single precision.
    Ssor,
}

impl Precision {
    /// The name in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Self::F64 => "f64",
            Self::F32 => "f32",
        }
    }
}

impl SolverKind {
    /// All solvers, their names in scene files, and a description.
    pub const FACTS: [(Self, &'static str, &'static str); 5] = [
        (Self::Cholesky, "cholesky", "Cholesky factorisation, the symbolic part once"),
        (Self::Lu, "lu", "LU factorisation with pivoting inside blocks of rows"),
        (Self::Cg, "cg", "conjugate gradients"),
        (Self::Pcg, "pcg", "conjugate gradients"),
        (Self::Gpu, "gpu", "conjugate gradients on the graphics device"),
    ];

    /// The name in scene files.
    pub fn name(self) -> &'static str {
        Self::FACTS[self as usize].1
    }

    /// A description that begins in lower case.
    pub fn description(self) -> &'static str {
        Self::FACTS[self as usize].2
    }
}

impl Preconditioner {
    /// All preconditioners, their names in scene files, and what they are.
    pub const FACTS: [(Self, &'static str, &'static str); 3] = [
        (Self::BlockJacobi, "block_jacobi", "a block Jacobi preconditioner"),
        (Self::Multigrid, "multigrid", "a multigrid cycle"),
        (Self::Ssor, "ssor", "SSOR and a coarse grid, in single precision"),
    ];

    /// The name in scene files.
    pub fn name(self) -> &'static str {
        Self::FACTS[self as usize].1
    }

    /// A description with its article.
    pub fn description(self) -> &'static str {
        Self::FACTS[self as usize].2
    }
}
