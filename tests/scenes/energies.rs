//! Energy balances: a body without external forces stays at rest, and implicit Euler gains no energy.

use fem_model::Integrator;
use fem_model::simulation::Simulation;
use fem_scene::{Pipeline, Scene, body};
use nalgebra::Vector3;

use crate::program::{course_scenes, data};
use crate::scene_text::{INTEGRATORS, build, shipped};

const STEPS: usize = 60;

fn with(mut scene: Scene, integrator: Integrator) -> Scene {
    scene.time.integrator = integrator;
    scene
}

#[test]
fn a_body_without_gravity_and_drag_stays_at_rest() {
    for (name, integrator) in every_scene_and_integrator() {
        let mut scene = with(shipped(&name), integrator);
        (scene.gravity, scene.drag) = (None, None);
        let mut simulation = build(&scene);
        let rest = simulation.positions();
        (0..20).for_each(|_| simulation.step().unwrap());
        let moved = (simulation.positions() - &rest).amax();
        assert!(moved <= 1e-14 * rest.amax(), "{name}, {}: moved by {moved} m", integrator.name());
    }
}

#[test]
fn implicit_euler_gains_no_energy_under_gravity_alone() {
    for name in course_scenes() {
        let mut scene = with(shipped(&name), Integrator::ImplicitEuler);
        if scene.gravity.is_none() {
            continue;
        }
        scene.drag = None;
        let mut simulation = build(&scene);
        let mut before = simulation.energies().total();
        for step in 1..=STEPS {
            simulation.step().unwrap();
            let energies = simulation.energies();
            let rounding = 1e-12 * (energies.kinetic + energies.potential.abs());
            assert!(energies.total() <= before + rounding, "{name}: {before} J, then {energies:?} in step {step}");
            before = energies.total();
        }
        assert!(before < 0.0, "{name}: nothing has sagged");
    }
}

#[test]
fn implicit_euler_gains_no_more_energy_than_the_work_of_the_drag() {
    for name in course_scenes() {
        assert_gains_no_more_than_work(&with(shipped(&name), Integrator::ImplicitEuler));
    }
}

/// Asserts that the energy grows by no more than the work of the drag. The target of the spring jumps to its place at the end of a step,
/// which changes the energy of the spring by that work; the step itself can only lose energy.
fn assert_gains_no_more_than_work(scene: &Scene) {
    let drag = body(scene, &data()).unwrap().drag.unwrap();
    let mut simulation = build(scene);
    let rest = simulation.shape().mesh.vertices()[drag.node];
    let spring = |x: &Vector3<f64>, time: f64| {
        let swing = drag.amplitude * (std::f64::consts::TAU * drag.frequency * time).sin();
        0.5 * drag.stiffness * (x - rest - drag.direction * swing).norm_squared()
    };
    let mut work = 0.0;
    for step in 1..=STEPS {
        let x = Vector3::from_column_slice(&simulation.positions().as_slice()[3 * drag.node..3 * drag.node + 3]);
        let t = simulation.time();
        work += spring(&x, t + simulation.dt()) - spring(&x, t);
        simulation.step().unwrap();
        let total = simulation.energies().total();
        assert!(total <= work + 1e-9 * work.abs(), "{}: {total} J from {work} J in step {step}", scene.name);
    }
    assert!(work > 0.0);
}

#[test]
fn a_body_under_gravity_comes_to_rest_at_a_lower_energy() {
    for integrator in INTEGRATORS {
        let mut scene = with(shipped("bunny-engine"), integrator);
        (scene.pipeline, scene.drag) = (Pipeline::Course, None);
        scene.time.dt = Some(0.1);
        let mut simulation = build(&scene);
        (0..100).for_each(|_| simulation.step().unwrap());
        let energies = simulation.energies();
        assert!(energies.kinetic < 1e-9 && energies.potential < 0.0, "{}: {energies:?}", integrator.name());
    }
}

fn every_scene_and_integrator() -> Vec<(String, Integrator)> {
    let pair = |name: String| INTEGRATORS.map(|integrator| (name.clone(), integrator));
    course_scenes().into_iter().flat_map(pair).collect()
}
