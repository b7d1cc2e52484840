//! What a scene builds, what it leaves out, and why.

use super::Engine;
use crate::number::Real;
use crate::scene::Integrator;
use crate::simulation::Part;
use crate::system::System;

/// Every part that the engine can have.
pub(super) fn parts<T: Real>(engine: &Engine<T>) -> Vec<Part> {
    let Engine { scene, system, .. } = engine;
    let (nodes, elements, held) = (system.nodes(), system.elements.count, system.nodes() - system.free());
    let state = engine.state.bytes() + engine.last_good.bytes();
    let load = 3 * size_of::<T>() * system.dead_load.as_ref().map_or(0, Vec::len);
    let pressure = system.pressures.iter().map(|pressure| pressure.bytes()).sum();
    let mut parts = vec![
        built("mesh", format!("[mesh]: {nodes} nodes, {elements} tetrahedra"), system.elements.bytes()),
        built("state", format!("displacements and velocities in {}", std::any::type_name::<T>()), state),
        built("mass", mass(scene.mass.lumped), system.mass.bytes()),
        optional("dead_load", system.dead_load.is_some(), load, "[gravity], [body_force] or [[traction]]"),
        optional("fixed", held > 0, 0, "[fixed] or [[prescribed]]: held nodes have no row"),
        optional("prescribed", system.held.leads(), system.held.bytes(), "[[prescribed]]"),
        optional("springs", !system.springs.is_empty(), size_of_val(&system.springs[..]), "[[springs]]"),
        pressure_part(system, pressure),
        optional("damping", system.damping.is_some(), 0, "[damping]"),
        optional("drag", system.drag.is_some(), 0, "[drag]"),
    ];
    let skinning = engine.skinning.as_ref().map_or(0, |skinning| skinning.bytes());
    parts.push(optional("skinning", engine.skinning.is_some(), skinning, "mesh.display"));
    let solver = engine.stepper.solver();
    let stiffness = system.pattern.bytes() + 9 * size_of::<T>() * system.pattern.blocks();
    parts.push(optional("stiffness", solver.is_some(), stiffness, "an implicit integrator or static"));
    parts.push(optional(
        "solver",
        solver.is_some(),
        solver.map_or(0, |solver| solver.bytes()),
        "an implicit integrator or static",
    ));
    let searches = matches!(engine.integrator, Integrator::ImplicitEuler | Integrator::Static);
    parts.push(optional("line_search", searches, 0, "implicit_euler or static"));
    parts
}

fn pressure_part<T: Real>(system: &System<T>, bytes: usize) -> Part {
    let part = optional("pressure", !system.pressures.is_empty(), bytes, "[[traction]] with pressure");
    if system.pressures.iter().all(|pressure| pressure.has_potential()) {
        return part;
    }
    Part { why: format!("{}; its surface has an edge that moves: its work is in no energy", part.why), ..part }
}

fn mass(lumped: bool) -> String {
    if lumped { "lumped" } else { "consistent" }.to_owned()
}

fn built(name: &'static str, why: String, bytes: usize) -> Part {
    Part { name, built: true, why, bytes, seconds: 0.0 }
}

fn optional(name: &'static str, is_built: bool, bytes: usize, switch: &str) -> Part {
    if is_built {
        return built(name, switch.to_owned(), bytes);
    }
    Part { name, built: false, why: format!("the scene has no {switch}"), bytes: 0, seconds: 0.0 }
}
