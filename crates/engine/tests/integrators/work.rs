//! The work of each method, and its message when it cannot continue.

use fem_model::simulation::Cause;

use crate::{DYNAMIC, build, distance, run, soft};

const FALLING: &str = "[gravity]\nacceleration = [0, -20, 0]\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";

#[test]
fn explicit_methods_assemble_no_stiffness_and_evaluate_no_energy() {
    for (integrator, forces) in
        [("explicit_euler", 10), ("semi_implicit_euler", 10), ("rk2", 20), ("rk4", 40), ("verlet", 11)]
    {
        let mut simulation = build(&soft(integrator, 1e-4, FALLING));
        run(&mut *simulation, 10);
        let counters = simulation.counters();
        assert_eq!(counters.force_assemblies, forces, "{integrator}");
        assert_eq!((counters.stiffness_assemblies, counters.energy_evaluations), (0, 0), "{integrator}");
        assert_eq!((counters.factorizations, counters.symbolic_factorizations), (0, 0), "{integrator}");
        let parts = simulation.parts();
        let built = |name: &str| parts.iter().any(|part| part.name == name && part.built);
        assert!(!built("stiffness") && !built("solver") && !built("damping"), "{integrator}");
    }
}

#[test]
fn linearly_implicit_euler_evaluates_no_energy_and_searches_no_line() {
    let mut simulation = build(&soft("linearly_implicit_euler", 1e-2, FALLING));
    run(&mut *simulation, 10);
    let counters = simulation.counters();
    assert_eq!((counters.energy_evaluations, counters.line_search_backtracks), (0, 0));
    assert_eq!((counters.force_assemblies, counters.stiffness_assemblies, counters.factorizations), (10, 10, 10));
    assert_eq!(counters.symbolic_factorizations, 1);
}

#[test]
fn implicit_euler_analyses_its_pattern_once() {
    let mut simulation = build(&soft("implicit_euler", 1e-2, FALLING));
    run(&mut *simulation, 10);
    assert_eq!(simulation.counters().symbolic_factorizations, 1);
    assert_eq!(simulation.counters().unconverged_steps, 0);
}

#[test]
fn an_explicit_method_that_explodes_names_its_step_and_the_remedy() {
    for integrator in ["explicit_euler", "semi_implicit_euler", "rk2", "rk4", "verlet"] {
        let mut simulation = build(&soft(integrator, 0.5, FALLING));
        let failure = (0..200).find_map(|_| simulation.step().err()).unwrap();
        assert!(!matches!(failure.cause, Cause::Solver(_) | Cause::Stuck { .. }), "{failure}");
        assert!(failure.to_string().contains("s or less, or implicit_euler"), "{failure}");
        assert!(simulation.positions().iter().all(|x| x.is_finite()), "the last good state stays");
        simulation.reset();
        assert_eq!(simulation.time(), 0.0);
    }
}

#[test]
fn prescribed_nodes_are_at_their_prescribed_positions() {
    let prescribed = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n[[prescribed]]\nnodes = [2, 5]\n\
               displacement = [0.2, 0.1, 0]\nover = 0.1\n[[prescribed]]\nnodes = [8]\ncomponents = [\"y\"]\n\
               displacement = [0, 0.1, 0]\nover = 0.1\n";
    let end = |integrator: &str| {
        let mut simulation = build(&soft(integrator, 1e-3, prescribed));
        let start = simulation.positions();
        run(&mut *simulation, 50);
        let moved = simulation.positions() - start;
        for (coordinate, expected) in [(6, 0.1), (7, 0.05), (8, 0.0), (15, 0.1), (25, 0.05), (0, 0.0)] {
            assert!((moved[coordinate] - expected).abs() < 1e-12, "{integrator}: {coordinate}");
        }
        moved
    };
    let reference = end("rk4");
    for integrator in DYNAMIC {
        let difference = distance(&end(integrator), &reference);
        assert!(difference < 6e-3, "{integrator}: {difference:e}");
    }
}

#[test]
fn single_precision_follows_double() {
    for integrator in DYNAMIC {
        let end = |precision: &str| {
            let text = soft(integrator, 1e-3, FALLING)
                .replace("[gravity]", &format!("precision = \"{precision}\"\n[gravity]"));
            let mut simulation = build(&text);
            run(&mut *simulation, 100);
            simulation.positions()
        };
        let difference = distance(&end("f32"), &end("f64"));
        assert!(difference < 1e-4, "{integrator}: {difference:e}");
    }
}

#[test]
fn a_pull_at_a_fixed_node_has_no_effect() {
    let drag = "[drag]\nvertex = 0\nstiffness = 1e3\ndirection = [1, 0, 0]\namplitude = 1\nfrequency = 1\n";
    for integrator in DYNAMIC {
        let end = |rest: &str| {
            let mut simulation = build(&soft(integrator, 1e-4, rest));
            run(&mut *simulation, 5);
            simulation.positions()
        };
        assert_eq!(distance(&end(&format!("{FALLING}{drag}")), &end(FALLING)), 0.0, "{integrator}");
    }
}
