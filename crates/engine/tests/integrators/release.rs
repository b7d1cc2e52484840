//! Nodes that become free at a time: from then on the body moves as one that was never constrained.

use std::path::Path;

use fem_engine::simulator::Simulator;
use fem_model::simulation::{Diagnostics, Interactive, Simulation};
use nalgebra::Vector3;

use crate::{DYNAMIC, distance, node_masses, run, scene, soft};

const DT: f64 = 1e-3;
const GRAVITY: &str = "[gravity]\nacceleration = [0, -10, 0]\n";

/// Both ends pulled apart along x in 20 steps and kept there for 10; the other directions are free.
const STRETCHED: &str = r#"[[prescribed]]
on = { axis = "x", side = "min", within = 1e-9 }
displacement = [-0.2, 0, 0]
components = ["x"]
over = 0.02
until = 0.03
[[prescribed]]
on = { axis = "x", side = "max", within = 1e-9 }
displacement = [0.2, 0, 0]
components = ["x"]
over = 0.02
until = 0.03
"#;

/// One end fixed for 30 steps.
const DROPPED: &str = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\nuntil = 0.03\n";

fn simulator(integrator: &str, tables: &str) -> Simulator<f64> {
    let scene = scene(&soft(integrator, DT, tables));
    let body = fem_scene::body(&scene, Path::new("no data")).unwrap();
    Simulator::new(body, &scene.method()).unwrap()
}

fn momentum(simulation: &dyn Simulation) -> Vector3<f64> {
    let (v, masses) = (simulation.velocities(), node_masses(simulation, 1000.0));
    masses.iter().enumerate().map(|(i, m)| *m * v.fixed_rows::<3>(3 * i)).sum()
}

fn rows(values: &nalgebra::DVector<f64>) -> Vec<[f64; 3]> {
    values.as_slice().chunks(3).map(|x| [x[0], x[1], x[2]]).collect()
}

#[test]
fn nodes_stay_until_their_time_and_move_in_the_step_after_it() {
    for integrator in DYNAMIC {
        let mut simulation = simulator(integrator, &format!("{DROPPED}{GRAVITY}"));
        let start = simulation.positions();
        run(&mut simulation, 30);
        assert_eq!(simulation.positions().rows(0, 3), start.rows(0, 3), "{integrator}");
        run(&mut simulation, 2);
        assert!((simulation.positions()[1] - start[1]).abs() > 1e-7, "{integrator}: node 0 is still fixed");
    }
}

#[test]
fn a_released_body_moves_as_one_that_was_never_constrained() {
    for integrator in DYNAMIC {
        for tables in [DROPPED, STRETCHED] {
            let mut released = simulator(integrator, &format!("{tables}{GRAVITY}"));
            run(&mut released, 30);
            let mut free = simulator(integrator, GRAVITY);
            let rest = free.positions();
            free.set_state(&rows(&(released.positions() - rest)), &rows(&released.velocities()));
            for simulation in [&mut released, &mut free] {
                run(simulation, 30);
            }
            let apart = distance(&released.positions(), &free.positions());
            assert!(apart < 1e-8, "{integrator}: {apart:e}");
        }
    }
}

#[test]
fn a_released_body_keeps_its_momentum_and_falls_with_gravity() {
    for integrator in DYNAMIC {
        let mut simulation = simulator(integrator, &format!("{STRETCHED}{GRAVITY}"));
        run(&mut simulation, 30);
        let before = momentum(&simulation);
        run(&mut simulation, 50);
        let expected = before + Vector3::new(0.0, -2000.0 * 10.0 * 0.05, 0.0);
        // Pulling at both ends gave momenta of some 2000 kg m/s.
        let found = momentum(&simulation);
        assert!((found - expected).norm() < 1e-9 * 2000.0, "{integrator}: {found} {expected}");
        assert!(simulation.reactions().iter().all(|reaction| reaction.force == [0.0; 3]), "{integrator}");
    }
}

#[test]
fn the_energy_of_a_released_body_does_not_grow() {
    for (integrator, slack) in [("implicit_euler", 1e-9), ("linearly_implicit_euler", 1e-3), ("verlet", 0.01)] {
        let mut simulation = simulator(integrator, STRETCHED);
        run(&mut simulation, 30);
        let stored = simulation.energies().total();
        assert!(stored > 100.0, "{integrator}: {stored} J");
        let mut largest = f64::NEG_INFINITY;
        for _ in 0..300 {
            run(&mut simulation, 1);
            largest = largest.max(simulation.energies().total());
        }
        assert!(largest <= stored * (1.0 + slack), "{integrator}: {stored} J before, {largest} J after");
    }
}

#[test]
fn a_reset_constrains_the_nodes_again() {
    for integrator in DYNAMIC {
        let mut simulation = simulator(integrator, &format!("{STRETCHED}{GRAVITY}"));
        run(&mut simulation, 40);
        let first = simulation.positions();
        simulation.reset();
        run(&mut simulation, 40);
        assert_eq!(simulation.positions(), first, "{integrator}");
    }
}

#[test]
fn a_method_chosen_after_the_release_follows_the_motion_after_a_reset() {
    let mut simulation = simulator("explicit_euler", STRETCHED);
    for _ in DYNAMIC {
        run(&mut simulation, 40);
        simulation.next_integrator();
        simulation.reset();
        run(&mut simulation, 20);
        let moved = simulation.positions()[0];
        assert!((moved + 0.2).abs() < 1e-12, "{}: {moved}", simulation.integrator());
    }
}

#[test]
fn an_explicit_scene_that_is_switched_to_an_implicit_method_moves_as_the_implicit_scene() {
    let table = format!(
        "{GRAVITY}[fixed]\nplane = {{ axis = \"x\", below = 1e-9 }}\n[[springs]]\nnodes = [2, 9]\nstiffness = 1e4\n"
    );
    let mut explicit = simulator("verlet", &table);
    while explicit.next_integrator() != "implicit_euler" {}
    let mut implicit = simulator("implicit_euler", &table);
    run(&mut explicit, 20);
    run(&mut implicit, 20);
    let difference = (explicit.positions() - implicit.positions()).amax();
    assert!(difference < 1e-9, "{difference:e}");
}
