//! Motions that grow without bound end at the step in which it shows; motions that are driven hard do not.

use fem_model::Law;
use fem_model::simulation::{Cause, Failure};

use crate::{DYNAMIC, build, of_law, run, side, soft};

const FALLING: &str = "[gravity]\nacceleration = [0, -20, 0]\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";
const LUMPED: &str = "[mass]\nlumped = true\n";

/// The failure within so many steps of a scene of a law; panics without one.
fn failure(law: &str, text: &str, steps: usize) -> Failure {
    let mut simulation = build(&of_law(law, text));
    (0..steps)
        .find_map(|_| simulation.step().err())
        .map(|failure| failure.with_critical_time_step(simulation.critical_time_step()))
        .unwrap_or_else(|| panic!("{law}: {} steps without a failure\n{text}", steps))
}

/// The critical time step of a scene, s.
fn critical(law: &str, text: &str) -> f64 {
    build(&of_law(law, text)).critical_time_step().expect("an explicit method of a stiff body")
}

#[test]
fn a_time_step_far_beyond_the_critical_one_fails_for_every_law_and_explicit_method() {
    for law in Law::FACTS.iter().map(|facts| &facts.name) {
        for integrator in &DYNAMIC[..5] {
            for mass in ["", LUMPED] {
                let text = soft(integrator, 0.3, &format!("{FALLING}{mass}"));
                let failure = failure(law, &text, 20);
                match failure.cause {
                    Cause::EnergyGained { gained, turned_over } => {
                        assert!(gained > 0.05 * turned_over, "{law}, {integrator}: {failure}");
                        // Forces that grow with a higher power of the strain leap within one step.
                        let grows_linearly = ["linear", "corotated"].contains(law);
                        assert!(!grows_linearly || gained < 1e12 * turned_over, "{law}, {integrator}: {failure}");
                    }
                    Cause::Inverted { .. } | Cause::NotFinite { .. } => {}
                    cause => panic!("{law}, {integrator}: {cause:?}"),
                }
                let said = failure.to_string();
                assert!(said.contains("critical time step") || said.contains("unstable at any time step"), "{said}");
            }
        }
    }
}

#[test]
fn a_linear_body_does_not_run_on_to_absurd_energies() {
    for (integrator, dt, young) in [("verlet", 0.1, "1e5"), ("explicit_euler", 1e-2, "1e9"), ("rk2", 1e-2, "1e9")] {
        let text =
            of_law("linear", &soft(integrator, dt, FALLING)).replace("1e5\npoisson", &format!("{young}\npoisson"));
        let failure = failure("linear", &text, 10);
        assert!(matches!(failure.cause, Cause::EnergyGained { .. }), "{integrator}: {failure}");
        assert!(failure.step <= 5, "{integrator}: {failure}");
    }
}

#[test]
fn small_vibrations_are_stable_below_the_critical_time_step_and_grow_above_it() {
    let methods = ["semi_implicit_euler", "verlet", "rk4"].map(|integrator| (integrator, ""));
    let newmark = ["beta = 0.083333333333", "gamma = 0.7\nbeta = 0.2"].map(|values| ("newmark", values));
    for (integrator, values) in methods.into_iter().chain(newmark) {
        let table = if values.is_empty() { String::new() } else { format!("[newmark]\n{values}\n") };
        for rest in ["", LUMPED, "[damping]\nbeta = 2e-3\n", "[damping]\nalpha = 3\n"] {
            let text = |dt: f64| of_law("linear", &soft(integrator, dt, &format!("{FALLING}{rest}{table}")));
            let critical = critical("linear", &text(1e-3));
            run(&mut *build(&text(0.99 * critical)), 3000);
            let mut above = build(&text(1.03 * critical));
            let step = (0..3000).find(|_| above.step().is_err());
            assert!(step.is_some(), "{integrator} {rest:?}: {critical:e} s");
        }
    }
}

#[test]
fn a_slow_explosion_ends_before_its_energy_is_a_hundred_times_the_supplied_one() {
    for integrator in &DYNAMIC[..5] {
        let text = |dt: f64| of_law("linear", &soft(integrator, dt, FALLING));
        let dt = match critical("linear", &text(1e-3)) {
            0.0 => critical("linear", &soft("verlet", 1e-3, FALLING)) / 5.0,
            critical => 1.02 * critical,
        };
        let mut simulation = build(&text(dt));
        let failure = (0..100_000).find_map(|_| simulation.step().err()).expect("a failure");
        let Cause::EnergyGained { gained, turned_over } = failure.cause else { panic!("{integrator}: {failure}") };
        assert!(gained < 100.0 * turned_over, "{integrator}: {failure}");
    }
}

#[test]
fn a_method_without_a_stable_time_step_says_so() {
    for integrator in ["explicit_euler", "rk2"] {
        assert_eq!(critical("linear", &soft(integrator, 1e-3, FALLING)), 0.0);
        let damped = critical("linear", &soft(integrator, 1e-3, &format!("{FALLING}[damping]\nbeta = 2e-3\n")));
        assert!(damped > 0.0, "{integrator}");
    }
    for integrator in ["linearly_implicit_euler", "implicit_euler", "static"] {
        assert_eq!(build(&soft(integrator, 1e-3, FALLING)).critical_time_step(), None);
    }
}

#[test]
fn driven_motions_are_no_explosions() {
    let clamp = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n";
    let drag = "[drag]\nvertex = 11\nstiffness = 1e4\ndirection = [0, 1, 0]\namplitude = 0.5\nfrequency = 3\n";
    let pressure = "[[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\npressure = -2e3\n";
    let dead = "[[traction]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\nforce_per_area = [0, 2e3, 0]\n";
    let slow = format!("{dead}curve = {{ ramp = 0.3 }}\n");
    let dropped = format!("{dead}curve = {{ off = 0.4 }}\n");
    let at_once = side("x", "max", 0.5);
    let slowly = format!("{at_once}over = 0.5\n");
    let spun = "[[prescribed]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\n\
                rotation = { axis = \"x\", center = [0, 0.5, 0.5], turns = 0.3 }\nover = 0.4\n";
    for integrator in &DYNAMIC[..6] {
        for (name, driven) in [
            ("drag", drag),
            ("pressure", pressure),
            ("dead", dead),
            ("slow", &slow),
            ("dropped", &dropped),
            ("once", &at_once),
            ("slowly", &slowly),
            ("spun", spun),
        ] {
            let text = of_law(
                "corotated",
                &soft(integrator, 5e-4, &format!("{clamp}{driven}[damping]\nalpha = 2\nbeta = 2e-3\n")),
            );
            let mut simulation = build(&text);
            for _ in 0..1500 {
                simulation.step().unwrap_or_else(|failure| panic!("{integrator}, {name}: {failure}"));
            }
        }
    }
}

#[test]
fn a_free_fall_from_rest_is_no_explosion() {
    for integrator in DYNAMIC {
        let mut simulation = build(&soft(integrator, 1e-2, "[gravity]\nacceleration = [0, -9.81, 0]\n"));
        run(&mut *simulation, 200);
    }
}
