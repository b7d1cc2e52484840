//! The course's pipeline and the engine compute the same motion, although they share no element, assembly or solver code.

use fem_model::Integrator;
use fem_model::simulation::Simulation;
use fem_scene::{Pipeline, Scene, body};

use crate::program::data;
use crate::scene_text::{build, shipped};

const STEPS: usize = 100;

/// Largest distance of a coordinate in any of the steps of `name-engine` in both pipelines, as a part of the body's size. The course's
/// stiffness contains the spring of the drag, as the engine's does.
fn largest_distance(name: &str, integrator: Integrator, amplitude: f64) -> f64 {
    let mut engine_scene = shipped(&format!("{name}-engine"));
    engine_scene.time.integrator = integrator;
    let drag = engine_scene.drag.as_mut().unwrap();
    (drag.amplitude, drag.in_stiffness) = (amplitude, Some(true));
    let course_scene = Scene { pipeline: Pipeline::Course, ..engine_scene.clone() };
    let mut course = build(&course_scene);
    let engine_body = body(&engine_scene, &data()).unwrap();
    let mut engine = fem_engine::simulator::build(engine_body, &engine_scene.method()).unwrap();
    let V = course.shape().mesh.vertices().to_vec();
    let (low, high) = V.iter().fold((V[0], V[0]), |(low, high), x| (low.inf(x), high.sup(x)));
    let mut largest: f64 = 0.0;
    for step in 1..=STEPS {
        course.step().unwrap_or_else(|failure| panic!("{name}, course: {failure}"));
        engine.step().unwrap_or_else(|failure| panic!("{name}, engine: {failure}"));
        let distance = (course.positions() - engine.positions()).amax();
        assert!(distance.is_finite(), "{name}: step {step}");
        largest = largest.max(distance);
    }
    assert_eq!(engine.counters().unconverged_steps, 0);
    largest / (high - low).max()
}

/// The course's Newton method ends after five steps, converged or not. With the scene's pull of 0.2 m it leaves the stiff bunny
/// 2.2e-7 of its size away from the converged solution of the engine and of another program; with a gentler pull it converges.
#[test]
fn course_and_engine_agree_under_implicit_euler() {
    for (name, amplitude) in [("arma", 0.2), ("bunny", 0.02)] {
        let distance = largest_distance(name, Integrator::ImplicitEuler, amplitude);
        assert!(distance <= 1e-8, "{name}: {distance:.2e} of the body's size");
    }
}

/// Linearly implicit Euler solves with the stiffness once, so its projection changes the motion: the course projects every
/// element, the engine uses the exact matrix as long as it can be factorised.
#[test]
fn course_and_engine_differ_by_the_projection_under_linearly_implicit_euler() {
    let distance = largest_distance("bunny", Integrator::LinearlyImplicitEuler, 0.2);
    assert!((1e-6..1e-3).contains(&distance), "{distance:.2e} of the body's size");
}
