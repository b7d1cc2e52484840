//! Scenes with `[batch]`: speed, state file, failures, and options that they refuse.

use crate::program::{Desk, assert_names, numbers};

/// Three cubes on the processor.
const CUBES: &str = r#"pipeline = "engine"
[mesh]
box = { size = [1, 1, 1], cells_per_unit = 1 }
[material]
model = "neo_hookean"
young = 1e5
poisson = 0.3
density = 1000
[gravity]
acceleration = [0, 0, -9.81]
[fixed]
plane = { axis = "z", below = 0.1 }
[time]
dt = 2e-3
integrator = "verlet"
steps = 10
[batch]
count = 3
[batch.vary]
young = { from = 1e5, to = 1e7, spacing = "geometric" }
"#;

#[test]
fn the_state_of_a_batch_is_that_of_its_environments_one_by_one() {
    let desk = Desk::with("cubes.toml", CUBES);
    let text = desk.run_well("cubes.toml --headless --state all.json").stdout;
    assert!(text.starts_with("cubes, 3 environments, 10 steps, t = 0.020000 s, on "), "{text}");
    assert!(text.contains(" environment-steps per second"), "{text}");
    let all = desk.json("all.json");
    assert_eq!(all["time"].as_f64(), Some(0.02));
    let environments = all["environments"].as_array().unwrap();
    assert_eq!(environments.len(), 3);
    desk.write("cube.toml", CUBES.split("[batch]").next().unwrap());
    for (environment, young) in environments.iter().zip(["1e5", "1e6", "1e7"]) {
        assert!((environment["young"].as_f64().unwrap() / young.parse::<f64>().unwrap() - 1.0).abs() < 1e-12);
        desk.run_well(&format!("cube.toml --headless --set material.young={young} --state one.json"));
        let one = desk.json("one.json");
        for key in ["q", "qdot"] {
            let pairs = numbers(&environment[key]).into_iter().zip(numbers(&one[key]));
            assert!(pairs.into_iter().all(|(a, b)| (a - b).abs() < 1e-12), "{young}: {key}");
        }
    }
}

#[test]
fn an_environment_that_fails_is_named_after_the_others_have_ended() {
    let desk = Desk::with("cubes.toml", CUBES.replace("to = 1e7", "to = 1e13").replace("steps = 10", "steps = 60"));
    let outcome = desk.run("cubes.toml --headless --state all.json");
    assert_eq!(outcome.code, Some(1), "{outcome:?}");
    assert_names(&outcome.stderr, &["2 of 3 environments failed", "environment 1 (young = 1.0", "in step "]);
    assert_names(&outcome.stderr, &["warning: critical time step"]);
    assert!(!outcome.stdout.contains("per second"), "{outcome:?}");
    let all = desk.json("all.json");
    let state = &all["environments"];
    assert!(numbers(&state[0]["q"]).iter().all(|x| x.is_finite()));
    assert!(state[1]["failure"].as_str().unwrap().contains("; use a time step of"), "{}", state[1]);
    assert!(state[1].get("q").is_none(), "{}", state[1]);
}

#[test]
fn options_for_one_body_are_refused() {
    let desk = Desk::with("cubes.toml", CUBES);
    assert_names(&desk.refused("cubes.toml"), &["[batch]", "add --headless"]);
    for option in ["--resume a.json", "--checkpoint a.json", "--probe 0=a.csv", "--stats a.json", "--energies a.csv"] {
        let name = option.split(' ').next().unwrap();
        assert_names(&desk.refused(&format!("cubes.toml --headless {option}")), &[name, "[batch]", "leave it out"]);
    }
    for option in ["--export a.obj", "--vtu-series a", "--screenshot a.png", "--record a", "--color stress"] {
        let name = option.split(' ').next().unwrap();
        assert_names(&desk.refused(&format!("cubes.toml --headless {option}")), &[name, "[batch]", "leave it out"]);
    }
}

#[test]
fn a_batch_is_explained() {
    let text = Desk::with("cubes.toml", CUBES).run_well("cubes.toml --explain").stdout;
    assert_names(
        &text,
        &["batch: 3 environments on the processor, young from 100000 to 10000000", "critical time step"],
    );
}

#[test]
fn too_many_elements_for_the_memory_are_refused() {
    let desk = Desk::with("cubes.toml", CUBES.replace("cells_per_unit = 1", "cells_per_unit = 8"));
    let message = desk.refused("cubes.toml --headless --set batch.count=65536");
    assert_names(&message, &["batch.count is 65536", "bodies of 3072 elements", "give 5461 at most"]);
}
