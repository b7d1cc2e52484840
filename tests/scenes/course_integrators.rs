//! The two integrators of the course: linearly implicit Euler is enough for the stiff bunny under a gentle pull; the soft
//! armadillo under a harsh pull needs implicit Euler.

use crate::program::{Desk, assert_names, assert_one_message, data, numbers};
use crate::scene_text::{edit, shipped};

/// The shipped armadillo, pulled a metre to and fro twice a second, in long steps.
fn harsh_pull() -> String {
    let text = std::fs::read_to_string(data().join("scenes/arma.toml")).unwrap();
    let edits = [
        ("dt = 0.01", "dt = 0.02"),
        ("stiffness = 1e5", "stiffness = 1e6"),
        ("amplitude = 0.2", "amplitude = 1.0"),
        ("frequency = 1.0", "frequency = 2.0"),
    ];
    edits.iter().fold(text, |text, (from, to)| edit(&text, from, to))
}

#[test]
fn the_bunny_survives_200_steps_of_linearly_implicit_euler() {
    assert_eq!(shipped("bunny").time.integrator.name(), "linearly_implicit_euler");
    let desk = Desk::new();
    desk.run_well("bunny --headless --steps 200 --stats s.json");
    assert_eq!(desk.json("s.json")["status"], "done");
    assert!(desk.json("s.json")["min_J"].as_f64().unwrap() > 0.9);
}

#[test]
fn the_armadillo_survives_a_harsh_pull_under_implicit_euler() {
    let desk = Desk::with("harsh.toml", harsh_pull());
    desk.run_well("harsh.toml --headless --steps 50 --stats s.json");
    let stats = desk.json("s.json");
    assert_eq!((&stats["status"], stats["steps"].as_u64()), (&"done".into(), Some(50)));
    let assemblies = stats["stiffness_assemblies"].as_u64().unwrap();
    assert!(assemblies > 50, "{assemblies}: within a step the body moves far enough for another stiffness");
}

#[test]
fn the_harsh_pull_fails_under_linearly_implicit_euler_with_step_element_and_remedy() {
    let desk = Desk::with("harsh.toml", harsh_pull());
    let files = "--stats s.json --state q.json --energies e.csv --export x.vtu";
    let outcome = desk.run(&format!("harsh.toml --headless --steps 50 --integrator linearly_implicit_euler {files}"));
    assert_eq!(outcome.code, Some(1), "{outcome:?}");
    assert_one_message(&outcome.stderr);
    assert_eq!(outcome.stderr.lines().count(), 1, "{}", outcome.stderr);
    assert_names(&outcome.stderr, &["the simulation failed in step ", " (t = ", "element ", "J = ", "implicit_euler"]);

    let stats = desk.json("s.json");
    let status = stats["status"].as_str().unwrap();
    assert!(status.starts_with("failed: ") && outcome.stderr.contains(&status["failed: ".len()..]), "{status}");
    let finished = stats["steps"].as_u64().unwrap();
    assert!(finished < 50 && outcome.stderr.contains(&format!("step {} ", finished + 1)), "{finished}");

    // The files contain the last good state.
    assert!(stats["min_J"].as_f64().unwrap() > 0.0);
    let state = desk.json("q.json");
    assert!((state["time"].as_f64().unwrap() - 0.02 * finished as f64).abs() < 1e-12);
    for key in ["q", "qdot"] {
        assert!(numbers(&state[key]).iter().all(|number| number.is_finite()));
    }
    assert_eq!(desk.read("e.csv").lines().count() as u64, 2 + finished);
    assert!(desk.path("x.vtu").exists());
}

#[test]
fn a_pull_that_no_method_can_follow_ends_the_run_with_a_message() {
    let far = edit(&harsh_pull(), "amplitude = 1.0", "amplitude = 1e9");
    let desk = Desk::with("far.toml", far);
    let outcome = desk.run("far.toml --headless --steps 5 --stats s.json");
    assert_eq!(outcome.code, Some(1), "{outcome:?}");
    assert_one_message(&outcome.stderr);
    assert_names(&outcome.stderr, &["step", "N are not in balance", "gentler pull"]);
    assert!(desk.json("s.json")["status"].as_str().unwrap().starts_with("failed"));
}
