//! The tables of the numerical method: time steps, load steps, Newton's method, the linear solver, damping.

use serde::Deserialize;

use crate::Integrator;

/// `[time]`
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct TimeTable {
    /// Time step, s; optional for `static`.
    pub dt: Option<f64>,
    /// Time integration method.
    pub integrator: Integrator,
    /// Number of steps of a run without a window.
    pub steps: Option<usize>,
    /// Number of equal substeps in which each step is computed; 1 by default.
    pub substeps: Option<usize>,
    /// Computes each step in parts whose size follows an estimate of their error.
    pub adaptive: Option<AdaptiveTable>,
    /// Number type of the engine's computations.
    #[serde(default)]
    pub precision: Precision,
}

/// `adaptive` of `[time]`.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct AdaptiveTable {
    /// Largest estimated error of a displacement that one time step `dt` adds, as a part of the body's length.
    pub tolerance: f64,
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
    /// 4 bytes, 7 digits: enough for pictures, not for measurements.
    F32,
}

/// `[newton]`
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct NewtonTable {
    /// Largest number of iterations in a step.
    pub max_iterations: Option<usize>,
    /// Relative tolerance on the velocity update.
    pub tolerance: Option<f64>,
    /// Projection of element stiffnesses; [`Projection::WhenNeeded`] by default.
    pub projection: Option<Projection>,
    /// Whether steps that end before Newton's method has converged are good enough.
    #[serde(default)]
    pub accept_unconverged: bool,
}

/// The iterations of Newton's method in which element stiffnesses are projected to positive semi-definite ones.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Projection {
    /// Those whose exact matrix is not positive definite. Newton's method keeps its quadratic convergence.
    #[default]
    WhenNeeded,
    /// All. Every direction is a descent direction, and convergence is linear.
    Always,
    /// None. A matrix that is not positive definite ends the step with an error.
    Never,
}

/// `[iterations]`: the integrators `pbd`, `xpbd`, `vbd` and `projective_dynamics`.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct IterationsTable {
    /// Sweeps, or local–global rounds, in a step; 20 by default.
    pub count: Option<usize>,
    /// Relative change of the velocity in an iteration below which a step ends before `count` of them.
    pub tolerance: Option<f64>,
    /// Spectral radius of Chebyshev acceleration; none by default.
    pub acceleration: Option<f64>,
    /// Stiffness of the constraints of `pbd`, 0 to 1; 1 by default.
    pub stiffness: Option<f64>,
    /// Whether `xpbd` keeps the residual of the equation of motion, so that its iterations converge to implicit Euler; `true` by default.
    pub residual: Option<bool>,
    /// Whether steps that end before the iterations have settled are good enough.
    #[serde(default)]
    pub accept_unconverged: bool,
}

/// `[solver]`
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct SolverTable {
    /// The solver.
    pub kind: SolverKind,
    /// Relative residual of the iterative solvers.
    pub tolerance: Option<f64>,
    /// Preconditioner of `pcg`; [`Preconditioner::BlockJacobi`] by default.
    pub preconditioner: Option<Preconditioner>,
    /// Number type on the graphics device of `gpu`; [`Precision::F32`] by default.
    pub precision: Option<Precision>,
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
    SteepestDescent,
    ConjugateDirections,
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

/// `[damping]`: Rayleigh damping, the force −(α M + β K) v.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct DampingTable {
    /// α of the mass, 1/s. It damps low frequencies most.
    #[serde(default)]
    pub alpha: f64,
    /// β of the stiffness, s. It damps high frequencies most.
    #[serde(default)]
    pub beta: f64,
}

/// `[static]`: equilibrium by the integrator `static`.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct StaticTable {
    /// Number of equal load steps in which loads and prescribed motions are applied.
    pub load_steps: usize,
    /// Whether the load factor is an unknown, so that the equilibrium path is followed through its limit points.
    #[serde(default)]
    pub arc_length: bool,
}

/// `[newmark]`: parameters of the integrator `newmark`.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct NewmarkTable {
    /// β, part of the acceleration at the end of a step in its displacement; ¼ by default.
    pub beta: Option<f64>,
    /// γ, the same in its velocity; ½ by default.
    pub gamma: Option<f64>,
}

/// `[generalized_alpha]`: the parameter of the integrator `generalized_alpha`.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct GeneralizedAlphaTable {
    /// ρ∞, the factor by which a step changes the amplitude of infinitely fast vibrations; 0.8 by default.
    #[serde(alias = "rho_inf")]
    pub spectral_radius: Option<f64>,
}
