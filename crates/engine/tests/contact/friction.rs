//! Coulomb friction of a moving floor.

use fem_engine::simulator::Simulator;
use fem_model::simulation::{Diagnostics, Simulation};

use crate::{METHODS, SQUARE, build, contact_force, floor, gravity, is_implicit, momentum, run, text};

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

/// A block that is pulled over a floor by its side at a speed, m/s, so slowly that it goes a tenth of a millimetre in a step.
fn pulled(speed: f64, rest: &str) -> Simulator<f64> {
    let pull = format!(
        "[[prescribed]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\ncomponents = [\"x\"]\nvelocity = [{speed:e}, 0, 0]\n"
    );
    let tables = gravity(0.0, -G) + &floor(-6e-4, "friction = 0.5") + "[damping]\nalpha = 1\n" + &pull + rest;
    build(&text(
        "box = { size = [1, 0.5, 1], cells_per_unit = 2 }",
        "corotated",
        1e6,
        "implicit_euler",
        1e-4 / speed,
        &tables,
    ))
}

#[test]
fn a_block_that_is_pulled_slides_at_its_full_friction_however_slowly() {
    let weight = 500.0 * G;
    for speed in [1e-2, 1e-4, 1e-6] {
        let mut simulation = pulled(speed, "");
        run(&mut simulation, 150);
        let force = contact_force(&simulation);
        assert!((force[0] + 0.5 * weight).abs() < 1e-3 * weight, "{speed:e} m/s: {force:?}");
        assert!(simulation.warnings().is_empty(), "{speed:e} m/s: {:?}", simulation.warnings());
    }
}

#[test]
fn a_run_below_the_transition_speed_ends_with_a_warning_that_a_resumed_one_repeats() {
    let table = "[contact]\ntransition_speed = 1e-3\n";
    let mut simulation = pulled(1e-4, table);
    run(&mut simulation, 150);
    let warnings = simulation.warnings();
    assert_eq!(warnings.len(), 1);
    for part in ["of 150 steps", "1.000e-3 m/s", "contact.transition_speed", "% of Coulomb's"] {
        assert!(warnings[0].contains(part), "no {part} in {warnings:?}");
    }
    let mut resumed = pulled(1e-4, table);
    resumed.restore(&simulation.checkpoint()).unwrap();
    assert_eq!(resumed.warnings(), warnings);
    resumed.reset();
    assert!(resumed.warnings().is_empty());
}
