//! A result that is not to be trusted does not look like one that is.

use crate::program::Desk;

/// A clamped box that falls; `integrator` and further tables vary.
fn falling(model: &str, time: &str) -> String {
    format!(
        "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [4, 1, 1], cells_per_unit = 1 }}\n\
         [material]\nmodel = \"{model}\"\nyoung = 1e6\npoisson = 0.3\ndensity = 1000\n\
         [gravity]\nacceleration = [0, 0, -9.81]\n[fixed]\nplane = {{ axis = \"x\", below = 1e-9 }}\n[time]\n{time}\n"
    )
}

#[test]
fn an_explosion_ends_with_exit_code_1_and_names_the_critical_time_step() {
    for (model, integrator) in
        [("linear", "verlet"), ("corotated", "semi_implicit_euler"), ("linear", "explicit_euler")]
    {
        let desk = Desk::with("s.toml", falling(model, &format!("dt = 0.1\nintegrator = \"{integrator}\"")));
        let outcome = desk.run("s.toml --headless --steps 10 --stats s.json");
        assert_eq!(outcome.code, Some(1), "{model}, {integrator}: {outcome:?}");
        assert!(
            outcome
                .stderr
                .contains("J from nothing, and initial state, loads, prescribed motions and planes have supplied"),
            "{outcome:?}"
        );
        let remedy = if integrator == "explicit_euler" { "unstable at any time step" } else { "critical time step" };
        assert!(outcome.stderr.contains(remedy), "{outcome:?}");
        let status = desk.json("s.json")["status"].as_str().unwrap().to_owned();
        assert!(status.starts_with("failed: the simulation failed in step"), "{status}");
    }
}

#[test]
fn explain_tells_the_critical_time_step() {
    let desk = Desk::with("s.toml", falling("linear", "dt = 0.1\nintegrator = \"verlet\""));
    let said = desk.run_well("s.toml --explain").stdout;
    assert!(said.contains("critical time step: about") && said.contains("dt is too long"), "{said}");
    let said = desk.run_well("s.toml --explain --dt 1e-4").stdout;
    assert!(said.contains("dt is shorter: stable"), "{said}");
    let said = desk.run_well("s.toml --explain --integrator rk2").stdout;
    assert!(said.contains("critical time step: none"), "{said}");
    let said = desk.run_well("s.toml --explain --integrator implicit_euler").stdout;
    assert!(!said.contains("critical time step"), "{said}");
}

#[test]
fn fewer_steps_than_load_steps_say_how_much_of_the_load_is_on() {
    let text = falling("corotated", "integrator = \"static\"\n[static]\nload_steps = 8");
    let desk = Desk::with("s.toml", text);
    let outcome = desk.run("s.toml --headless --steps 3");
    assert_eq!(outcome.code, Some(0), "{outcome:?}");
    assert!(outcome.stderr.contains("37.5 % of the loads and prescribed motions are on"), "{outcome:?}");
    desk.run_well("s.toml --headless");
}

#[test]
fn inverted_elements_of_a_law_that_allows_them_are_counted_in_a_warning() {
    // The far end is pushed beyond the clamped one.
    let pushed = "[[prescribed]]\non = { axis = \"x\", side = \"max\", within = 1e-9 }\ndisplacement = [-9, 0, 0]\n";
    let text = falling("linear", &format!("integrator = \"static\"\n{pushed}"));
    let outcome = Desk::with("s.toml", text).run("s.toml --headless");
    assert_eq!(outcome.code, Some(0), "{outcome:?}");
    assert!(outcome.stderr.contains("24 elements are inverted (det F ≤ 0), element"), "{outcome:?}");
}

#[test]
fn another_integrator_says_which_tables_it_leaves_out() {
    let desk = Desk::with("s.toml", falling("linear", "integrator = \"static\"\n[static]\nload_steps = 2"));
    let outcome = desk.run("s.toml --headless --integrator implicit_euler --dt 0.01 --steps 2");
    assert_eq!(outcome.code, Some(0), "{outcome:?}");
    assert_eq!(outcome.stderr, "note: [static] of the scene has no effect with implicit_euler\n");
}

#[test]
fn an_explicit_method_lumps_the_mass_of_a_large_body_and_says_so() {
    let large =
        falling("linear", "dt = 1e-5\nintegrator = \"verlet\"").replace("cells_per_unit = 1", "cells_per_unit = 8");
    let desk = Desk::with("s.toml", &large);
    let outcome = desk.run("s.toml --headless --steps 2");
    assert_eq!(outcome.code, Some(0), "{outcome:?}");
    assert!(outcome.stderr.starts_with("note: verlet lumps the mass of so large a body"), "{outcome:?}");
    for other in [format!("{large}[mass]\nlumped = false\n"), large.replace("= 8", "= 2")] {
        desk.write("other.toml", other);
        desk.run_well("other.toml --headless --steps 2");
        assert!(desk.run_well("other.toml --explain").stdout.contains("consistent: couples the nodes"));
    }
}
