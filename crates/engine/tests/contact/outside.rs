//! No node is behind a plane after any step, whatever the method, the law, the precision and the speed.

use fem_engine::simulator;

use crate::{METHODS, floor, gravity, is_implicit, scene, text};

const FLAT: &str = "rectangle = { size = [1, 1], cells_per_unit = 4 }";
const SOLID: &str = "box = { size = [1, 1, 1], cells_per_unit = 2 }";

/// A body that falls spinning into the corner of three planes.
fn falling(mesh: &str, model: &str, method: &str, precision: &str) -> String {
    let slants = "[[planes]]\npoint = [-0.3, 0, 0]\nnormal = [1, 0.4, 0]\nfriction = 0.4\n\
                  [[planes]]\npoint = [1.3, 0, 0]\nnormal = [-2, 1, 0]\nfriction = 0.4\n";
    let start = "[[initial_velocity]]\nvelocity = [0.7, -5, 0]\nangular = { axis = [0, 0, 1], rate = 3 }\n\
                 [damping]\nalpha = 0.5\n";
    let tables = gravity(0.0, -9.81) + &floor(-0.4, "friction = 0.4") + slants + start;
    let (dt, unconverged) = match method {
        _ if is_implicit(method) => (0.01, "[newton]\naccept_unconverged = true\n"),
        // It gains energy in every step.
        "explicit_euler" => (5e-4, "[energy]\naccept_gain = true\n"),
        _ => (5e-4, ""),
    };
    text(mesh, model, 5e4, method, dt, &format!("precision = \"{precision}\"\n{tables}{unconverged}"))
}

/// Runs a fall of so many seconds; returns the unconverged steps.
fn assert_stays_outside(text: &str, seconds: f64) -> usize {
    let scene = scene(text);
    let body = fem_scene::body(&scene, "no data".as_ref()).unwrap();
    let planes = body.contact.as_ref().unwrap().planes.clone();
    let mut simulation = simulator::build(body, &scene.method()).unwrap();
    let mut touched = false;
    while simulation.time() < seconds {
        simulation.step().unwrap_or_else(|failure| panic!("{failure}\n{text}"));
        let q = simulation.positions();
        for plane in &planes {
            for node in 0..q.len() / 3 {
                let x = nalgebra::Vector3::new(q[3 * node], q[3 * node + 1], q[3 * node + 2]);
                let gap = plane.normal.dot(&(x - plane.point));
                assert!(gap > 0.0, "node {node} is {gap:e} m from a plane at {} s\n{text}", simulation.time());
            }
        }
        touched |= simulation.contacts().iter().any(|contact| contact.force[1] > 0.0);
    }
    assert!(touched, "the body has touched no plane\n{text}");
    simulation.counters().unconverged_steps
}

#[test]
fn falling_bodies_stay_outside_the_planes_with_every_method() {
    for method in METHODS {
        for mesh in [FLAT, SOLID] {
            assert_stays_outside(&falling(mesh, "stable_neo_hookean", method, "f64"), 0.6);
        }
        assert_stays_outside(&falling(FLAT, "stable_neo_hookean", method, "f32"), 0.4);
    }
}

#[test]
fn every_step_of_implicit_euler_converges_in_a_fall_of_every_law() {
    for model in fem_model::Law::FACTS.iter().map(|facts| &facts.name) {
        if ["mooney_rivlin", "yeoh", "gent", "ogden"].contains(model) {
            continue;
        }
        let unconverged = assert_stays_outside(&falling(FLAT, model, "implicit_euler", "f64"), 0.6);
        assert_eq!(unconverged, 0, "{model}");
    }
}

#[test]
fn a_body_of_high_speed_is_stopped_too() {
    for speed in [5.0, 20.0] {
        let tables = floor(-0.02, "") + &format!("[[initial_velocity]]\nvelocity = [0, -{speed}, 0]\n");
        let text = text(FLAT, "stable_neo_hookean", 1e6, "implicit_euler", 0.01, &tables);
        assert_stays_outside(&text, 0.1);
    }
}
