//! Momentum, angular momentum and energy of a free body.

use fem_model::simulation::{Pull, Simulation};
use nalgebra::Vector3;

use crate::{DYNAMIC, build, node_masses, run, soft};

const LUMPED: &str = "[mass]\nlumped = true\n";

/// A free body that a hand has pulled at a corner and let go.
fn thrown(integrator: &str, dt: f64, rest: &str) -> Box<dyn Simulation> {
    let mut simulation = build(&soft(integrator, dt, rest));
    simulation.set_parameter("drag", 5e3).unwrap();
    let anchors = vec![(11, Vector3::new(2.0, 1.0, 1.0))];
    simulation.pull(Some(Pull { anchors, offset: Vector3::new(0.1, 0.3, -0.2) }));
    run(&mut *simulation, (0.1 / dt) as usize);
    simulation.pull(None);
    simulation
}

fn node(values: &nalgebra::DVector<f64>, node: usize) -> Vector3<f64> {
    values.fixed_rows::<3>(3 * node).into()
}

/// Σ m v, Σ m x × v, and Σ m |v| to measure them by.
fn momenta(simulation: &dyn Simulation) -> (Vector3<f64>, Vector3<f64>, f64) {
    let (x, v) = (simulation.positions(), simulation.velocities());
    let masses = node_masses(simulation, 1000.0);
    let mut sums = (Vector3::zeros(), Vector3::zeros(), 0.0);
    for (i, m) in masses.into_iter().enumerate() {
        sums.0 += m * node(&v, i);
        sums.1 += m * node(&x, i).cross(&node(&v, i));
        sums.2 += m * node(&v, i).norm();
    }
    sums
}

#[test]
fn every_method_keeps_the_momentum_of_a_free_body() {
    for integrator in DYNAMIC {
        for rest in ["", LUMPED, "[damping]\nbeta = 1e-3\n"] {
            // Explicit Euler gains energy in every step.
            let accepted = if integrator == "explicit_euler" { "[energy]\naccept_gain = true\n" } else { "" };
            let mut simulation = thrown(integrator, 5e-4, &format!("{rest}{accepted}"));
            let (before, _, scale) = momenta(&*simulation);
            run(&mut *simulation, 1000);
            let change = (momenta(&*simulation).0 - before).amax() / scale;
            assert!(change < 1e-12, "{integrator} {rest:?}: {change:e}");
        }
    }
}

#[test]
fn symplectic_methods_keep_angular_momentum_and_rk4_nearly_so() {
    for (integrator, tolerance) in [("verlet", 1e-12), ("semi_implicit_euler", 1e-12), ("rk4", 1e-8)] {
        let mut simulation = thrown(integrator, 1e-3, LUMPED);
        let (_, before, scale) = momenta(&*simulation);
        run(&mut *simulation, 1000);
        let change = (momenta(&*simulation).1 - before).amax() / scale;
        assert!(change < tolerance, "{integrator}: {change:e}");
    }
}

#[test]
fn the_energy_of_verlet_swings_and_does_not_drift() {
    let mut simulation = thrown("verlet", 1e-3, "");
    let start = simulation.energies().total();
    let mut means = [0.0; 2];
    for step in 0..10_000 {
        simulation.step().unwrap();
        let part = simulation.energies().total() / start - 1.0;
        assert!(part.abs() < 0.01, "step {step}: {part}");
        means[step / 5000] += part / 5000.0;
    }
    assert!((means[1] - means[0]).abs() < 2e-4, "{means:?}");
}
