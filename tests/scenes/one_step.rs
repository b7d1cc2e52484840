//! Whole steps beside those of a second, independent implementation.

use fem_model::simulation::Simulation;
use fem_scene::{Scene, body};
use nalgebra::{DVector, Vector3};

use crate::program::data;
use crate::reference::{AnchorSpring, Model};
use crate::scene_text::{CUBE, build, edit, free_cube, parse};

fn model_of(scene: &Scene) -> Model {
    let body = body(scene, &data()).unwrap();
    let fem_model::Law::NeoHookean(law) = scene.material.value().law else { panic!("the course has one law") };
    let [C, D] = law.moduli();
    let fixed = body.fixed_nodes().unwrap_or_default().to_vec();
    Model {
        V: body.shape.mesh.vertices().to_vec(),
        T: body.shape.mesh.tetrahedra().to_vec(),
        C,
        D,
        density: scene.material.density,
        gravity: scene.gravity.as_ref().map_or(Vector3::zeros(), |gravity| gravity.acceleration.into()),
        fixed,
    }
}

fn springs_at(scene: &Scene, time: f64, model: &Model) -> Vec<AnchorSpring> {
    let drag = body(scene, &data()).unwrap().drag;
    let spring = drag.map(|drag| {
        let swing = drag.amplitude * (std::f64::consts::TAU * drag.frequency * time).sin();
        let target = model.V[drag.node] + drag.direction * swing;
        AnchorSpring { node: drag.node, stiffness: drag.stiffness, target }
    });
    spring.into_iter().collect()
}

/// Steps both and compares positions and velocities after each step.
fn assert_agrees(text: &str, steps: usize) {
    let scene = parse(text);
    let (model, mut simulation) = (model_of(&scene), build(&scene));
    let (mut q, mut v) = (simulation.positions(), DVector::zeros(3 * model.V.len()));
    for step in 1..=steps {
        model.step(&mut q, &mut v, scene.time.dt(), &springs_at(&scene, step as f64 * scene.time.dt(), &model));
        simulation.step().unwrap();
        let apart = (simulation.positions() - &q).amax();
        assert!(apart <= 1e-8 * q.amax(), "step {step}: {apart:e} m apart");
        let apart = (simulation.velocities() - &v).amax();
        assert!(apart <= 1e-8 * v.amax() + 1e-8 / scene.time.dt() * q.amax(), "step {step}: {apart:e} m/s apart");
        assert!((&q - simulation.positions()).amax() < 1e-3 * (&q - rest(&model)).amax(), "nothing has moved");
    }
}

fn rest(model: &Model) -> DVector<f64> {
    DVector::from_fn(3 * model.V.len(), |i, _| model.V[i / 3][i % 3])
}

fn small(text: &str) -> String {
    edit(text, "cells_per_unit = 2", "cells_per_unit = 1")
}

#[test]
fn a_cube_of_six_elements_under_weight_and_drag_agrees_with_the_reference() {
    assert_agrees(&edit(&small(CUBE), "vertex = \"highest\"", "vertex = 7"), 8);
}

#[test]
fn a_free_cube_dragged_by_a_corner_agrees_with_the_reference() {
    let drag = "[drag]\nvertex = 7\nstiffness = 1e5\ndirection = [1, 0.5, -0.2]\namplitude = 0.2\nfrequency = 1.0\nin_stiffness = true\n";
    assert_agrees(&format!("{}{drag}", small(&free_cube())), 8);
}

#[test]
fn a_cube_of_given_young_and_poisson_agrees_with_the_reference() {
    let text = edit(&small(CUBE), "C = 1e5\nD = 4e5\n", "young = 3e5\npoisson = 0.3\n");
    assert_agrees(&edit(&text, "vertex = \"highest\"", "vertex = 6"), 5);
}

#[test]
fn a_small_cube_agrees_with_the_reference() {
    // A centimetre: a tolerance in metres or newtons would show here.
    let text = edit(&small(CUBE), "[material]", "scale = 0.01\n[material]");
    let text = edit(&edit(&text, "stiffness = 1e5", "stiffness = 1e2"), "amplitude = 0.2", "amplitude = 0.002");
    let text = edit(&edit(&text, "below = 0.1", "below = 0.001"), "dt = 0.01", "dt = 0.001");
    assert_agrees(&edit(&text, "vertex = \"highest\"", "vertex = 7"), 5);
}
