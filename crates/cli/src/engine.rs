//! Scenes that the engine runs.

use fem_engine::apparent_moduli::apparent_moduli;
use fem_engine::cantilever;
use fem_mesh::TetrahedralMesh;
use fem_model::Body;
use fem_model::simulation::{Part, Simulation};
use fem_reference::space::conditioning::conditioning;
use fem_scene::Scene;
use nalgebra::Vector3;

use crate::end::End;

/// The engine's simulation of a scene.
pub fn build(scene: &Scene, body: Body) -> Result<Box<dyn Simulation>, End> {
    let built = scene.check_one_body().and_then(|()| fem_engine::simulator::build(body, &scene.method()));
    built.map_err(|refusal| End::unusable(scene.refused(refusal)))
}

/// The parts of the engine's simulation of a scene, without building it.
pub fn planned_parts(scene: &Scene, body: &Body) -> Result<Vec<Part>, End> {
    fem_engine::simulator::planned_parts(body, &scene.method()).map_err(|refusal| End::unusable(scene.refused(refusal)))
}

/// Largest number of nodes for which moduli are measured: that needs the whole body.
const MOST_NODES: usize = 50_000;

/// A line with the apparent moduli of a mass-spring body; `None` for a body of elastic elements.
pub fn line_of_moduli(body: &Body) -> Result<Option<String>, End> {
    let nodes = body.shape.mesh.vertices().len();
    if nodes > MOST_NODES {
        let line = format!("apparent moduli: not measured for more than {MOST_NODES} nodes");
        return Ok(body.material.is_mass_spring().then_some(line));
    }
    let Some(found) = apparent_moduli(body).map_err(End::Stopped)? else { return Ok(None) };
    let [least, most] = found.young_of_directions;
    let dimension = body.shape.mesh.dimension();
    let (place, corners) = (if dimension == 2 { " in the plane" } else { "" }, dimension + 1);
    Ok(Some(format!(
        "apparent moduli{place} at small strain: E = {:.4e} Pa, ν = {:.4} (mean over all directions; E is {least:.4e} to {most:.4e} Pa \
         along single ones), measured with the {} nodes of the boundary in a uniform strain and the {} inside in equilibrium; if these \
         followed it too, E = {:.4e} Pa, ν = 1/{corners}",
        found.young,
        found.poisson,
        nodes - found.inside,
        found.inside,
        found.affine_young
    )))
}

/// Timoshenko's displacement of the tip, m, if the scene is a cantilever.
pub fn expected_tip_displacement(scene: &Scene, body: &Body) -> Option<Vector3<f64>> {
    cantilever::expected_tip_displacement(body, &scene.method())
}

/// Prints the tip displacement of a cantilever beside that of Timoshenko's theory, m.
pub fn print_tip(simulation: &dyn Simulation, expected: &Vector3<f64>) {
    let (found, size) = (cantilever::tip_displacement(simulation), expected.norm());
    let along = if size > 0.0 { found.dot(expected) / size } else { found.norm() };
    let ratio = if size > 0.0 { format!(", ratio {:.4}", along / size) } else { String::new() };
    say!("tip displacement {along:.6e} m, by Timoshenko's theory {size:.6e} m{ratio}");
}

/// Prints the extreme eigenvalues of the stiffness matrix of a mesh.
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
