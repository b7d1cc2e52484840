//! Scenes as text, and the simulations that they make.

use std::path::Path;

use fem_model::Integrator;
use fem_scene::Scene;
use finite_elements_3d::assignment_setup::AssignmentSetup;

use crate::program::data;

/// The integrators that the course has.
pub const INTEGRATORS: [Integrator; 2] = [Integrator::LinearlyImplicitEuler, Integrator::ImplicitEuler];

/// A rubber cube of 27 nodes with every part that a scene can have, except a display surface.
pub const CUBE: &str = r#"about = "a rubber cube"
pipeline = "course"
[mesh]
box = { size = [1, 1, 1], cells_per_unit = 2 }
[material]
model = "neo_hookean"
C = 1e5
D = 4e5
density = 1000.0
[gravity]
acceleration = [0, -9.81, 0]
[fixed]
plane = { axis = "y", below = 0.1 }
[time]
dt = 0.01
integrator = "implicit_euler"
steps = 4
[drag]
vertex = "highest"
stiffness = 1e5
direction = [1, 0, 0]
amplitude = 0.2
frequency = 1.0
in_stiffness = true
"#;

/// The text with one passage replaced, which must be there.
pub fn edit(text: &str, from: &str, to: &str) -> String {
    assert_eq!(text.matches(from).count(), 1, "`{from}` is not there once:\n{text}");
    text.replacen(from, to, 1)
}

/// The text without this table.
pub fn without(text: &str, table: &str) -> String {
    let start = text.find(&format!("[{table}]\n")).unwrap_or_else(|| panic!("there is no [{table}]"));
    let end = text[start + 1..].find("\n[").map_or(text.len(), |length| start + 1 + length + 1);
    format!("{}{}", &text[..start], &text[end..])
}

/// The cube, free: neither gravity, nor fixed nodes, nor a drag.
pub fn free_cube() -> String {
    ["gravity", "fixed", "drag"].iter().fold(CUBE.to_owned(), |text, table| without(&text, table))
}

pub fn parse(text: &str) -> Scene {
    fem_scene::parse(text, Path::new("test.toml")).unwrap()
}

/// A shipped scene.
pub fn shipped(name: &str) -> Scene {
    fem_scene::load(name, &data()).unwrap()
}

/// The simulation of a scene, at rest.
pub fn build(scene: &Scene) -> AssignmentSetup {
    AssignmentSetup::new(scene, fem_scene::body(scene, &data()).unwrap()).unwrap()
}

/// The simulation of a text with this integrator, at rest.
pub fn build_with(text: &str, integrator: Integrator) -> AssignmentSetup {
    let mut scene = parse(text);
    scene.time.integrator = integrator;
    build(&scene)
}
