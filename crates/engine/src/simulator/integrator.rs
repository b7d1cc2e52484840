//! The integrator that a scene names, with its limits and its linear solver.

use fem_model::{Body, Integrator as IntegratorKind, Method};

use super::Simulator;
use crate::forces::contact::planes::Planes;
use crate::integrators::{self, Integrator, Parts};
use crate::model::system::System;
use crate::newton::{Newton, NewtonLimits};
use crate::simulator::device_assembly;
#[cfg(feature = "gpu")]
use crate::simulator::device_elements;
use fem_solvers::{Preconditioner, Real, Solver, SolverChoice, factor_fits};

/// Smallest relative residual that a linear solver can be asked for, in units of the machine epsilon.
const SMALLEST_RESIDUAL: f64 = 8.0;

/// Relative tolerance of Newton's method on the update where the scene gives none.
const TOLERANCE: f64 = 1e-10;

/// The smallest one that rounding error lets an update reach, in units of the machine epsilon.
pub(super) const SMALLEST_TOLERANCE: f64 = 8.0;

/// Largest relative residual of a useful direction of Newton's method.
const LARGEST_RESIDUAL: f64 = 0.05;

/// Largest number of Newton iterations in a time step, and in a load step: a body that buckles moves far.
const MOST_ITERATIONS: (usize, usize) = (200, 2000);

/// Number of nodes up to which a factor is cheaper than iterations where the scene names no solver: in motion, where inertia keeps
/// iterations few, and in equilibrium. There a cantilever of 5 265 nodes takes three times as long by a factor if ν = 0.3, as long if ν = 0.49, and
/// half as long if ν = 0.499.
const DIRECT: (usize, usize) = (2000, 5000);

/// Poisson's ratio above which multigrid needs hundreds of iterations: its smoother cannot tell changes of volume from others.
const NEARLY_INCOMPRESSIBLE: f64 = 0.49;

/// The solver that the scene names, or the one that suits the body.
pub(super) fn solver_choice(method: &Method, body: &Body) -> SolverChoice {
    let nodes = body.shape.mesh.vertices().len();
    let regions = body.regions.iter().map(|region| &region.material);
    let mut ratios = regions.chain([&body.material]).filter_map(|material| material.law.poissons_ratio());
    let suits_factor = ratios.any(|ratio| ratio > NEARLY_INCOMPRESSIBLE) && factor_fits(nodes);
    let is_static = method.integrator == IntegratorKind::Static;
    match &method.solver {
        // All rounds of all steps have the same matrix.
        _ if method.integrator == IntegratorKind::ProjectiveDynamics => SolverChoice::Cholesky,
        Some(settings) => settings.into(),
        // The order of its rows is that of the factor with the pressures.
        None if body.has_pressures() => SolverChoice::Cholesky,
        // Beyond a limit point the matrix is not positive definite.
        None if is_static && method.arc_length => SolverChoice::Lu,
        None if nodes <= if is_static { DIRECT.1 } else { DIRECT.0 } => SolverChoice::Cholesky,
        None if is_static && suits_factor => SolverChoice::Cholesky,
        // With inertia the cheapest preconditioner needs few iterations; in equilibrium only multigrid does.
        None if is_static => SolverChoice::Pcg(Preconditioner::Multigrid),
        None => SolverChoice::Pcg(Preconditioner::Ssor),
    }
}

/// Builds the integrator that a running simulation is switched to. An explicit scene has no pattern until an implicit method needs one.
fn switched<T: Real>(
    kind: IntegratorKind,
    method: &Method,
    system: &mut System<T>,
    choice: SolverChoice,
    planes: Option<&Planes>,
) -> Box<dyn Integrator<T>> {
    if kind.has_matrix() && !system.has_pattern() {
        system.prepare_matrix(choice);
    }
    build(kind, method, system, choice, planes)
}

/// Builds an integrator with the parts that it needs.
pub(super) fn build<T: Real>(
    kind: IntegratorKind,
    method: &Method,
    system: &System<T>,
    choice: SolverChoice,
    planes: Option<&Planes>,
) -> Box<dyn Integrator<T>> {
    let solver = || system.solver(choice);
    let tolerance = method.solver.as_ref().and_then(|solver| solver.tolerance).unwrap_or(1e-12);
    let tolerance = tolerance.max(SMALLEST_RESIDUAL * T::EPSILON.as_f64());
    let newton = || {
        let limits = limits::<T>(kind, method, tolerance);
        if let Some(newton) = Newton::with_pressures(limits, system) {
            return newton;
        }
        // Inertia bounds the condition number, and a linear body needs one direction alone.
        let solver = if kind == IntegratorKind::Static && system.may_be_linear() {
            // No dead load makes this matrix indefinite.
            solver().with_direct_fallback()
        } else if kind == IntegratorKind::Static || system.may_be_linear() {
            solver()
        } else {
            system.solver_for_directions(choice)
        };
        let is_on_device = matches!(choice, SolverChoice::Gpu(_));
        let is_assembled_there = is_on_device && device_assembly::is_possible(kind, method, system);
        let solver = if is_assembled_there { with_elements(solver, system) } else { solver };
        Newton::new(limits, solver, system.nodes(), system.pattern.blocks())
    };
    let parts = Parts { method, system, planes, solver: &solver, newton: &newton, tolerance };
    integrators::build(kind, &parts)
}

/// Gives the elements to a solver on a graphics device.
#[cfg(feature = "gpu")]
fn with_elements<T: Real>(mut solver: Solver<T>, system: &System<T>) -> Solver<T> {
    solver.set_elements(&device_elements::elements(system));
    solver
}

/// Without the feature `gpu` there is no such solver.
#[cfg(not(feature = "gpu"))]
fn with_elements<T: Real>(solver: Solver<T>, _system: &System<T>) -> Solver<T> {
    solver
}

/// The scene's limits of Newton's method, or the defaults.
fn limits<T: Real>(kind: IntegratorKind, method: &Method, solver_tolerance: f64) -> NewtonLimits {
    let most = if kind == IntegratorKind::Static { MOST_ITERATIONS.1 } else { MOST_ITERATIONS.0 };
    NewtonLimits {
        max_iterations: method.newton.max_iterations.unwrap_or(most),
        tolerance: method.newton.tolerance.unwrap_or(TOLERANCE.max(SMALLEST_TOLERANCE * T::EPSILON.as_f64())),
        projection: method.newton.projection,
        solver_tolerance: solver_tolerance.min(LARGEST_RESIDUAL),
    }
}

impl<T: Real> Simulator<T> {
    /// Goes on with the next method that can treat the body.
    pub(super) fn switch_integrator(&mut self) {
        let method = self.method.integrator;
        // Another treatment of obstacles would need other distances.
        let treatment = self.contact.as_ref().map(|_| method.facts().contact);
        let has_pressures = self.system.forces.mixed().is_some();
        let is_usable = |kind: &IntegratorKind| {
            treatment.is_none_or(|treatment| kind.facts().contact == treatment)
                && (!has_pressures || kind.has_newton() && !kind.facts().is_balanced_within_step)
        };
        let methods: Vec<_> = method.alternatives().into_iter().filter(is_usable).collect();
        self.kind = self.kind.next_in(&methods);
        let planes = self.contact.as_ref().map(|contact| contact.planes());
        self.integrator = switched(self.kind, &self.method, &mut self.system, self.solver, planes);
    }
}
