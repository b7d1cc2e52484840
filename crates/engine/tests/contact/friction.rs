//! Coulomb friction on an incline: a floor under a tilted gravity.

use fem_engine::simulator::Simulator;

use crate::{METHODS, SQUARE, build, centre, floor, gravity, momentum, run, text};

const G: f64 = 9.81;
const FRICTION: f64 = 0.4;

/// Without it explicit Euler is unstable; it leaves rigid motions alone.
const DAMPING: &str = "[damping]\nbeta = 2e-3\n";

/// Velocity along the floor of the body's mass of 1000 kg, m/s.
fn speed(simulation: &Simulator<f64>) -> f64 {
    momentum(simulation)[0] / 1000.0
}

/// A stiff square on an incline of tan θ = `factor` μ, that slides down with an initial velocity, m/s.
fn incline(method: &str, dt: f64, factor: f64, velocity: f64) -> String {
    let angle = (factor * FRICTION).atan();
    let start = format!("[[initial_velocity]]\nvelocity = [{velocity:e}, 0, 0]\n");
    let gap = if method == "implicit_euler" { 9e-4 } else { 0.0 };
    let tables =
        gravity(G * angle.sin(), -G * angle.cos()) + &floor(-gap, &format!("friction = {FRICTION}")) + &start + DAMPING;
    text(SQUARE, "corotated", 1e7, method, dt, &tables)
}

fn step_of(method: &str) -> f64 {
    match method {
        "implicit_euler" => 5e-3,
        // Its vibrations die out slowly, and rock the body.
        "explicit_euler" => 5e-5,
        _ => 5e-4,
    }
}

#[test]
fn below_the_angle_of_friction_a_body_creeps_slower_than_the_transition_speed_or_sticks() {
    for method in METHODS {
        let dt = step_of(method);
        let mut simulation = build(&incline(method, dt, 0.99, 0.0));
        run(&mut simulation, (2.0 / dt) as usize);
        let before = centre(&simulation)[0];
        run(&mut simulation, (1.0 / dt) as usize);
        let creep = centre(&simulation)[0] - before;
        // ε_v is 1e-3 lengths a second.
        assert!(creep.abs() <= 1e-3, "{method}: {creep:e} m in a second");
    }
}

#[test]
fn above_the_angle_of_friction_a_body_accelerates_by_the_difference() {
    for method in METHODS {
        let dt = step_of(method);
        for factor in [1.01, 2.0] {
            let mut simulation = build(&incline(method, dt, factor, 0.2));
            run(&mut simulation, (0.2 / dt) as usize);
            let before = speed(&simulation);
            run(&mut simulation, (1.0 / dt) as usize);
            let angle = (factor * FRICTION).atan();
            let expected = G * (angle.sin() - FRICTION * angle.cos());
            let found = speed(&simulation) - before;
            assert!((found - expected).abs() < 0.01 * expected, "{method}, {factor}: {found} and {expected} m/s²");
        }
    }
}

/// The way to rest from 1 m/s on a level floor, m.
fn way(method: &str, dt: f64) -> f64 {
    let mut simulation = build(&incline(method, dt, 0.0, 1.0));
    let before = centre(&simulation)[0];
    run(&mut simulation, (0.4 / dt) as usize);
    // What is left is a decaying shear vibration.
    assert!(speed(&simulation).abs() < 0.02, "{method}: still {} m/s", speed(&simulation));
    centre(&simulation)[0] - before
}

#[test]
fn a_sliding_body_stops_after_v_squared_over_2_mu_g_with_any_number_of_substeps() {
    let expected = 1.0 / (2.0 * FRICTION * G);
    for method in METHODS {
        // One, ten and forty substeps of a frame.
        let frame = 2.0 * step_of(method);
        let substeps = if method == "implicit_euler" { [1.0, 10.0, 40.0] } else { [1.0, 4.0, 10.0] };
        let ways = substeps.map(|substeps| way(method, frame / substeps));
        for way in &ways[1..] {
            assert!((way - expected).abs() < 0.01 * expected, "{method}: {ways:?} and not {expected}");
        }
        assert!((ways[0] - expected).abs() < 0.05 * expected, "{method}: {ways:?} and not {expected}");
    }
}

#[test]
fn a_moving_floor_carries_a_body_along() {
    for method in METHODS {
        let dt = step_of(method);
        let plane = floor(-9e-4, "friction = 0.4\nvelocity = [0.5, 0, 0]\nuntil = 1.0");
        let mut simulation = build(&text(SQUARE, "corotated", 1e7, method, dt, &(gravity(0.0, -G) + &plane + DAMPING)));
        run(&mut simulation, (0.8 / dt) as usize);
        assert!((speed(&simulation) - 0.5).abs() < 2e-3, "{method}: {} m/s", speed(&simulation));
        run(&mut simulation, (1.0 / dt) as usize);
        assert!(speed(&simulation).abs() < 2e-3, "{method}: {} m/s after the floor has stopped", speed(&simulation));
    }
}
