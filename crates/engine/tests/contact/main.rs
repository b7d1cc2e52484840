//! Contact with planes: closed forms, friction, impacts, and no penetration with any method.

#![allow(non_snake_case)] // E and L are the names that the mathematics uses

mod areas;
mod derivatives;
mod explained;
mod friction;
mod outside;
mod press;
mod refused;
mod resting;
mod resumed;
mod turned;

use std::path::Path;

use fem_engine::simulator::Simulator;
use fem_model::simulation::Simulation;
use fem_scene::{Scene, SceneError, parse};

/// The methods that support contact and move.
const METHODS: [&str; 10] = [
    "explicit_euler",
    "semi_implicit_euler",
    "rk2",
    "rk4",
    "verlet",
    "implicit_euler",
    "implicit_midpoint",
    "newmark",
    "generalized_alpha",
    "bdf2",
];

/// The methods that do not keep vibrations against the barrier for long: a step of the others throws a node back at its speed.
fn dissipative() -> impl Iterator<Item = &'static str> {
    METHODS.into_iter().filter(|method| !["implicit_midpoint", "newmark", "generalized_alpha"].contains(method))
}

/// Returns true if a method keeps the body outside by a barrier.
fn is_implicit(method: &str) -> bool {
    METHODS[5..].contains(&method)
}

fn scene(text: &str) -> Scene {
    parse(text, Path::new("folder/name.toml")).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn try_build(text: &str) -> Result<Simulator<f64>, SceneError> {
    let scene = parse(text, Path::new("folder/name.toml"))?;
    let body = fem_scene::body(&scene, Path::new("no data"))?;
    Simulator::new(body, &scene.method()).map_err(|refusal| scene.refused(refusal))
}

fn build(text: &str) -> Simulator<f64> {
    try_build(text).unwrap_or_else(|error| panic!("{error}\n{text}"))
}

fn run(simulation: &mut dyn Simulation, steps: usize) {
    for _ in 0..steps {
        simulation.step().unwrap_or_else(|failure| panic!("{failure}"));
    }
}

/// A body of 1000 kg/m³ and ν = 0.3; `rest` are further tables.
fn text(mesh: &str, model: &str, young: f64, method: &str, dt: f64, rest: &str) -> String {
    format!(
        "pipeline = \"engine\"\n[mesh]\n{mesh}\n[material]\nmodel = \"{model}\"\nyoung = {young:e}\npoisson = 0.3\n\
         density = 1000\n[time]\ndt = {dt:e}\nintegrator = \"{method}\"\n{rest}"
    )
}

/// A flat body of one square of 1 m, 1 m thick.
const SQUARE: &str = "rectangle = { size = [1, 1], cells_per_unit = 1 }";

/// A cube of 1 m.
const CUBE: &str = "box = { size = [1, 1, 1], cells_per_unit = 2 }";

fn gravity(x: f64, y: f64) -> String {
    format!("[gravity]\nacceleration = [{x:e}, {y:e}, 0]\n")
}

/// A floor at a height; `more` are further keys.
fn floor(height: f64, more: &str) -> String {
    format!("[[planes]]\npoint = [0, {height:e}, 0]\nnormal = [0, 1, 0]\n{more}\n")
}

/// Σ of the forces of all planes, N.
fn contact_force(simulation: &dyn Simulation) -> [f64; 3] {
    let contacts = simulation.contacts();
    std::array::from_fn(|i| contacts.iter().map(|contact| contact.force[i]).sum())
}

/// Mean velocity of the nodes' masses times the mass, kg m/s.
fn momentum(simulation: &Simulator<f64>) -> [f64; 3] {
    let (system, state) = (simulation.system(), simulation.state());
    let masses = system.mass.row_sums();
    std::array::from_fn(|i| masses.iter().zip(&state.v).map(|(mass, v)| mass * v[i]).sum())
}
