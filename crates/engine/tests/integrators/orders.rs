//! Orders of convergence in time, and free fall.

use nalgebra::DVector;

use crate::{build, distance, of_kuhn, run, soft};

const EXTERNAL: &str = r#"[gravity]
acceleration = [0, -20, 3]
[fixed]
plane = { axis = "x", below = 1e-9 }
[drag]
vertex = 5
stiffness = 2e3
direction = [1, 0, 0.5]
amplitude = 0.3
frequency = 2.0
"#;

/// Positions and velocities after so many steps of 0.2 s in all.
fn end(integrator: &str, steps: usize, rest: &str) -> DVector<f64> {
    let mut simulation = build(&of_kuhn(&soft(integrator, 0.2 / steps as f64, rest)));
    run(&mut *simulation, steps);
    let (q, v) = (simulation.positions(), simulation.velocities());
    DVector::from_iterator(q.len() + v.len(), q.iter().chain(v.iter()).copied())
}

fn assert_order(integrator: &str, order: f64, steps: usize, rest: &str) {
    let reference = end("rk4", 2000, rest);
    let errors = [steps, 2 * steps].map(|steps| distance(&end(integrator, steps, rest), &reference));
    let measured = (errors[0] / errors[1]).log2();
    assert!((measured - order).abs() < 0.1, "{integrator}: order {measured}, errors {errors:?}");
}

#[test]
fn methods_converge_with_their_order_from_a_start_with_acceleration() {
    for (integrator, order, steps) in [
        ("explicit_euler", 1.0, 400),
        ("semi_implicit_euler", 1.0, 400),
        ("linearly_implicit_euler", 1.0, 400),
        ("implicit_euler", 1.0, 400),
        ("rk2", 2.0, 100),
        ("verlet", 2.0, 100),
        ("rk4", 4.0, 50),
    ] {
        assert_order(integrator, order, steps, EXTERNAL);
    }
}

#[test]
fn damping_springs_and_pressure_keep_the_orders() {
    let rest = format!(
        "{EXTERNAL}[damping]\nalpha = 2.0\nbeta = 0.004\n[[springs]]\nnodes = [1, 8]\nstiffness = 3e3\nrest_length = 1\ndamping = 50\n\
        [[traction]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\npressure = 4e3\n"
    );
    for (integrator, order, steps) in [
        ("explicit_euler", 1.0, 400),
        ("semi_implicit_euler", 1.0, 400),
        ("linearly_implicit_euler", 1.0, 400),
        ("implicit_euler", 1.0, 400),
        ("rk2", 2.0, 100),
        ("verlet", 2.0, 100),
        ("rk4", 4.0, 50),
    ] {
        assert_order(integrator, order, steps, &rest);
    }
}

#[test]
fn lumped_masses_keep_the_orders() {
    let rest = format!("{EXTERNAL}[mass]\nlumped = true\n");
    for (integrator, order, steps) in [("semi_implicit_euler", 1.0, 400), ("verlet", 2.0, 100), ("rk4", 4.0, 50)] {
        assert_order(integrator, order, steps, &rest);
    }
}

#[test]
fn free_fall_follows_the_formula_of_each_method() {
    let (dt, steps) = (0.01, 100);
    let n = f64::from(steps);
    for (integrator, sum) in [
        ("explicit_euler", n * (n - 1.0) / 2.0),
        ("semi_implicit_euler", n * (n + 1.0) / 2.0),
        ("rk2", n * n / 2.0),
        ("rk4", n * n / 2.0),
        ("verlet", n * n / 2.0),
        ("linearly_implicit_euler", n * (n + 1.0) / 2.0),
        ("implicit_euler", n * (n + 1.0) / 2.0),
        ("implicit_midpoint", n * n / 2.0),
        ("newmark", n * n / 2.0),
    ] {
        for lumped in [false, true] {
            let rest = format!("[gravity]\nacceleration = [0, -9.81, 0]\n[mass]\nlumped = {lumped}\n");
            let mut simulation = build(&soft(integrator, dt, &rest));
            let start = simulation.positions();
            run(&mut *simulation, steps as usize);
            let fallen = simulation.positions() - start;
            let worst = (0..fallen.len())
                .map(|i| if i % 3 == 1 { fallen[i] + 9.81 * dt * dt * sum } else { fallen[i] })
                .fold(0.0, |worst: f64, error| worst.max(error.abs()));
            assert!(worst < 1e-12 * 9.81 * dt * dt * sum, "{integrator}, lumped {lumped}: {worst:e}");
        }
    }
}
