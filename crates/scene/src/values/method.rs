//! The numerical method of a scene, and the damping of a body.

use crate::tables::{DampingForm, IterationsTable, NewtonTable, SolverTable};
use crate::{Integrator, Precision, Preconditioner, Projection, Scene, SolverKind};

/// Settings of `[time]`, `[static]`, `[newmark]`, `[generalized_alpha]`, `[iterations]`, `[newton]`, `[solver]` and `[energy]`.
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
    /// Linear solver; `None` if the scene leaves the choice to the pipeline.
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

impl IterationSettings {
    fn new(table: &IterationsTable) -> Self {
        Self {
            count: table.count.unwrap_or(20),
            tolerance: table.tolerance,
            acceleration: table.acceleration,
            stiffness: table.stiffness.unwrap_or(1.0),
            residual: table.residual.unwrap_or(true),
            accept_unconverged: table.accept_unconverged,
        }
    }
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

impl Method {
    /// Returns true if a run may end with steps that have not converged.
    pub fn accepts_unconverged(&self) -> bool {
        if self.integrator.is_iterated() { self.iterations.accept_unconverged } else { self.newton.accept_unconverged }
    }
}

impl Scene {
    /// The numerical method, defaults filled in.
    pub fn method(&self) -> Method {
        let newton = |table: &NewtonTable| NewtonSettings {
            max_iterations: table.max_iterations,
            tolerance: table.tolerance,
            projection: table.projection.unwrap_or_default(),
            accept_unconverged: table.accept_unconverged,
        };
        let solver = |&SolverTable { kind, tolerance, preconditioner, precision }: &SolverTable| SolverSettings {
            kind,
            tolerance,
            preconditioner: preconditioner.unwrap_or_default(),
            precision: precision.unwrap_or(Precision::F32),
        };
        Method {
            integrator: self.time.integrator,
            dt: self.time.dt(),
            substeps: self.time.substeps.unwrap_or(1),
            adaptive: self.time.adaptive.map(|table| table.tolerance),
            precision: self.time.precision,
            load_steps: self.statics.as_ref().map_or(1, |statics| statics.load_steps),
            arc_length: self.statics.as_ref().is_some_and(|statics| statics.arc_length),
            newmark: NewmarkParameters {
                beta: self.newmark.as_ref().and_then(|table| table.beta).unwrap_or(0.25),
                gamma: self.newmark.as_ref().and_then(|table| table.gamma).unwrap_or(0.5),
            },
            rho_inf: self.generalized_alpha.as_ref().and_then(|table| table.spectral_radius).unwrap_or(0.8),
            iterations: IterationSettings::new(self.iterations.as_ref().unwrap_or(&IterationsTable::default())),
            newton: self.newton.as_ref().map(newton).unwrap_or_default(),
            accept_gain: self.energy.is_some_and(|energy| energy.accept_gain),
            solver: self.solver.as_ref().map(solver),
        }
    }
}

impl Scene {
    /// Makes each substep a step of its own: the same motion, for those who compare time steps.
    pub fn make_substeps_steps(&mut self) {
        let time = &mut self.time;
        let Some(substeps) = time.substeps.take() else { return };
        time.dt = time.dt.map(|dt| dt / substeps as f64);
        time.steps = time.steps.map(|steps| steps * substeps);
    }
}

/// The damping of `[damping]`; `None` if both coefficients are zero.
pub(crate) fn damping(scene: &Scene) -> Option<Damping> {
    let damping =
        scene.damping.as_ref().map(|table| Damping { alpha: table.alpha, beta: table.beta, form: table.form });
    damping.filter(|damping| damping.alpha > 0.0 || damping.beta > 0.0)
}
