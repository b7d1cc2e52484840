//! Free fall, a motion that is known exactly.

use fem_model::simulation::Simulation;

use crate::program::course_scenes;
use crate::scene_text::{INTEGRATORS, build, build_with, edit, free_cube, shipped};

/// After n steps of an implicit method a body that falls from rest is at x0 + g dt² n(n+1)/2.
fn assert_falls_freely(simulation: &mut dyn Simulation, g: [f64; 3], name: &str) {
    let rest = simulation.positions();
    let dt = simulation.dt();
    for n in 1..=40 {
        simulation.step().unwrap();
        let (q, v, n) = (simulation.positions(), simulation.velocities(), f64::from(n));
        for i in 0..q.len() {
            let fallen = g[i % 3] * dt * dt * n * (n + 1.0) / 2.0;
            let scale = rest.amax() + fallen.abs();
            assert!(
                (q[i] - rest[i] - fallen).abs() <= 1e-12 * scale,
                "{name}: coordinate {i} after {n} steps: {}",
                q[i]
            );
            let speed = g[i % 3] * dt * n;
            let fastest = g.iter().fold(0.0, |most: f64, x| most.max(x.abs())) * dt * n;
            assert!((v[i] - speed).abs() <= 1e-11 * fastest, "{name}: velocity {i} after {n} steps: {}", v[i]);
        }
    }
}

#[test]
fn a_free_cube_falls_with_constant_acceleration() {
    let text = edit(&free_cube(), "[time]", "[gravity]\nacceleration = [1.0, -9.81, 0.25]\n[time]");
    for integrator in INTEGRATORS {
        let name = integrator.name();
        assert_falls_freely(&mut build_with(&text, integrator), [1.0, -9.81, 0.25], name);
    }
}

#[test]
fn every_shipped_body_falls_freely_without_constraints() {
    for name in course_scenes() {
        for integrator in INTEGRATORS {
            let mut scene = shipped(&name);
            (scene.fixed, scene.drag, scene.time.integrator) = (None, None, integrator);
            let Some(g) = scene.gravity.as_ref().map(|gravity| gravity.acceleration) else { continue };
            assert_falls_freely(&mut build(&scene), g, &format!("{name}, {}", integrator.name()));
        }
    }
}
