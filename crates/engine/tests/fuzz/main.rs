//! Mutated state files: a run goes on from them or refuses them with one line of text, without a panic, without a hang, and without
//! memory beyond four times the file.

#[path = "../../../mesh/tests/fuzz/mutation.rs"]
mod mutation;

use std::cell::RefCell;
use std::fs;
use std::path::Path;

use fem_model::simulation::Simulation;
use fem_scene::{ResumeError, resume, write_state};
use fem_scene::{Scene, parse};
use tempfile::tempdir;

use self::mutation::{fuzz, write_over};

fn scene(integrator: &str, cells: usize) -> Scene {
    let text = format!(
        r#"pipeline = "engine"
[mesh]
box = {{ size = [2, 1, 1], cells_per_unit = {cells} }}
[material]
model = "neo_hookean"
C = 1e4
D = 1e5
density = 1000
[gravity]
acceleration = [0, 0, -9.81]
[fixed]
plane = {{ axis = "x", below = 1e-9 }}
[time]
dt = 0.01
integrator = "{integrator}"
"#
    );
    parse(&text, Path::new("m.toml")).unwrap()
}

fn start(scene: &Scene) -> Box<dyn Simulation> {
    let body = fem_scene::body(scene, Path::new("no data")).unwrap();
    fem_engine::simulator::build(body, &scene.method()).unwrap_or_else(|error| panic!("{error}"))
}

#[test]
fn mutated_states_are_taken_or_refused() {
    let folder = tempdir().unwrap();
    let path = folder.path().join("state.json");
    for integrator in ["implicit_euler", "verlet"] {
        let scene = scene(integrator, 1);
        let mut simulation = start(&scene);
        let mut files = Vec::new();
        for _ in 0..2 {
            simulation.step().unwrap();
            write_state(&path, &scene, &*simulation).unwrap();
            files.push(fs::read(&path).unwrap());
        }
        let simulation = RefCell::new(simulation);
        let prepare = |bytes: &[u8]| write_over(&path, bytes);
        let read = |_: &()| resume(&path, &scene, &mut **simulation.borrow_mut());
        let go_on = |found: Result<(), ResumeError>| match found {
            Ok(()) => {
                let mut simulation = simulation.borrow_mut();
                assert!(simulation.positions().iter().chain(&simulation.velocities()).all(|x| x.is_finite()));
                // A state far from the body may have no next step; the error says so.
                if simulation.step().is_ok() {
                    assert!(simulation.positions().iter().all(|x| x.is_finite()));
                }
            }
            Err(error) => {
                let message = error.to_string();
                assert!(message.len() < 1000 && message.lines().count() == 1, "{message}");
            }
        };
        fuzz(integrator, &files, <[u8]>::len, prepare, read, go_on);
    }
}

#[test]
fn a_large_state_takes_at_most_four_times_its_size() {
    let folder = tempdir().unwrap();
    let (path, scene) = (folder.path().join("state.json"), scene("implicit_euler", 10));
    let mut simulation = start(&scene);
    simulation.step().unwrap();
    write_state(&path, &scene, &*simulation).unwrap();
    let size = fs::metadata(&path).unwrap().len();
    let used = allocation_counter::measure(|| resume(&path, &scene, &mut *simulation).unwrap()).bytes_max;
    println!("state: {size} bytes, memory {:.2} times the file", used as f64 / size as f64);
    assert!(used <= 4 * size, "{used} bytes of memory for a state of {size}");
}
