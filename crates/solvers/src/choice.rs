//! The linear solvers that a simulation can choose from, and the facts about each.

use std::fmt;

pub use fem_model::Preconditioner;

use crate::numbering::Ordering;
use fem_elements::sparse::Stored;
use fem_model::{Precision, SolverKind, SolverSettings};

/// A method to solve linear systems.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum SolverChoice {
    /// Cholesky factorisation A = L Lᵀ.
    Cholesky,
    /// LU factorisation with pivoting inside blocks of rows.
    Lu,
    /// Conjugate gradients.
    Cg,
    /// Preconditioned conjugate gradients.
    Pcg(Preconditioner),
    /// Conjugate gradients on a graphics device, in this precision.
    Gpu(Precision),
}

impl SolverChoice {
    /// The blocks that the pattern of its matrices must store.
    pub fn stored(self) -> Stored {
        match self {
            Self::Cholesky | Self::Pcg(Preconditioner::Ssor | Preconditioner::Multigrid) => Stored::Lower,
            Self::Lu | Self::Cg | Self::Pcg(_) | Self::Gpu(_) => Stored::Full,
        }
    }

    /// The ordering of the rows that suits it.
    pub fn ordering(self) -> Ordering {
        match self {
            Self::Cholesky | Self::Lu => Ordering::FillReducing,
            Self::Cg | Self::Pcg(_) | Self::Gpu(_) => Ordering::Parts,
        }
    }

    /// Returns true if a solve iterates with the matrix that it is given.
    pub fn is_iterative(self) -> bool {
        !matches!(self, Self::Cholesky | Self::Lu)
    }

    /// Returns true if the solver prepares a preconditioner.
    pub fn has_preconditioner(self) -> bool {
        matches!(self, Self::Pcg(_) | Self::Gpu(_))
    }

    /// Returns true if the iteration runs on a copy of the matrix, mostly in single precision, inside an iterative refinement.
    pub(crate) fn copies_matrix(self) -> bool {
        matches!(self, Self::Pcg(Preconditioner::Ssor) | Self::Gpu(_))
    }
}

impl From<&SolverSettings> for SolverChoice {
    fn from(settings: &SolverSettings) -> Self {
        match settings.kind {
            SolverKind::Cholesky => Self::Cholesky,
            SolverKind::Lu => Self::Lu,
            SolverKind::Cg => Self::Cg,
            SolverKind::Pcg => Self::Pcg(settings.preconditioner),
            SolverKind::Gpu => Self::Gpu(settings.precision),
        }
    }
}

impl fmt::Display for SolverChoice {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Cholesky => f.write_str(SolverKind::Cholesky.description()),
            Self::Lu => f.write_str(SolverKind::Lu.description()),
            Self::Cg => f.write_str(SolverKind::Cg.description()),
            Self::Gpu(precision) => {
                let digits = if *precision == Precision::F32 { "single" } else { "double" };
                write!(f, "{}, in {digits} precision", SolverKind::Gpu.description())
            }
            Self::Pcg(preconditioner) => {
                write!(f, "{} with {}", SolverKind::Pcg.description(), preconditioner.description())
            }
        }
    }
}
