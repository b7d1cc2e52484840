//! The numerical method of a scene, and the damping of its body.

use fem_model::{
    Damping, Integrator, IterationSettings, Method, NewmarkParameters, NewtonSettings, Precision, SolverSettings,
};

use crate::Scene;
use crate::tables::{IterationsTable, NewtonTable, SolverTable};

/// Number of steps without a window, if neither the scene nor the arguments give one.
const DEFAULT_STEPS: usize = 100;

impl Scene {
    /// The number of steps; by default that of its load steps if it is static.
    pub fn steps(&self) -> usize {
        let default = match self.time.integrator {
            Integrator::Static => self.method().load_steps,
            _ => DEFAULT_STEPS,
        };
        self.time.steps.unwrap_or(default)
    }

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
        let default = Method::new(self.time.integrator, self.time.dt());
        Method {
            substeps: self.time.substeps.unwrap_or(default.substeps),
            adaptive: self.time.adaptive.map(|table| table.tolerance),
            precision: self.time.precision,
            load_steps: self.statics.as_ref().map_or(default.load_steps, |statics| statics.load_steps),
            arc_length: self.statics.as_ref().is_some_and(|statics| statics.arc_length),
            newmark: NewmarkParameters {
                beta: self.newmark.as_ref().and_then(|table| table.beta).unwrap_or(default.newmark.beta),
                gamma: self.newmark.as_ref().and_then(|table| table.gamma).unwrap_or(default.newmark.gamma),
            },
            rho_inf: self.generalized_alpha.as_ref().and_then(|table| table.spectral_radius).unwrap_or(default.rho_inf),
            iterations: self.iterations.as_ref().map(iterations).unwrap_or_default(),
            newton: self.newton.as_ref().map(newton).unwrap_or_default(),
            accept_gain: self.energy.is_some_and(|energy| energy.accept_gain),
            solver: self.solver.as_ref().map(solver),
            ..default
        }
    }

    /// Returns true if the mass matrix of a body with so many nodes is lumped: as the scene says, or by the method's default.
    pub fn lumps_mass(&self, nodes: usize) -> bool {
        let by_default = self.time.integrator.lumps_mass(nodes, !self.planes.is_empty());
        self.mass.lumped.unwrap_or(by_default)
    }

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

fn iterations(table: &IterationsTable) -> IterationSettings {
    let default = IterationSettings::default();
    IterationSettings {
        count: table.count.unwrap_or(default.count),
        tolerance: table.tolerance,
        acceleration: table.acceleration,
        stiffness: table.stiffness.unwrap_or(default.stiffness),
        residual: table.residual.unwrap_or(default.residual),
        accept_unconverged: table.accept_unconverged,
    }
}
