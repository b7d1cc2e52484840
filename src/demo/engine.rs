//! Scenes that the engine runs.

use fem_engine::cantilever;
use fem_mesh::TetrahedralMesh;
use fem_scene::simulation::{Part, Simulation};
use fem_scene::{Body, Scene};
use fem_study::space::conditioning::conditioning;
use nalgebra::Vector3;

use super::end::End;

/// The engine's simulation of a scene.
pub fn build(scene: &Scene, body: Body) -> Result<Box<dyn Simulation>, End> {
    fem_engine::simulator::build(scene, body).map_err(End::unusable)
}

/// The parts of the engine's simulation of a scene, without building it.
pub fn planned_parts(scene: &Scene, body: &Body) -> Result<Vec<Part>, End> {
    fem_engine::simulator::planned_parts(scene, body).map_err(End::unusable)
}

/// Timoshenko's displacement of the tip, m, if the scene is a cantilever.
pub fn expected_tip_displacement(scene: &Scene) -> Option<Vector3<f64>> {
    cantilever::expected_tip_displacement(scene)
}

/// Prints the tip displacement of a cantilever beside that of Timoshenko's theory, m.
pub fn print_tip(simulation: &dyn Simulation, expected: &Vector3<f64>) {
    let (found, size) = (cantilever::tip_displacement(simulation), expected.norm());
    let along = if size > 0.0 { found.dot(expected) / size } else { found.norm() };
    let ratio = if size > 0.0 { format!(", ratio {:.4}", along / size) } else { String::new() };
    say!("tip displacement {along:.6e} m, by Timoshenko's theory {size:.6e} m{ratio}");
}

/// Prints the extreme eigenvalues of the stiffness that a mesh leads to.
pub fn print_conditioning(mesh: &TetrahedralMesh) -> Result<(), End> {
    let found = conditioning(mesh).map_err(|problem| End::unusable(format!("--stiffness: {problem}")))?;
    let axis = ["x", "y", "z"][found.axis];
    say!();
    say!(
        "stiffness of linear elasticity over Young's modulus, m (Poisson's ratio 0.3, the lowest tenth along {axis} fixed)"
    );
    for (name, value) in [
        ("largest eigenvalue", found.largest),
        ("smallest eigenvalue", found.smallest),
        ("condition number", found.number()),
    ] {
        say!("{name:<26}{value:>12.4e}");
    }
    Ok(())
}
