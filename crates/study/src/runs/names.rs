//! Names of solvers in tables.

use fem_scene::Scene;

/// The solver of a scene, or `automatic`.
pub fn solver_name(scene: &Scene) -> String {
    let Some(solver) = &scene.solver else { return "automatic".to_owned() };
    let preconditioner =
        solver.preconditioner.map_or(String::new(), |preconditioner| format!(" {}", preconditioner.name()));
    format!("{}{preconditioner}", solver.kind.name())
}
