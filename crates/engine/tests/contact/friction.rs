//! Coulomb friction of a moving floor.

use fem_engine::simulator::Simulator;

use crate::{METHODS, SQUARE, build, floor, gravity, is_implicit, momentum, run, text};

const G: f64 = 9.81;

/// Without it explicit Euler is unstable; it leaves rigid motions alone.
const DAMPING: &str = "[damping]\nbeta = 2e-3\n";

/// Velocity along the floor of the body's mass of 1000 kg, m/s.
fn speed(simulation: &Simulator<f64>) -> f64 {
    momentum(simulation)[0] / 1000.0
}

fn step_of(method: &str) -> f64 {
    match method {
        _ if is_implicit(method) => 5e-3,
        // Its vibrations die out slowly, and rock the body.
        "explicit_euler" => 5e-5,
        _ => 5e-4,
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
