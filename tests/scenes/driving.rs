//! Interaction with a running simulation: reset, parameters, integrators, clicks.

use fem_model::simulation::{Click, Interactive, Pull, Simulation};
use nalgebra::{Matrix4, Perspective3, Point3, Vector3, Vector4};

use crate::program::course_scenes;
use crate::scene_text::{CUBE, INTEGRATORS, build, build_with, edit, free_cube, parse, shipped, without};

#[test]
fn a_reset_returns_to_the_start_and_the_same_motion_follows() {
    for name in course_scenes() {
        let mut simulation = build(&shipped(&name));
        let rest = simulation.positions();
        let run = |simulation: &mut dyn Simulation| {
            (0..5).for_each(|_| simulation.step().unwrap());
            (simulation.positions(), simulation.velocities(), simulation.time())
        };
        let first = run(&mut simulation);
        simulation.reset();
        assert_eq!((simulation.positions(), simulation.time()), (rest, 0.0), "{name}");
        assert_eq!(simulation.velocities().amax(), 0.0, "{name}");
        assert_eq!(run(&mut simulation), first, "{name}");
        assert_eq!(simulation.counters().steps, 10, "{name}: a reset clears the counters");
    }
}

#[test]
fn a_failed_step_keeps_the_last_good_state_and_a_reset_restarts() {
    let mut simulation = build_with(&edit(CUBE, "dt = 0.01", "dt = 1.0"), INTEGRATORS[0]);
    let pull = Pull { anchors: vec![(26, Vector3::new(1.0, 1.0, 1.0))], offset: Vector3::new(-3.0, -3.0, -3.0) };
    simulation.pull(Some(pull));
    simulation.set_parameter("drag", 1e8).unwrap();
    let failure = (0..10).find_map(|_| simulation.step().err()).expect("the cube withstands everything");
    assert!(simulation.positions().iter().all(|x| x.is_finite()) && simulation.min_J().0 > 0.0);
    assert_eq!(simulation.step().unwrap_err(), failure, "a failed step must not change the state");
    simulation.pull(None);
    simulation.reset();
    simulation.step().unwrap();
}

#[test]
fn every_parameter_accepts_its_range_and_refuses_values_outside() {
    let mut simulation = build(&parse(CUBE));
    let parameters = simulation.parameters();
    assert_eq!(parameters.iter().map(|p| p.key).collect::<Vec<_>>(), ["dt", "C", "D", "density", "gravity", "drag"]);
    for parameter in parameters {
        let (low, high) = parameter.range;
        for value in [low, high, 0.5 * (low + high), parameter.value] {
            simulation.set_parameter(parameter.key, value).unwrap();
            let now = simulation.parameters().into_iter().find(|now| now.key == parameter.key).unwrap();
            assert_eq!(now.value, value, "{}", parameter.key);
        }
        let before = simulation.parameters();
        for value in [low - 1.0, high * 1.001, -f64::INFINITY, f64::INFINITY, f64::NAN] {
            let message = simulation.set_parameter(parameter.key, value).expect_err(parameter.key);
            assert!(message.contains(parameter.label) && message.contains("give "), "{message}");
        }
        assert_eq!(simulation.parameters(), before, "a refused value changed something");
    }
}

#[test]
fn a_parameter_that_the_scene_does_not_have_is_refused() {
    let mut simulation = build(&parse(&without(CUBE, "gravity")));
    for key in ["gravity", "viscosity", ""] {
        let message = simulation.set_parameter(key, 1.0).unwrap_err();
        assert!(message.contains(&format!("no parameter {key}")), "{message}");
    }
    assert!(simulation.parameters().iter().all(|parameter| parameter.key != "gravity"));
}

#[test]
fn a_parameter_that_is_set_acts_like_the_same_number_in_the_scene() {
    let edits = [
        ("dt", 0.02, "dt = 0.01", "dt = 0.02"),
        ("C", 2e5, "C = 1e5", "C = 2e5"),
        ("D", 1e6, "D = 4e5", "D = 1e6"),
        ("density", 500.0, "density = 1000.0", "density = 500.0"),
        ("gravity", 3.0, "[0, -9.81, 0]", "[0, -3, 0]"),
        ("drag", 2e5, "stiffness = 1e5", "stiffness = 2e5"),
    ];
    for (key, value, from, to) in edits {
        let (mut set, mut named) = (build(&parse(CUBE)), build(&parse(&edit(CUBE, from, to))));
        set.set_parameter(key, value).unwrap();
        for _ in 0..3 {
            set.step().unwrap();
            named.step().unwrap();
        }
        let difference = (set.positions() - named.positions()).amax();
        assert!(difference <= 1e-13, "{key}: {difference} m apart");
    }
}

#[test]
fn next_integrator_cycles_through_both_integrators() {
    let mut simulation = build(&parse(CUBE));
    assert_eq!(simulation.integrator(), "implicit_euler");
    for expected in ["linearly_implicit_euler", "implicit_euler", "linearly_implicit_euler"] {
        assert_eq!(simulation.next_integrator(), expected);
        assert_eq!(simulation.integrator(), expected);
        simulation.step().unwrap();
    }
}

/// A click in a picture of 800 × 600 pixels, taken from (½, ½, 5) towards −z.
fn click(x: f64, y: f64) -> Click {
    let (eye, target) = (Point3::new(0.5, 0.5, 5.0), Point3::new(0.5, 0.5, 0.0));
    let perspective = Perspective3::new(800.0 / 600.0, 0.6, 0.1, 100.0);
    Click {
        win: Vector3::new(x, y, 0.0),
        view: Matrix4::look_at_rh(&eye, &target, &Vector3::y()),
        proj: perspective.to_homogeneous(),
        viewport: Vector4::new(0.0, 0.0, 800.0, 600.0),
    }
}

#[test]
fn a_click_picks_the_front_of_the_body_and_a_click_beside_it_no_node() {
    let simulation = build(&parse(CUBE));
    let picked = simulation.pick(&click(400.0, 300.0));
    // The middle of the front of 27 nodes is node 22; those of the back are 0 to 8.
    assert!(picked.contains(&22) && picked.iter().all(|&node| node >= 9), "{picked:?}");
    for (x, y) in [(5.0, 5.0), (795.0, 300.0), (400.0, 595.0)] {
        assert_eq!(simulation.pick(&click(x, y)), [0; 0], "({x}, {y}) lies beside the cube");
    }
}

#[test]
fn a_click_picks_the_deformed_body() {
    let text = edit(&free_cube(), "[time]", "[gravity]\nacceleration = [0, -9.81, 0]\n[time]");
    let mut simulation = build(&parse(&text));
    assert!(!simulation.pick(&click(400.0, 300.0)).is_empty());
    (0..60).for_each(|_| simulation.step().unwrap());
    assert_eq!(simulation.pick(&click(400.0, 300.0)), [0; 0], "the cube has fallen out of the middle");
}

#[test]
fn two_simulations_of_a_scene_agree_bit_for_bit() {
    for integrator in INTEGRATORS {
        let (mut one, mut other) = (build_with(CUBE, integrator), build_with(CUBE, integrator));
        for _ in 0..20 {
            one.step().unwrap();
            other.step().unwrap();
            assert_eq!((one.positions(), one.velocities()), (other.positions(), other.velocities()));
        }
    }
}
