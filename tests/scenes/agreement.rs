//! The course's pipeline and the engine compute the same motion, though they share no element, no assembly and no solver.

use fem_scene::simulation::Simulation;
use fem_scene::{Integrator, body};

use crate::program::data;
use crate::scene_text::{build, shipped};

const STEPS: usize = 100;

/// Largest distance of a coordinate in any of the steps of `name` and `name-engine`, as a part of the body's size.
fn largest_distance(name: &str, integrator: Integrator, amplitude: f64) -> f64 {
    let [course_scene, engine_scene] = [name.to_owned(), format!("{name}-engine")].map(|name| {
        let mut scene = shipped(&name);
        scene.time.integrator = integrator;
        scene.drag.as_mut().unwrap().amplitude = amplitude;
        scene
    });
    let mut course = build(&course_scene);
    let engine_body = body(&engine_scene, &data()).unwrap();
    let mut engine = fem_engine::simulator::build(&engine_scene, engine_body).unwrap();
    let V = &course.shape().mesh.vertices;
    let (least, most) = V.iter().fold((V[0], V[0]), |(least, most), x| (least.inf(x), most.sup(x)));
    let mut largest: f64 = 0.0;
    for step in 1..=STEPS {
        course.step().unwrap_or_else(|failure| panic!("{name}, course: {failure}"));
        engine.step().unwrap_or_else(|failure| panic!("{name}, engine: {failure}"));
        let distance = (course.positions() - engine.positions()).amax();
        assert!(distance.is_finite(), "{name}: step {step}");
        largest = largest.max(distance);
    }
    assert_eq!(engine.counters().unconverged_steps, 0);
    largest / (most - least).max()
}

/// The course's Newton method ends after five steps, converged or not. With the scene's pull of 0.2 m it leaves the stiff bunny
/// 2.2e-7 of its size from where the engine and another program, both converged, have it; with a gentler one it converges.
#[test]
fn by_implicit_euler_the_course_and_the_engine_move_armadillo_and_bunny_alike() {
    for (name, amplitude) in [("arma", 0.2), ("bunny", 0.02)] {
        let distance = largest_distance(name, Integrator::ImplicitEuler, amplitude);
        assert!(distance <= 1e-8, "{name}: {distance:.2e} of the body's size");
    }
}

/// Linearly implicit Euler solves with the stiffness once, so what the stiffness is changes the motion: the course projects
/// every element's, the engine takes it as it is while it can be factorised.
#[test]
fn by_linearly_implicit_euler_they_differ_by_the_projection_of_the_stiffness() {
    let distance = largest_distance("bunny", Integrator::LinearlyImplicitEuler, 0.2);
    assert!((1e-6..1e-3).contains(&distance), "{distance:.2e} of the body's size");
}
