//! Names of methods and solvers in tables.

use fem_model::{Integrator, Preconditioner, SolverKind};
use fem_scene::Scene;

/// Name of an integrator in prose.
pub fn name(integrator: Integrator) -> &'static str {
    match integrator {
        Integrator::ExplicitEuler => "explicit Euler",
        Integrator::SemiImplicitEuler => "semi-implicit Euler",
        Integrator::Rk2 => "RK2",
        Integrator::Rk4 => "RK4",
        Integrator::Verlet => "Verlet",
        Integrator::LinearlyImplicitEuler => "linearly implicit Euler",
        Integrator::ImplicitEuler => "implicit Euler",
        Integrator::ImplicitMidpoint => "implicit midpoint",
        Integrator::Newmark => "Newmark",
        Integrator::GeneralizedAlpha => "generalized-α",
        Integrator::Bdf2 => "BDF2",
        Integrator::Pbd => "PBD",
        Integrator::Xpbd => "XPBD",
        Integrator::Vbd => "VBD",
        Integrator::ProjectiveDynamics => "projective dynamics",
        Integrator::Static => "static",
    }
}

/// The solver of a scene, or `automatic`.
pub fn solver_name(scene: &Scene) -> String {
    let Some(solver) = &scene.solver else { return "automatic".to_owned() };
    let kind = match solver.kind {
        SolverKind::Cholesky => "cholesky",
        SolverKind::Lu => "lu",
        SolverKind::Cg => "cg",
        SolverKind::Pcg => "pcg",
        SolverKind::SteepestDescent => "steepest_descent",
        SolverKind::ConjugateDirections => "conjugate_directions",
        SolverKind::Gpu => "gpu",
    };
    let preconditioner = match solver.preconditioner {
        Some(Preconditioner::BlockJacobi) => " block_jacobi",
        Some(Preconditioner::IncompleteCholesky) => " incomplete_cholesky",
        Some(Preconditioner::Multigrid) => " multigrid",
        Some(Preconditioner::Ssor) => " ssor",
        None => "",
    };
    format!("{kind}{preconditioner}")
}
