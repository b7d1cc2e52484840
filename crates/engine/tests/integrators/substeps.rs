//! Substeps: a step of several is the motion of as many steps.

use fem_model::simulation::least_stable_substeps;

use crate::{DYNAMIC, build, of_law, run, soft};

/// A body that falls onto a plane with friction, clamped nowhere, with flow and damping.
const REST: &str = "[gravity]\nacceleration = [0, -20, 0]\n[damping]\nalpha = 1.0\n[plasticity]\nmodel = \"additive\"\n\
                    yield_strain = 0.01\ncreep = 5.0\n[[planes]]\npoint = [0, -0.01, 0]\nnormal = [0, 1, 0]\nfriction = 0.3\n";

/// Times that are sums of powers of two have no rounding error.
const DT: f64 = 1.0 / 64.0;

fn text(integrator: &str, dt: f64, substeps: usize) -> String {
    let rest = if ["linearly_implicit_euler", "bathe"].contains(&integrator) {
        REST.split("[[planes]]").next().unwrap().to_owned()
    } else {
        REST.to_owned()
    };
    of_law("corotated", &soft(integrator, dt, &format!("substeps = {substeps}\n{rest}")))
}

#[test]
fn a_step_of_four_substeps_is_four_steps_of_a_quarter_of_the_time() {
    for integrator in DYNAMIC {
        let (mut whole, mut parts) = (build(&text(integrator, DT, 4)), build(&text(integrator, DT / 4.0, 1)));
        run(&mut *whole, 6);
        run(&mut *parts, 24);
        assert_eq!(whole.positions(), parts.positions(), "{integrator}");
        assert_eq!(whole.velocities(), parts.velocities(), "{integrator}");
        assert_eq!((whole.time(), whole.steps()), (parts.time(), 6), "{integrator}");
        let dissipated = |of: &dyn fem_model::simulation::Simulation| of.plastic_flow().map(|flow| flow.dissipated);
        assert_eq!(dissipated(&*whole), dissipated(&*parts), "{integrator}");
        assert_eq!(whole.counters().newton_iterations, parts.counters().newton_iterations, "{integrator}");
    }
}

#[test]
fn the_number_of_substeps_changes_while_it_runs() {
    let mut simulation = build(&text("verlet", DT, 1));
    simulation.set_parameter("substeps", 8.0).unwrap();
    let mut expected = build(&text("verlet", DT, 8));
    run(&mut *simulation, 3);
    run(&mut *expected, 3);
    assert_eq!((simulation.substeps(), simulation.positions()), (8, expected.positions()));
    assert!(simulation.set_parameter("substeps", 0.0).is_err());
}

#[test]
fn the_least_number_of_substeps_is_stable_and_one_less_is_not() {
    let scene = |substeps| of_law("linear", &soft("semi_implicit_euler", 0.125, &format!("substeps = {substeps}\n")));
    let scene = |substeps| {
        scene(substeps) + "[gravity]\nacceleration = [0, -20, 0]\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n"
    };
    let simulation = build(&scene(1));
    let least = least_stable_substeps(0.125, simulation.critical_time_step().unwrap());
    assert!(least > 2, "{least} substeps");
    run(&mut *build(&scene(least)), 400);
    let mut unstable = build(&scene(least - 1));
    assert!((0..400).any(|_| unstable.step().is_err()), "{} substeps are stable", least - 1);
}

#[test]
fn a_failed_substep_leaves_the_last_good_state() {
    let mut simulation = build(&text("verlet", 4.0, 3));
    let failure = (0..100).find_map(|_| simulation.step().err()).expect("steps beyond the critical time step");
    assert!(simulation.positions().iter().all(|x| x.is_finite()), "{failure}");
    assert!(failure.time > simulation.time(), "{failure}");
}
