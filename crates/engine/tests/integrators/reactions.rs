//! Reactions at constrained nodes.

use crate::{DYNAMIC, build, node_masses, run, soft};

const WEIGHT: &str = "[gravity]\nacceleration = [1, -3, 2]\n";
const CLAMP: &str = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";

#[test]
fn at_equilibrium_reactions_balance_the_loads() {
    let traction = "[[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\nforce_per_area = [0, 500, 0]\n";
    let newton = "[newton]\ntolerance = 1e-14\n";
    let mut simulation = build(&soft("static", 1.0, &format!("{WEIGHT}{CLAMP}{traction}{newton}")));
    run(&mut *simulation, 1);
    let reactions = simulation.reactions();
    assert_eq!((reactions.len(), reactions[0].name.as_str()), (1, "fixed"));
    for (force, expected) in reactions[0].force.iter().zip([-2000.0, 6000.0 - 500.0, -4000.0]) {
        assert!((force - expected).abs() < 1e-10 * 6000.0, "{reactions:?}");
    }
}

#[test]
fn in_motion_reactions_and_loads_change_the_momentum() {
    for integrator in [
        "implicit_euler",
        "implicit_midpoint",
        "linearly_implicit_euler",
        "verlet",
        "newmark",
        "generalized_alpha",
        "bdf2",
        "bathe",
    ] {
        for rest in ["", "[mass]\nlumped = true\n", "[damping]\nbeta = 1e-2\n"] {
            let mut simulation = build(&soft(integrator, 1e-4, &format!("{WEIGHT}{CLAMP}{rest}")));
            let masses = node_masses(&*simulation, 1000.0);
            run(&mut *simulation, 20);
            let momentum = |v: nalgebra::DVector<f64>, i: usize| -> f64 {
                masses.iter().enumerate().map(|(node, m)| m * v[3 * node + i]).sum()
            };
            let before = simulation.velocities();
            run(&mut *simulation, 1);
            let reaction = &simulation.reactions()[0];
            for (i, gravity) in [1.0, -3.0, 2.0].into_iter().enumerate() {
                let change = (momentum(simulation.velocities(), i) - momentum(before.clone(), i)) / 1e-4;
                let error = (reaction.force[i] - (change - 2000.0 * gravity)).abs() / 6000.0;
                // The other methods have their accelerations at other moments than the mean of the step.
                let tolerance = if integrator.starts_with("implicit") { 1e-8 } else { 2e-2 };
                assert!(error < tolerance, "{integrator} {rest:?}: {error:e}");
            }
        }
    }
}

#[test]
fn an_unconstrained_body_has_no_reactions() {
    for integrator in DYNAMIC {
        let mut simulation = build(&soft(integrator, 1e-3, WEIGHT));
        assert!(simulation.reactions().is_empty());
        run(&mut *simulation, 1);
        assert!(simulation.reactions().is_empty());
    }
}

#[test]
fn the_nodal_forces_of_the_undeformed_body_are_its_weight() {
    let simulation = build(&soft("implicit_euler", 1e-3, &format!("{WEIGHT}{CLAMP}")));
    let (forces, masses) = (simulation.nodal_forces().unwrap(), node_masses(&*simulation, 1000.0));
    for (i, gravity) in [1.0, -3.0, 2.0].into_iter().enumerate() {
        let largest = masses.iter().enumerate().map(|(node, mass)| (forces[3 * node + i] - mass * gravity).abs());
        assert!(largest.fold(0.0, f64::max) < 1e-9, "{forces}");
    }
}

#[test]
fn in_equilibrium_nodal_forces_are_zero_at_free_nodes_and_minus_the_reactions_at_fixed_ones() {
    let newton = "[newton]\ntolerance = 1e-14\n";
    let mut simulation = build(&soft("static", 1.0, &format!("{WEIGHT}{CLAMP}{newton}")));
    assert_eq!(simulation.nodal_forces().unwrap().amax(), 0.0, "no load acts before the first load step");
    run(&mut *simulation, 1);
    let forces = simulation.nodal_forces().unwrap();
    let reaction = &simulation.reactions()[0].force;
    for i in 0..3 {
        let fixed: f64 = [0, 3, 6, 9].iter().map(|node| forces[3 * node + i]).sum();
        assert!((fixed + reaction[i]).abs() < 1e-10 * 6000.0, "{fixed} {reaction:?}");
    }
    let free = (0..12).filter(|node| node % 3 > 0).flat_map(|node| (0..3).map(move |i| 3 * node + i));
    let largest = free.map(|i| forces[i].abs()).fold(0.0, f64::max);
    assert!(largest < 1e-9 * 6000.0, "{largest:e}");
}

/// The box with all nodes of its end of smallest x moving at a velocity.
fn pushed(integrator: &str, dt: f64, motion: &str) -> String {
    let end = "[[prescribed]]\non = { axis = \"x\", side = \"min\", within = 1e-9 }\n";
    soft(integrator, dt, &format!("{end}{motion}\n"))
}

#[test]
fn a_body_whose_nodes_all_have_one_velocity_moves_rigidly_without_force() {
    for integrator in DYNAMIC {
        let all = "[[prescribed]]\non = \"all\"\nvelocity = [0.5, -1, 0.25]\n";
        let mut simulation = build(&soft(integrator, 1e-2, all));
        let start = simulation.positions();
        run(&mut *simulation, 30);
        let moved = simulation.positions() - start;
        let expected = [0.15, -0.3, 0.075];
        assert!((0..moved.len()).all(|i| (moved[i] - expected[i % 3]).abs() < 1e-13), "{integrator}");
        assert!(simulation.velocities().iter().enumerate().all(|(i, v)| (v - expected[i % 3] / 0.3).abs() < 1e-12));
        let force = simulation.reactions()[0].force;
        assert!(force.iter().all(|force| force.abs() < 1e-6), "{integrator}: {force:?}");
    }
}

#[test]
fn the_reaction_at_a_prescribed_velocity_is_the_rate_of_the_momentum() {
    let curve = "velocity = [1, 0, 0.5]\ncurve = { table = [[0, 0], [0.1, 1], [0.15, -0.5]] }";
    for integrator in ["implicit_euler", "linearly_implicit_euler", "verlet"] {
        let mut simulation = build(&pushed(integrator, 1e-4, curve));
        let (masses, start) = (node_masses(&*simulation, 1000.0), simulation.positions());
        let steps = 1200;
        let momentum = |v: &nalgebra::DVector<f64>, i: usize| -> f64 {
            masses.iter().enumerate().map(|(node, m)| m * v[3 * node + i]).sum()
        };
        let mut impulse = 0.0;
        for _ in 0..steps {
            run(&mut *simulation, 1);
            impulse += 1e-4 * simulation.reactions()[0].force[0];
        }
        let gained = momentum(&simulation.velocities(), 0);
        assert!((impulse - gained).abs() < 5e-3 * gained.abs(), "{integrator}: {impulse} N s for {gained} N s");
        // ∫ of the curve to 0.12 s: 0.05 + (1 + 0.4)/2 · 0.02.
        let moved = simulation.positions()[0] - start[0];
        assert!((moved - 0.064).abs() < 1e-12, "{integrator}: {moved} m");
    }
}
