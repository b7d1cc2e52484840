//! The tables of the numerical method: time steps, load steps, Newton's method, the linear solver, damping.

use fem_model::{DampingForm, Integrator, Precision, Preconditioner, Projection, SolverKind};
use serde::{Deserialize, Serialize};

/// `[time]`: the time integration method and its steps.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct TimeTable {
    /// Time step, s; positive. Required by every method but `static`. Default: 1 with `static`, so that the time counts the load steps.
    pub dt: Option<f64>,
    /// Time integration method. The pipeline `"course"` has `"linearly_implicit_euler"` and `"implicit_euler"`.
    pub integrator: Integrator,
    /// Number of steps of a run without a window, at least 1. Default: 100; with `static` the number of `load_steps`, after
    /// which loads without a curve stay.
    pub steps: Option<usize>,
    /// Number of equal substeps in which each step is computed, 1 to 100 000; not with `static` and `adaptive`. Statistics, tables, exports
    /// and pictures are those of whole steps. Engine only. Default: 1.
    pub substeps: Option<usize>,
    /// Adaptive steps: each step is computed in parts whose size follows an estimate of their error. Implicit methods of second order
    /// only, and `newmark` with `gamma = 0.5`. Engine only. Default: none.
    pub adaptive: Option<AdaptiveTable>,
    /// Number type of the engine's computations. Engine only.
    #[serde(default)]
    pub precision: Precision,
}

/// `adaptive`: adaptive steps.
#[derive(Clone, Copy, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct AdaptiveTable {
    /// Largest estimated error of a displacement that one time step `dt` adds, as a part of the body's length; above 0 and below 1.
    pub tolerance: f64,
}

impl TimeTable {
    /// The time step, s; 1 if `static` has none, so that the time counts the load steps.
    pub fn dt(&self) -> f64 {
        self.dt.unwrap_or(1.0)
    }
}

/// `[newton]`: Newton's method of `implicit_euler`, of the implicit methods of second order, and of `static`. Engine only.
#[derive(Clone, Debug, Default, Deserialize, Serialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct NewtonTable {
    /// Largest number of iterations in a step, at least 1. Default: 200; 2000 with `static`.
    pub max_iterations: Option<usize>,
    /// Relative tolerance on the update, above 0 and below 1. Default: 1e-10; 1e-6 in single precision.
    pub tolerance: Option<f64>,
    /// Projection of element stiffnesses to positive semi-definite ones. Default: `"when_needed"`.
    pub projection: Option<Projection>,
    /// True if a run ends with exit code 0 although Newton's method has not converged in some of its steps.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub accept_unconverged: bool,
}

/// `[energy]`: the energy ledger of a run. Engine only.
#[derive(Clone, Copy, Debug, Default, Deserialize, PartialEq, Eq)]
#[serde(deny_unknown_fields)]
pub struct EnergyTable {
    /// True if a run goes on although the body has gained more energy than 5 % of what initial state, loads, prescribed motions and planes
    /// have supplied.
    #[serde(default)]
    pub accept_gain: bool,
}

/// `[iterations]`: the iterations of the integrators `pbd`, `xpbd`, `vbd` and `projective_dynamics`. Engine only.
#[derive(Clone, Debug, Default, Deserialize, Serialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct IterationsTable {
    /// Number of sweeps, or of local–global rounds, in a step, 1 to 1 000 000. Default: 20.
    pub count: Option<usize>,
    /// Relative change of the velocity in an iteration below which a step ends before `count` of them; above 0 and below 1. Default: none.
    pub tolerance: Option<f64>,
    /// Spectral radius of Chebyshev acceleration of `vbd`, from 0 to below 1. Default: none.
    pub acceleration: Option<f64>,
    /// Stiffness of the constraints of `pbd`, 0 to 1. Default: 1.
    pub stiffness: Option<f64>,
    /// True if `xpbd` keeps the residual of the equation of motion, so that its iterations converge to implicit Euler; without it sweeps are
    /// cheaper and converge elsewhere. Default: `true`.
    pub residual: Option<bool>,
    /// True if a run ends with exit code 0 although the iterations of some of its steps have not settled.
    #[serde(default, skip_serializing_if = "std::ops::Not::not")]
    pub accept_unconverged: bool,
}

/// `[solver]`: the linear solver of implicit methods and of `static`. Engine only.
///
/// Without the table the engine takes `cholesky` up to 2000 nodes (`static`: 5000), and beyond them `pcg` with `ssor` (`static`:
/// `multigrid`).
#[derive(Clone, Debug, Deserialize, Serialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct SolverTable {
    /// Linear solver.
    pub kind: SolverKind,
    /// Relative residual at which the iterative solvers end, above 0 and below 1. Default: 1e-12.
    pub tolerance: Option<f64>,
    /// Preconditioner of `pcg`; with this kind only. Default: `"block_jacobi"`.
    pub preconditioner: Option<Preconditioner>,
    /// Number type on the graphics device of `gpu`; with this kind only. Default: `"f32"`.
    pub precision: Option<Precision>,
}

/// `[damping]`: the force −α M v, and a stress β times the rate of the elastic one. Engine only, and not with `static`.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct DampingTable {
    /// Factor α of the mass, 1/s; at least 0. It damps low frequencies most.
    #[serde(default)]
    pub alpha: f64,
    /// Factor β of the stiffness, s; at least 0. It damps high frequencies most.
    #[serde(default)]
    pub beta: f64,
    /// Form of the force of β: `kelvin_voigt` does no work on rigid motions, `rayleigh` brakes a body that spins.
    #[serde(default)]
    pub form: DampingForm,
}

/// `[static]`: the load steps of the integrator `static`. Engine only.
///
/// Without the table there is one load step.
#[derive(Clone, Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct StaticTable {
    /// Number of equal load steps in which loads and prescribed motions grow, one per step; at least 1.
    pub load_steps: usize,
    /// True if the load factor is an unknown, so that the equilibrium path goes on through its limit points; `load_steps` then sets the
    /// length of the first step.
    #[serde(default)]
    pub arc_length: bool,
}

/// `[newmark]`: parameters of the integrator `newmark`. Engine only.
///
/// The defaults are the trapezoidal rule. With 2 `beta` < `gamma` the method has a critical time step.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct NewmarkTable {
    /// Part β of the acceleration at the end of a step in its displacement, 1/12 to 1; `0.083333333333` has the most accurate periods.
    /// Default: 0.25.
    pub beta: Option<f64>,
    /// Part γ of that acceleration in the velocity, 0.5 to 1. Default: 0.5.
    pub gamma: Option<f64>,
}

/// `[generalized_alpha]`: the parameter of the integrator `generalized_alpha`. Engine only.
#[derive(Clone, Debug, Default, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
pub struct GeneralizedAlphaTable {
    /// Spectral radius ρ∞, 0 to 1: the part of the amplitude that a step leaves of infinitely fast vibrations. Older scenes
    /// call it `rho_inf`. Default: 0.8.
    #[serde(alias = "rho_inf")]
    pub spectral_radius: Option<f64>,
}
