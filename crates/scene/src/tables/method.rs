//! The tables of the numerical method: time steps, load steps, Newton's method, the linear solver, damping.

use serde::Deserialize;

use crate::Integrator;

/// `[time]`
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct TimeTable {
    /// Time step, s; optional for `static`.
    pub dt: Option<f64>,
    /// Method that advances a step.
    pub integrator: Integrator,
    /// Steps of a run without a window.
    pub steps: Option<usize>,
    /// Number type of the engine.
    #[serde(default)]
    pub precision: Precision,
}

impl TimeTable {
    /// The time step, s; 1 if `static` has none, so that the time counts the load steps.
    pub fn dt(&self) -> f64 {
        self.dt.unwrap_or(1.0)
    }
}

/// Number type that the engine computes with.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Precision {
    /// 8 bytes, 16 digits.
    #[default]
    F64,
    /// 4 bytes, 7 digits: for pictures, not for measurements.
    F32,
}

/// `[newton]`
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct NewtonTable {
    /// Largest number of iterations in a step.
    pub max_iterations: Option<usize>,
    /// Relative tolerance on the velocity update.
    pub tolerance: Option<f64>,
    /// Which stiffnesses are projected; [`Projection::WhenNeeded`] where it is left out.
    pub projection: Option<Projection>,
}

/// When the stiffness of an element is made positive semi-definite.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Projection {
    /// Only where the exact matrix cannot be factorised: Newton's method stays quadratic.
    #[default]
    WhenNeeded,
    /// In every iteration: each direction leads downhill, and convergence is linear.
    Always,
    /// In none: a matrix that is not positive definite ends the step.
    Never,
}

/// `[solver]`
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct SolverTable {
    /// Which solver.
    pub kind: SolverKind,
    /// Relative residual of the iterative ones.
    pub tolerance: Option<f64>,
    /// What `pcg` multiplies residuals by; [`Preconditioner::BlockJacobi`] where it is left out.
    pub preconditioner: Option<Preconditioner>,
}

/// Linear solvers.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
#[allow(missing_docs)] // the names are the field's
pub enum SolverKind {
    Cholesky,
    Lu,
    Cg,
    Pcg,
}

/// Preconditioners of the conjugate gradients.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Preconditioner {
    /// The inverse of each node's 3×3 block.
    #[default]
    BlockJacobi,
    /// A Cholesky factor that keeps the matrix's own pattern.
    IncompleteCholesky,
    /// A hierarchy of coarser matrices.
    Multigrid,
    /// Symmetric sweeps of Gauss and Seidel, in single precision.
    Ssor,
}

/// `[damping]`: Rayleigh's, a force −(α M + β K) v.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct DampingTable {
    /// α of the mass, 1/s: damps slow motions most.
    #[serde(default)]
    pub alpha: f64,
    /// β of the stiffness, s: damps fast motions most.
    #[serde(default)]
    pub beta: f64,
}

/// `[static]`: equilibrium by the integrator `static`.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct StaticTable {
    /// Equal parts in which loads and prescribed motions are applied, a step each.
    pub load_steps: usize,
}
