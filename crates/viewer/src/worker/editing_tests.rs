//! Tests of scenes that change while their simulation runs.

use std::thread::ThreadId;
use std::time::{Duration, Instant};

use super::tests::{Fake, REAL_TIME, fake, wait_for};
use super::*;
use crate::editing::editor::{Builder, Editing};
use fem_model::simulation::Shape;

pub const SCENE: &str = r#"
pipeline = "engine"
[mesh]
box = { size = [1, 1, 1], cells_per_unit = 1 }
[material]
model = "neo_hookean"
young = 1e5
poisson = 0.3
density = 1
[time]
dt = 0.01
integrator = "implicit_euler"
"#;

/// The thread on which a builder was called, and whether the mesh was there.
pub type Calls = Arc<Mutex<Vec<(ThreadId, bool)>>>;

/// A worker whose scene can be changed. The density of a scene that is built becomes that of the fake; it takes `seconds`, is refused above
/// 1000 kg/m³ and panics above 2000 kg/m³.
pub fn start(seconds: f64) -> (Worker, Calls) {
    let calls = Calls::default();
    let mesh = || fem_mesh::box_mesh([1.0; 3], 1, fem_mesh::Pattern::Alternating).unwrap().into();
    let seen = Arc::clone(&calls);
    let builder: Builder = Arc::new(move |scene: &Scene, shape: Option<&Shape>| {
        seen.lock().unwrap().push((std::thread::current().id(), shape.is_some()));
        std::thread::sleep(Duration::from_secs_f64(seconds));
        let density = scene.material.density;
        assert!(density < 2000.0, "index out of bounds");
        if density > 1000.0 {
            return Err("the body is too heavy".to_owned());
        }
        Ok(Box::new(Fake { density, mesh: mesh(), ..fake() }))
    });
    let scene = fem_scene::parse(SCENE, "fake.toml".as_ref()).unwrap();
    let editor = SceneEditor::new(Editing { scene, objects: Vec::new(), data: "data".into(), builder }, Vector3::y());
    (Worker::start(Box::new(Fake { mesh: mesh(), ..fake() }), REAL_TIME, Some(editor)), calls)
}

fn change(worker: &Worker, key: &'static str, value: f64) {
    worker.send(Command::Change(vec![Change::Number(key, value)]));
}

#[test]
fn a_changed_scene_is_built_on_the_simulations_thread_and_the_motion_goes_on() {
    let (worker, calls) = start(0.0);
    let before = wait_for(&worker, "some steps on", |s| s.steps >= 5);
    change(&worker, "density", 7.0);
    let after = wait_for(&worker, "changed", |s| s.changes == 1 && !s.is_building);
    assert_eq!((after.weight, after.refusal), (Some(7.0), None));
    assert!(after.time >= before.time && after.steps >= before.steps, "{} {}", before.time, after.time);
    let (thread, has_mesh) = calls.lock().unwrap()[0];
    assert!(thread != std::thread::current().id() && has_mesh);
    assert_eq!(worker.finish().scene.unwrap().material.density, 7.0);
}

#[test]
fn the_panel_has_the_numbers_of_the_scene() {
    let (worker, _) = start(0.0);
    let snapshot = wait_for(&worker, "the start", |_| true);
    let keys: Vec<_> = snapshot.scene_parameters.iter().map(|parameter| parameter.key).collect();
    assert_eq!(keys, ["cells", "scale", "density", "lambda", "mu"]);
    assert_eq!(snapshot.object, None);
}

#[test]
fn a_change_that_is_refused_leaves_the_run_as_it_is_with_a_message() {
    let cases = [(-1.0, "material.density is -1"), (1500.0, "too heavy"), (3000.0, "index out of bounds")];
    let (worker, _) = start(0.0);
    for (number, (density, message)) in cases.into_iter().enumerate() {
        change(&worker, "density", density);
        let refused = wait_for(&worker, "refused", |s| s.changes == number + 1 && !s.is_building);
        let text = refused.refusal.unwrap();
        assert!(text.contains(message), "{text}");
        assert_eq!((refused.weight, refused.stop), (Some(1.0), None));
        wait_for(&worker, "going on", |s| s.steps > refused.steps + 2);
    }
    change(&worker, "density", 2.0);
    let accepted = wait_for(&worker, "accepted", |s| s.weight == Some(2.0));
    assert_eq!(accepted.refusal, None);
}

#[test]
fn another_mesh_starts_the_motion_again() {
    let (worker, calls) = start(0.0);
    let before = wait_for(&worker, "some steps on", |s| s.steps >= 20);
    change(&worker, "scale", 2.0);
    let after = wait_for(&worker, "changed", |s| s.changes == 1 && !s.is_building);
    assert!(after.time < before.time && after.steps < before.steps);
    assert!(!calls.lock().unwrap()[0].1, "the former mesh is no help");
}

#[test]
fn the_window_does_not_wait_while_a_scene_is_built() {
    let (worker, _) = start(0.4);
    wait_for(&worker, "the start", |_| true);
    let begun = Instant::now();
    change(&worker, "scale", 2.0);
    wait_for(&worker, "being built", |s| s.is_building);
    assert!(begun.elapsed() < Duration::from_millis(300));
    let done = wait_for(&worker, "built", |s| s.changes == 1 && !s.is_building);
    assert!(begun.elapsed() >= Duration::from_millis(400));
    assert!(done.steps < 20, "the time of building is not caught up");
}

#[test]
fn parameters_of_the_simulation_keep_their_values_in_a_changed_scene() {
    let (worker, _) = start(0.0);
    worker.send(Command::Set("offset", 0.5));
    change(&worker, "density", 3.0);
    let after = wait_for(&worker, "changed", |s| s.weight == Some(3.0));
    assert_eq!(after.parameters[0].value, 0.5, "a parameter of the simulation keeps its value");
}
