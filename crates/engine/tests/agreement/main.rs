//! The engine against programs that share no code with it: their answers are stored beside this file, each with the program,
//! its version, the command and the date.

#![allow(non_snake_case)] // V is the name that the mathematics uses

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use fem_model::Integrator;
use fem_model::simulation::Simulation;
use fem_scene::{Scene, body, load, parse};
use nalgebra::Vector3;
use serde::Deserialize;

/// The answer of another program.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct Answer {
    about: String,
    provenance: BTreeMap<String, String>,
    /// Steps until then; none in equilibrium.
    steps: Option<usize>,
    /// Of some nodes, m.
    positions: Option<BTreeMap<usize, [f64; 3]>>,
    /// Of some nodes, m.
    displacements: Option<BTreeMap<usize, [f64; 3]>>,
}

impl Answer {
    fn read(name: &str) -> Self {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("agreement").join(name);
        let text = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        let answer: Self = serde_json::from_str(&text).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
        for key in ["program", "version", "command", "date"] {
            assert!(answer.provenance.contains_key(key), "{name} ({}): tell its {key}", answer.about);
        }
        answer
    }
}

fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../data")
}

/// The scene after so many steps, all of which have converged.
fn run(scene: &Scene, steps: usize) -> Box<dyn Simulation> {
    let body = body(scene, &data()).unwrap_or_else(|error| panic!("{error}"));
    let mut simulation = fem_engine::simulator::build(body, &scene.method()).unwrap_or_else(|error| panic!("{error}"));
    for _ in 0..steps {
        simulation.step().unwrap_or_else(|failure| panic!("{failure}"));
    }
    assert_eq!(simulation.counters().unconverged_steps, 0, "{}: steps that have not converged", scene.name);
    simulation
}

/// Largest distance of a node from where the other program has it, m.
fn distance(simulation: &dyn Simulation, positions: &BTreeMap<usize, [f64; 3]>) -> f64 {
    assert!(!positions.is_empty());
    let q = simulation.positions();
    let apart = |(&node, &x): (&usize, &[f64; 3])| (q.fixed_rows::<3>(3 * node) - Vector3::from(x)).norm();
    let distances: Vec<f64> = positions.iter().map(apart).collect();
    assert!(distances.iter().all(|distance| distance.is_finite()), "{distances:?}");
    distances.into_iter().fold(0.0, f64::max)
}

/// Longest edge of the undeformed body's bounding box, m.
fn size(simulation: &dyn Simulation) -> f64 {
    let shape = simulation.shape();
    let V = shape.mesh.vertices();
    let (least, most) = V.iter().fold((V[0], V[0]), |(least, most), x| (least.inf(x), most.sup(x)));
    (most - least).max()
}

/// A shipped scene ends where the other program says, to a part of the body's size.
fn ends_like(scene: &Scene, answer: &str, part: f64) {
    let answer = Answer::read(answer);
    let simulation = run(scene, answer.steps.unwrap());
    let (distance, size) = (distance(&*simulation, &answer.positions.unwrap()), size(&*simulation));
    assert!(distance <= part * size, "{}: {distance:.2e} m apart, body of {size} m", answer.about);
}

fn shipped(name: &str) -> Scene {
    load(name, &data()).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn the_beam_ends_where_fenris_has_it() {
    ends_like(&shipped("beam"), "beam.json", 1e-8 / 4.0);
}

#[test]
fn the_armadillo_ends_where_a_converged_program_has_it() {
    ends_like(&shipped("arma-engine"), "arma.json", 1e-8);
}

#[test]
fn the_bunny_ends_where_another_linearly_implicit_program_has_it() {
    ends_like(&shipped("bunny-engine"), "bunny.json", 1e-8);
}

#[test]
fn the_bunny_by_implicit_euler_ends_where_a_converged_program_has_it() {
    let mut scene = shipped("bunny-engine");
    scene.time.integrator = Integrator::ImplicitEuler;
    ends_like(&scene, "bunny_implicit.json", 1e-8);
}

#[test]
fn a_sagging_beam_of_linear_elasticity_has_the_displacements_of_fenris() {
    let answer = Answer::read("cantilever.json");
    let simulation = run(&parse(CANTILEVER, Path::new("cantilever.toml")).unwrap_or_else(|error| panic!("{error}")), 1);
    let (q, shape) = (simulation.positions(), simulation.shape());
    for (node, expected) in answer.displacements.unwrap() {
        let found = q.fixed_rows::<3>(3 * node) - shape.mesh.vertices()[node];
        let expected = Vector3::from(expected);
        let error = (found - expected).norm() / expected.norm();
        assert!(error <= 1e-9, "node {node}: {found:?}, not {expected:?}: {error:.1e}");
    }
}

/// Its solver's tolerance is what rounding allows: forces of 0.3 N stand against a stiffness of 1e5 N/m.
const CANTILEVER: &str = r#"pipeline = "engine"
[mesh]
box = { size = [4, 1, 1], cells_per_unit = 6, pattern = "kuhn" }
[material]
model = "linear"
young = 1e5
poisson = 0.3
density = 10.0
[gravity]
acceleration = [0, 0, -9.81]
[fixed]
plane = { axis = "x", below = 1e-9 }
[time]
dt = 1.0
integrator = "static"
[static]
load_steps = 1
[solver]
kind = "cholesky"
tolerance = 1e-11
"#;
