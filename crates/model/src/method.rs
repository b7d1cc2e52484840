//! The numerical method, and the damping of a body.

use serde::{Deserialize, Serialize};

use crate::numbers::{check_finite, check_positive, problem};
use crate::{Integrator, Precision, Refusal, SolverSettings};

/// The numerical method: time integration, Newton's method, linear solver.
#[derive(Clone, Debug, PartialEq)]
pub struct Method {
    /// Time integration method.
    pub integrator: Integrator,
    /// Time step, s; 1 for `static` without one.
    pub dt: f64,
    /// Equal substeps in which each step is computed.
    pub substeps: usize,
    /// Tolerance of adaptive steps: the largest estimated error of a displacement that one time step adds, as a part of the body's
    /// length; `None` for steps of one size.
    pub adaptive: Option<f64>,
    /// Number type.
    pub precision: Precision,
    /// Equal parts in which `static` applies loads and prescribed motions.
    pub load_steps: usize,
    /// True if `static` follows the equilibrium path by arc length.
    pub arc_length: bool,
    /// β and γ of `newmark`.
    pub newmark: NewmarkParameters,
    /// Spectral radius ρ∞ of `generalized_alpha`.
    pub rho_inf: f64,
    /// Iterations of `pbd`, `xpbd`, `vbd` and `projective_dynamics`.
    pub iterations: IterationSettings,
    /// Newton's method.
    pub newton: NewtonSettings,
    /// True if a gain of energy does not end a run.
    pub accept_gain: bool,
    /// Linear solver; `None` for one that suits the size of the body.
    pub solver: Option<SolverSettings>,
}

/// Parameters of Newmark's method.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct NewmarkParameters {
    /// Part of the acceleration at the end of a step in its displacement.
    pub beta: f64,
    /// The same in its velocity.
    pub gamma: f64,
}

impl NewmarkParameters {
    /// Returns true if the method is stable at any time step: 2β ≥ γ.
    pub fn is_unconditionally_stable(self) -> bool {
        2.0 * self.beta >= self.gamma
    }
}

/// Settings of the iterated methods.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct IterationSettings {
    /// Largest number of sweeps, or of local–global rounds, in a step.
    pub count: usize,
    /// Relative change of the velocity in an iteration at which a step ends; `None` for steps of `count` iterations.
    pub tolerance: Option<f64>,
    /// Spectral radius of Chebyshev acceleration.
    pub acceleration: Option<f64>,
    /// Stiffness of the constraints of `pbd`, 0 to 1.
    pub stiffness: f64,
    /// True if `xpbd` keeps the residual of the equation of motion.
    pub residual: bool,
    /// True if steps that end before the iterations have settled are accepted.
    pub accept_unconverged: bool,
}

/// Settings of Newton's method; those that are `None` have a default that depends on the integrator.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct NewtonSettings {
    /// Largest number of iterations in a step.
    pub max_iterations: Option<usize>,
    /// Relative tolerance on the velocity update.
    pub tolerance: Option<f64>,
    /// Projection of element stiffnesses.
    pub projection: Projection,
    /// True if steps that end before Newton's method has converged are accepted.
    pub accept_unconverged: bool,
}

/// Damping in proportion to the mass and the stiffness: the force −(α M + β K) v of small motions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Damping {
    /// α of the mass, 1/s.
    pub alpha: f64,
    /// β of the stiffness, s.
    pub beta: f64,
    /// The form of the force of β.
    pub form: DampingForm,
}

impl Default for IterationSettings {
    fn default() -> Self {
        Self {
            count: 20,
            tolerance: None,
            acceleration: None,
            stiffness: 1.0,
            residual: true,
            accept_unconverged: false,
        }
    }
}

impl Method {
    /// A method with steps of `dt`, s, and the default of every setting; load steps of `static` count as seconds.
    pub fn new(integrator: Integrator, dt: f64) -> Self {
        Self {
            integrator,
            dt,
            substeps: 1,
            adaptive: None,
            precision: Precision::F64,
            load_steps: 1,
            arc_length: false,
            newmark: NewmarkParameters { beta: 0.25, gamma: 0.5 },
            rho_inf: 0.8,
            iterations: IterationSettings::default(),
            newton: NewtonSettings::default(),
            accept_gain: false,
            solver: None,
        }
    }

    /// Refuses numbers with which no step can be computed.
    pub fn check(&self) -> Result<(), Refusal> {
        check_positive("time.dt", self.dt, " of seconds")?;
        for (field, count) in [("time.substeps", self.substeps), ("static.load_steps", self.load_steps)] {
            if count == 0 {
                return problem(field, "is 0; give at least one");
            }
        }
        let tolerances = [
            ("time.adaptive.tolerance", self.adaptive),
            ("newton.tolerance", self.newton.tolerance),
            ("iterations.tolerance", self.iterations.tolerance),
            ("solver.tolerance", self.solver.as_ref().and_then(|solver| solver.tolerance)),
        ];
        for (field, tolerance) in tolerances {
            // NaN fails the comparison.
            if let Some(tolerance) = tolerance.filter(|tolerance| !(*tolerance > 0.0 && *tolerance < 1.0)) {
                return problem(field, format!("is {tolerance}; give a number above 0 and below 1"));
            }
        }
        check_finite("newmark", &[self.newmark.beta, self.newmark.gamma])?;
        match (0.0..=1.0).contains(&self.rho_inf) {
            true => Ok(()),
            false => {
                problem("generalized_alpha.spectral_radius", format!("is {}; give a number from 0 to 1", self.rho_inf))
            }
        }
    }

    /// Returns true if a run may end with steps that have not converged.
    pub fn accepts_unconverged(&self) -> bool {
        if self.integrator.is_iterated() { self.iterations.accept_unconverged } else { self.newton.accept_unconverged }
    }
}

/// The iterations of Newton's method in which element stiffnesses are projected to positive semi-definite ones.
#[derive(Clone, Copy, Debug, Default, Deserialize, Serialize, PartialEq, Eq)]
#[serde(rename_all = "snake_case")]
pub enum Projection {
    /// The iterations whose exact matrix is not positive definite. Newton's method keeps its quadratic convergence.
    #[default]
    WhenNeeded,
    /// All iterations. Every direction is a descent direction, and convergence is linear.
    Always,
    /// No iteration. A matrix that is not positive definite ends the step with an error.
    Never,
}

/// The force of β, which is −β K v in small motions about the undeformed body.
#[derive(Clone, Copy, Debug, Default, Deserialize, Eq, PartialEq)]
#[serde(rename_all = "snake_case")]
pub enum DampingForm {
    /// The stress β (2μ U̇ + λ tr(U̇) 1) of the rate of the stretch, with the elastic moduli of small strain; along springs their
    /// stiffness. It depends on no rotation and brakes none.
    #[default]
    KelvinVoigt,
    /// Rayleigh's −β K(u) v with the stiffness matrix of the deformed body: linear in the velocities, also in those of a rotation, which
    /// it brakes where the body is stressed.
    Rayleigh,
}
