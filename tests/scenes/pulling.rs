//! Fixed nodes, the drag of a scene, and the pull of the mouse.

use fem_model::simulation::{Interactive, Pull, Simulation};
use fem_scene::{Pipeline, body};
use nalgebra::{DVector, Vector3};

use crate::program::{course_scenes, data};
use crate::scene_text::{CUBE, INTEGRATORS, build, build_with, edit, free_cube, shipped};

fn node(q: &DVector<f64>, node: usize) -> Vector3<f64> {
    Vector3::new(q[3 * node], q[3 * node + 1], q[3 * node + 2])
}

#[test]
fn fixed_nodes_stay_bit_for_bit() {
    for name in course_scenes() {
        let scene = shipped(&name);
        let body = body(&scene, &data()).unwrap();
        let fixed = body.fixed_nodes().unwrap();
        assert!(!fixed.is_empty(), "{name} fixes no node");
        for integrator in INTEGRATORS {
            let mut scene = scene.clone();
            scene.time.integrator = integrator;
            scene.drag.as_mut().unwrap().in_stiffness = Some(true);
            let mut simulation = build(&scene);
            for _ in 0..10 {
                simulation.step().unwrap();
                let (q, v) = (simulation.positions(), simulation.velocities());
                for &i in fixed {
                    assert_eq!(node(&q, i), simulation.shape().mesh.vertices()[i], "{name}: node {i}");
                    assert_eq!(node(&v, i), Vector3::zeros(), "{name}: node {i}");
                }
            }
        }
    }
}

#[test]
fn a_very_stiff_drag_puts_its_node_at_the_target_at_the_end_of_the_step() {
    let text = edit(CUBE, "stiffness = 1e5", "stiffness = 1e13");
    let text = edit(&text, "vertex = \"highest\"", "vertex = 26");
    let text =
        edit(&edit(&text, "direction = [1, 0, 0]", "direction = [0.5, 0, 1]"), "amplitude = 0.2", "amplitude = 0.1");
    for integrator in INTEGRATORS {
        let mut simulation = build_with(&text, integrator);
        let rest = simulation.shape().mesh.vertices()[26];
        for step in 1..=20 {
            simulation.step().unwrap();
            let swing = 0.1 * (std::f64::consts::TAU * 1.0 * 0.01 * f64::from(step)).sin();
            let target = rest + Vector3::new(0.5, 0.0, 1.0) * swing;
            let distance = (node(&simulation.positions(), 26) - target).norm();
            // Some 1e4 N from the body stretch the spring by some 1e-9 m.
            assert!(distance < 1e-7, "{}: {distance} m in step {step}", integrator.name());
        }
    }
}

#[test]
fn the_dragged_node_stays_near_its_target() {
    for name in ["arma"] {
        let mut scene = shipped(name);
        scene.pipeline = Pipeline::Course;
        let drag = body(&scene, &data()).unwrap().drag.unwrap();
        let mut simulation = build(&scene);
        let rest = simulation.shape().mesh.vertices()[drag.node];
        let mut farthest: f64 = 0.0;
        for _ in 0..50 {
            simulation.step().unwrap();
            let target = rest + drag.displacement(simulation.time());
            farthest = farthest.max((node(&simulation.positions(), drag.node) - target).norm());
        }
        assert!(farthest < 0.5 * drag.amplitude, "{name}: {farthest} m behind");
    }
}

#[test]
fn a_pull_replaces_the_drag_and_its_end_brings_the_drag_back() {
    for integrator in INTEGRATORS {
        let (mut pulled, mut alone) = (build_with(CUBE, integrator), build_with(CUBE, integrator));
        pulled.pull(Some(Pull { anchors: vec![], offset: Vector3::zeros() }));
        pulled.pull(None);
        for _ in 0..3 {
            pulled.step().unwrap();
            alone.step().unwrap();
        }
        assert_eq!(pulled.positions(), alone.positions(), "{}", integrator.name());

        // An interaction without nodes leaves only the weight, which moves no node along x.
        pulled.reset();
        pulled.pull(Some(Pull { anchors: vec![], offset: Vector3::zeros() }));
        (0..3).for_each(|_| pulled.step().unwrap());
        assert!((0..3).all(|_| alone.step().is_ok()));
        let sideways = |q: &DVector<f64>| q[3 * 26] - 1.0;
        assert!(sideways(&alone.positions()).abs() > sideways(&pulled.positions()).abs());
    }
}

#[test]
fn a_pull_moves_its_nodes_to_their_targets() {
    for integrator in INTEGRATORS {
        let mut simulation = build_with(&free_cube(), integrator);
        let place = simulation.shape().mesh.vertices()[13];
        simulation.pull(Some(Pull { anchors: vec![(13, place)], offset: Vector3::new(0.0, 0.0, 0.1) }));
        simulation.set_parameter("drag", 1e8).unwrap();
        simulation.step().unwrap();
        let moved = node(&simulation.positions(), 13) - place;
        assert!((moved - Vector3::new(0.0, 0.0, 0.1)).norm() < 2e-3, "{}: {moved}", integrator.name());
    }
}

#[test]
fn several_nodes_can_be_pulled_at_once() {
    let mut simulation = build_with(&free_cube(), INTEGRATORS[1]);
    let V = simulation.shape().mesh.vertices().to_vec();
    simulation.pull(Some(Pull { anchors: vec![(0, V[0]), (26, V[26])], offset: Vector3::x() * 0.01 }));
    simulation.set_parameter("drag", 1e8).unwrap();
    simulation.step().unwrap();
    let q = simulation.positions();
    for i in [0, 26] {
        assert!((node(&q, i) - V[i] - Vector3::x() * 0.01).norm() < 1e-3, "node {i} is at {}", node(&q, i));
    }
}
