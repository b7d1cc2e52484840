//! Integrators and bodies: orders, closed forms, conserved quantities, limits of stability, equilibrium, and the work that each
//! method does.

#![allow(non_snake_case)] // C, D and E are the names that the mathematics uses

mod adaptive;
mod affine;
mod arc_length;
mod balance;
mod bars;
mod cantilever;
mod central_gravity;
mod closed_scenes;
mod conserved;
mod curves;
mod damped_starts;
mod divergence;
mod driven;
mod extreme;
mod fibres;
mod flat;
mod initial_velocity;
mod lattices;
mod laws;
mod ledger;
mod mass_spring;
mod nodal_fields;
mod nodal_forces;
mod ogden;
mod orders;
mod own_potentials;
mod parts;
mod plasticity;
mod position_based;
mod precision;
mod pressures;
mod prony;
mod quadratic;
mod quadratic_motion;
mod quadratic_solids;
mod quasi_static;
mod reactions;
mod release;
mod resume;
mod second_order;
mod shipped_scenes;
mod statics;
mod substeps;
mod supplied;
mod surface_loads;
mod twists;
mod unconverged;
mod vertex_block_descent;
mod vibrations;
mod viscosity;
mod volumetric;
mod work;

use std::path::Path;

use fem_model::simulation::Simulation;
use fem_scene::{Scene, SceneError, parse};

/// The scene, in memory.
fn scene(text: &str) -> Scene {
    parse(text, Path::new("folder/name.toml")).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn try_build(text: &str) -> Result<Box<dyn Simulation>, SceneError> {
    let scene = scene(text);
    let body = fem_scene::body(&scene, Path::new("no data"))?;
    fem_engine::simulator::build(body, &scene.method()).map_err(|refusal| scene.refused(refusal))
}

fn build(text: &str) -> Box<dyn Simulation> {
    try_build(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

/// A small soft neo-Hookean box of 2 × 1 × 1 m; `rest` are further tables.
fn soft(integrator: &str, dt: f64, rest: &str) -> String {
    format!(
        r#"pipeline = "engine"
[mesh]
box = {{ size = [2, 1, 1], cells_per_unit = 1 }}
[material]
model = "neo_hookean"
C = 1e4
D = 4e4
density = 1000.0
[time]
dt = {dt:e}
integrator = "{integrator}"
{rest}"#
    )
}

/// The same body with its cells cut all in the same way, for figures that belong to that mesh.
fn of_kuhn(text: &str) -> String {
    text.replace("cells_per_unit", "pattern = \"kuhn\", cells_per_unit")
}

fn run(simulation: &mut dyn Simulation, steps: usize) {
    for _ in 0..steps {
        simulation.step().unwrap_or_else(|failure| panic!("{failure}"));
    }
}

/// ‖a − b‖∞
fn distance(a: &nalgebra::DVector<f64>, b: &nalgebra::DVector<f64>) -> f64 {
    (a - b).amax()
}

/// `[[prescribed]]` of one coordinate of one side, at a distance.
fn side(axis: &str, side: &str, distance: f64) -> String {
    let displacement = ["x", "y", "z"].map(|other| if other == axis { distance } else { 0.0 });
    format!(
        "[[prescribed]]\non = {{ axis = \"{axis}\", side = \"{side}\", within = 1e-9 }}\n\
         displacement = {displacement:?}\ncomponents = [\"{axis}\"]\n"
    )
}

/// Planes of symmetry through the origin: `prescribed[0]` to `prescribed[2]`.
fn symmetry() -> String {
    ["x", "y", "z"].map(|axis| side(axis, "min", 0.0)).concat()
}

/// A box of 2 × 1 × 1 m of a law with E = 1e5 Pa and ν = 0.3, in equilibrium; `rest` are further tables.
fn block(model: &str, rest: &str) -> String {
    of_law(model, &soft("static", 1.0, &format!("[newton]\ntolerance = 1e-14\n{rest}")))
}

/// The scene with another law, with E = 1e5 Pa and ν = 0.3 at small strain.
fn of_law(model: &str, scene: &str) -> String {
    let (C, D) = (1e5 / (4.0 * 1.3), 1e5 / (6.0 * 0.4));
    let parameters = match model {
        "mooney_rivlin" => format!("C10 = {}\nC01 = {}\nD = {D}", 0.625 * C, 0.375 * C),
        "gent" => format!("C = {C}\nJm = 30\nD = {D}"),
        "yeoh" => format!("C1 = {C}\nC2 = {}\nC3 = {}\nD = {D}", -0.05 * C, 0.02 * C),
        "ogden" => {
            // Σ μ α/2 is the shear modulus 2C.
            let of_terms = [1.5, 4.0, -2.0].into_iter().zip([2.0, 0.075, -0.85]).enumerate();
            let terms = of_terms
                .map(|(n, (alpha, mu))| format!("mu{0} = {1}\nalpha{0} = {alpha}\n", n + 1, 4.0 * C * mu / 5.0));
            terms.chain([format!("D = {D}")]).collect()
        }
        _ => "young = 1e5\npoisson = 0.3".to_owned(),
    };
    let material = format!("model = \"{model}\"\n{parameters}");
    scene.replace("model = \"neo_hookean\"\nC = 1e4\nD = 4e4", &material)
}

/// The methods that move.
const DYNAMIC: [&str; 12] = [
    "explicit_euler",
    "semi_implicit_euler",
    "rk2",
    "rk4",
    "verlet",
    "linearly_implicit_euler",
    "implicit_euler",
    "implicit_midpoint",
    "newmark",
    "generalized_alpha",
    "bdf2",
    "bathe",
];

/// The implicit methods of second order.
const SECOND_ORDER: [&str; 5] = ["implicit_midpoint", "newmark", "generalized_alpha", "bdf2", "bathe"];

/// `[mass]` of each node when it is lumped, kg.
fn node_masses(simulation: &dyn Simulation, density: f64) -> Vec<f64> {
    let shape = simulation.shape();
    let mut masses = vec![0.0; shape.mesh.vertices().len()];
    for (element, volume) in shape.mesh.corners().zip(shape.mesh.volumes()) {
        for &node in element {
            masses[node] += density * volume / 4.0;
        }
    }
    masses
}
