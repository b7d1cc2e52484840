//! Adaptive steps: errors in proportion to the tolerance, accurate estimates, saved steps, and typed failures.

use fem_engine::simulator::Simulator;
use fem_model::simulation::{Cause, Diagnostics, Simulation};
use nalgebra::DVector;

use crate::{SECOND_ORDER, build, distance, run, scene, soft, try_build};

const LOADS: &str = "[gravity]\nacceleration = [0, -20, 3]\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";

const NEWTON: &str = "[newton]\ntolerance = 1e-13\n";

/// Longest edge of the body, m.
const LENGTH: f64 = 2.0;

fn adaptive(integrator: &str, dt: f64, tolerance: f64) -> String {
    soft(integrator, dt, &format!("adaptive = {{ tolerance = {tolerance:e} }}\n{LOADS}{NEWTON}"))
}

fn simulator(text: &str) -> Simulator<f64> {
    let scene = scene(text);
    let body = fem_scene::body(&scene, std::path::Path::new("no data")).unwrap();
    Simulator::new(body, &scene.method()).unwrap()
}

fn rows(values: &DVector<f64>) -> Vec<[f64; 3]> {
    values.as_slice().chunks(3).map(|x| [x[0], x[1], x[2]]).collect()
}

#[test]
fn the_true_error_falls_in_proportion_to_the_tolerance() {
    let (dt, steps) = (0.05, 10);
    let mut reference = build(&soft("rk4", dt / 200.0, LOADS));
    run(&mut *reference, 200 * steps);
    for integrator in SECOND_ORDER {
        let mut errors = Vec::new();
        for tolerance in [1e-3, 1e-4, 1e-5] {
            let mut simulation = simulator(&adaptive(integrator, dt, tolerance));
            let mut estimated = 0.0;
            for _ in 0..steps {
                run(&mut simulation, 1);
                estimated += simulation.estimated_error().unwrap();
            }
            let error = distance(&simulation.positions(), &reference.positions());
            let counters = simulation.counters();
            println!(
                "{integrator} {tolerance:e}: error {error:.2e} m, estimated {estimated:.2e} m, {} steps, {} rejected",
                counters.accepted_steps, counters.rejected_steps
            );
            assert!((simulation.time() - reference.time()).abs() < 1e-12, "{integrator}: {} s", simulation.time());
            assert!(estimated <= tolerance * LENGTH * steps as f64, "{integrator} {tolerance:e}");
            // The body moves by several metres, and errors grow with its velocity.
            let ratio = error / (tolerance * LENGTH * steps as f64);
            assert!((0.05..20.0).contains(&ratio), "{integrator} {tolerance:e}: {ratio}");
            assert!(counters.rejected_steps < counters.accepted_steps / 3 + 8, "{integrator}: {counters:?}");
            errors.push(error);
        }
        for pair in errors.windows(2) {
            let part = pair[0] / pair[1];
            assert!((4.0..25.0).contains(&part), "{integrator}: {errors:?}");
        }
    }
}

#[test]
fn the_estimate_is_within_a_factor_of_four_of_the_true_error_of_a_step() {
    for integrator in SECOND_ORDER {
        let dt = 5e-3;
        // Every step is accepted as a whole.
        let mut simulation = simulator(&adaptive(integrator, dt, 0.9));
        let mut exact = simulator(&soft("rk4", dt / 50.0, LOADS));
        let rest = exact.positions();
        run(&mut simulation, 20);
        let mut ratios = Vec::new();
        for _ in 0..40 {
            exact.set_state(&rows(&(simulation.positions() - &rest)), &rows(&simulation.velocities()));
            run(&mut exact, 50);
            run(&mut simulation, 1);
            let error = distance(&simulation.positions(), &exact.positions());
            ratios.push(simulation.estimated_error().unwrap() / error);
        }
        assert_eq!(simulation.counters().rejected_steps, 0);
        ratios.sort_by(f64::total_cmp);
        println!("{integrator}: {:.2} to {:.2}, median {:.2}", ratios[0], ratios[39], ratios[20]);
        assert!(ratios[2] > 0.25 && ratios[37] < 4.0, "{integrator}: {ratios:?}");
    }
}

#[test]
fn a_tolerance_that_no_step_meets_ends_the_run_with_the_remedy() {
    let mut simulation = build(&adaptive("newmark", 0.05, 1e-30));
    let failure = (0..3).find_map(|_| simulation.step().err()).expect("no step is exact");
    assert!(matches!(failure.cause, Cause::SmallestStep { .. }), "{failure}");
    assert!(
        failure.to_string().ends_with("give a larger time.adaptive.tolerance, or loads without jumps"),
        "{failure}"
    );
}

#[test]
fn methods_without_an_estimate_and_substeps_are_refused() {
    let message = |text: &str| match fem_scene::parse(text, std::path::Path::new("folder/name.toml")) {
        Err(error) => error.to_string(),
        Ok(_) => panic!("taken:\n{text}"),
    };
    for integrator in ["implicit_euler", "verlet", "static"] {
        let text = adaptive(integrator, 0.05, 1e-3).replace(NEWTON, "");
        assert!(message(&text).contains("use one of implicit_midpoint, newmark, generalized_alpha, bdf2"));
    }
    let both = adaptive("bdf2", 0.05, 1e-3).replace("adaptive", "substeps = 2\nadaptive");
    assert!(message(&both).contains("time.substeps stands beside time.adaptive"));
    for wrong in ["0.0", "1.5", "nan"] {
        assert!(message(&adaptive("bdf2", 0.05, 1e-3).replace("1e-3 }", &format!("{wrong} }}"))).contains("tolerance"));
    }
    let damped = adaptive("newmark", 0.05, 1e-3) + "[newmark]\ngamma = 0.6\nbeta = 0.4\n";
    assert!(message(&damped).contains("newmark.gamma"));
    assert!(try_build(&adaptive("bdf2", 0.05, 1e-3)).is_ok());
}
