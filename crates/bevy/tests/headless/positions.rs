//! The bodies have the positions of the engine, bit for bit, and the meshes lie between them.

use std::process::Command;
use std::time::Duration;

use bevy::math::DVec3;
use bevy::mesh::VertexAttributeValues;
use bevy::prelude::*;
use fem_bevy::{SoftBody, SoftBodyMeshSync, SoftBodyPlugin};
use fem_scene::Scene;

use crate::app::{BAR, DATA, app, app_with, state, wait_for_bodies, wait_until};

/// Positions after each step of the engine without Bevy, m.
fn reference(scene: &Scene, steps: usize) -> Vec<Vec<DVec3>> {
    let body = fem_scene::body(scene, DATA.as_ref()).unwrap();
    let mut simulation = fem_engine::simulator::build(body, &scene.method()).unwrap();
    let mut states = Vec::new();
    for step in 0..=steps {
        if step > 0 {
            simulation.step().unwrap();
        }
        states.push(simulation.positions().as_slice().chunks_exact(3).map(DVec3::from_slice).collect());
    }
    states
}

/// Updates an app until `steps` steps are done, and compares every state that a frame sees.
fn compare(scene: &Scene, frames_per_second: f64, workers: usize, expected: &[Vec<DVec3>]) {
    let steps = expected.len() - 1;
    let mut app = app(Duration::from_secs_f64(1.0 / frames_per_second), workers);
    let body = app.world_mut().spawn((SoftBody::from_scene(scene.clone(), DATA), SoftBodyMeshSync::default())).id();
    wait_for_bodies(&mut app, &[body]);
    let check = |app: &App| {
        let state = state(app, body);
        let expected = expected.get(state.steps());
        assert!(
            expected.is_none_or(|expected| expected == state.positions()),
            "step {} at {frames_per_second} frames a second with {workers} workers",
            state.steps()
        );
    };
    // One step less, because steps are requested one ahead.
    let frames = ((steps - 1) as f64 * scene.method().dt * frames_per_second).ceil() as usize;
    for _ in 0..frames {
        app.update();
        check(&app);
    }
    wait_until(&mut app, |app| state(app, body).steps() >= steps);
    check(&app);
}

#[test]
fn positions_are_those_of_the_engine_at_any_frame_rate() {
    let scene = fem_scene::load("arma-engine", DATA.as_ref()).unwrap();
    let expected = reference(&scene, 60);
    for frames_per_second in [30.0, 60.0, 144.0] {
        for workers in [1, 2] {
            compare(&scene, frames_per_second, workers, &expected[..=59]);
        }
    }
}

#[test]
fn positions_of_a_large_body_are_those_of_the_engine() {
    let text = BAR.replace("size = [7, 1, 1], cells_per_unit = 1", "size = [4, 1, 1], cells_per_unit = 9");
    let scene = fem_scene::parse(&text, "large.toml".as_ref()).unwrap();
    let expected = reference(&scene, 6);
    assert!(expected[0].len() > 3000, "steps of such a body use several threads");
    compare(&scene, 60.0, 1, &expected);
}

#[test]
fn bodies_side_by_side_do_not_disturb_each_other() {
    let scene = fem_scene::parse(BAR, "bar.toml".as_ref()).unwrap();
    let expected = reference(&scene, 25);
    let mut app = app(Duration::from_millis(16), 2);
    let spawn = |world: &mut World| world.spawn(SoftBody::text(BAR, DATA)).id();
    let bodies: Vec<Entity> = (0..7).map(|_| spawn(app.world_mut())).collect();
    wait_for_bodies(&mut app, &bodies);
    (0..15).for_each(|_| app.update());
    wait_until(&mut app, |app| bodies.iter().all(|&body| state(app, body).steps() == 25));
    assert!(bodies.iter().all(|&body| state(&app, body).positions() == expected[25]));
}

#[test]
fn a_mesh_lies_between_the_steps_around_the_shown_time() {
    let scene = fem_scene::parse(BAR, "bar.toml".as_ref()).unwrap();
    let expected = reference(&scene, 40);
    for frames_per_second in [30.0, 144.0] {
        let mut app = app(Duration::from_secs_f64(1.0 / frames_per_second), 1);
        let body = app.world_mut().spawn((SoftBody::text(BAR, DATA), SoftBodyMeshSync::default())).id();
        wait_for_bodies(&mut app, &[body]);
        for _ in 0..(0.25 * frames_per_second) as usize {
            app.update();
            let shown = state(&app, body).shown_time() / state(&app, body).dt();
            let [before, after] = [shown.floor(), shown.ceil()].map(|step| &expected[step as usize]);
            let between = |node: usize| before[node].lerp(after[node], shown.fract()).as_vec3();
            for (node, vertex) in vertices(&app, body).iter().enumerate() {
                let distance = vertex.distance(between(node));
                assert!(distance < 1e-5, "node {node} at {frames_per_second} Hz is {distance} m away");
            }
            let next = (shown + 1.0 / (0.01 * frames_per_second)).ceil() as usize;
            wait_until(&mut app, |app| state(app, body).steps() >= next);
        }
    }
}

fn vertices(app: &App, body: Entity) -> Vec<Vec3> {
    let handle = &app.world().get::<Mesh3d>(body).expect("the plugin adds a mesh").0;
    let mesh = app.world().resource::<Assets<Mesh>>().get(handle).unwrap();
    match mesh.attribute(Mesh::ATTRIBUTE_POSITION) {
        Some(VertexAttributeValues::Float32x3(positions)) => positions.iter().map(|&x| x.into()).collect(),
        other => panic!("{other:?}"),
    }
}

#[test]
fn a_worker_that_is_too_slow_drops_time_and_says_so() {
    let plugin = SoftBodyPlugin { workers: 1, most_lag: Duration::from_millis(50) };
    let mut app = app_with(Duration::from_millis(200), plugin);
    let body = app.world_mut().spawn(SoftBody::text(BAR, DATA)).id();
    wait_for_bodies(&mut app, &[body]);
    (0..5).for_each(|_| app.update());
    let dropped = state(&app, body).dropped_time();
    assert!(dropped > 0.5 && dropped < 1.0, "{dropped} s");
}

/// `test.sh` builds the program and gives its path.
#[test]
#[ignore = "needs the program; test.sh runs it"]
fn positions_are_those_of_the_command_line() {
    let program = std::env::var("FINITE_ELEMENTS_3D").expect("FINITE_ELEMENTS_3D is the path of the program");
    let folder = std::env::temp_dir().join(format!("fem-bevy-{}", std::process::id()));
    std::fs::create_dir_all(&folder).unwrap();
    let scene = fem_scene::load("arma-engine", DATA.as_ref()).unwrap();
    let mut expected = reference(&scene, 50);
    for steps in [20, 50] {
        let file = folder.join(format!("{steps}.json"));
        let arguments = ["arma-engine", "--headless", "--steps", &steps.to_string(), "--state"];
        let root = concat!(env!("CARGO_MANIFEST_DIR"), "/../..");
        let run = Command::new(&program).args(arguments).arg(&file).current_dir(root).output().unwrap();
        assert!(run.status.success(), "{}", String::from_utf8_lossy(&run.stderr));
        let state: serde_json::Value = serde_json::from_slice(&std::fs::read(&file).unwrap()).unwrap();
        let q: Vec<f64> = state["q"].as_array().unwrap().iter().map(|value| value.as_f64().unwrap()).collect();
        expected[steps] = q.chunks_exact(3).map(DVec3::from_slice).collect();
    }
    std::fs::remove_dir_all(&folder).unwrap();
    for frames_per_second in [30.0, 60.0, 144.0] {
        for workers in [1, 2] {
            compare(&scene, frames_per_second, workers, &expected[..=20]);
            compare(&scene, frames_per_second, workers, &expected);
        }
    }
}
