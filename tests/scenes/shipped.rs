//! Every course scene of `data/scenes`, run by the program and by the library.

use fem_model::simulation::Simulation;

use crate::program::{Desk, course_scenes, data, numbers};
use crate::scene_text::{build, shipped};

const STEPS: usize = 12;

#[test]
fn every_shipped_scene_runs_by_name_and_by_path() {
    for name in course_scenes() {
        let desk = Desk::new();
        let outcome = desk.run_well(&format!("{name} --headless --steps 2 --state by_name.json"));
        assert!(outcome.stdout.starts_with(&format!("{name}, ")), "{}", outcome.stdout);
        let path = data().join("scenes").join(format!("{name}.toml"));
        desk.run_well(&format!("{} --headless --steps 2 --state by_path.json", path.display()));
        assert_eq!(desk.read("by_name.json"), desk.read("by_path.json"));
    }
}

#[test]
fn every_shipped_scene_has_about_and_steps() {
    for name in course_scenes() {
        let scene = shipped(&name);
        assert!(!scene.about.is_empty() && !scene.about.contains('\n'), "{name} has no line `about`");
        assert!(scene.time.steps.is_some(), "{name} has no time.steps");
    }
}

#[test]
fn no_element_of_a_shipped_scene_is_inverted_at_any_step() {
    for name in course_scenes() {
        let mut simulation = build(&shipped(&name));
        for step in 1..=4 * STEPS {
            simulation.step().unwrap_or_else(|failure| panic!("{name}: {failure}"));
            let (J, element) = simulation.min_J();
            assert!(J > 0.0, "{name}: element {element} has J = {J} after step {step}");
        }
    }
}

#[test]
fn the_program_writes_the_state_that_the_library_computes_with_17_digits() {
    for name in course_scenes() {
        let desk = Desk::new();
        desk.run_well(&format!("{name} --headless --steps {STEPS} --state q.json"));
        let mut simulation = build(&shipped(&name));
        (0..STEPS).for_each(|_| simulation.step().unwrap());

        let state = desk.json("q.json");
        let keys: Vec<_> = state.as_object().unwrap().keys().collect();
        assert_eq!(keys, ["displacements", "history", "q", "qdot", "scene", "steps", "time"], "{name}");
        assert_eq!(state["time"].as_f64().unwrap(), simulation.time());
        let size = 3 * simulation.shape().mesh.vertices().len();
        for (key, expected) in [("q", simulation.positions()), ("qdot", simulation.velocities())] {
            let found = numbers(&state[key]);
            assert_eq!(found.len(), size, "{name}: {key}");
            assert!(found.iter().all(|number| number.is_finite()), "{name}: {key}");
            assert_eq!(found, expected.as_slice(), "{name}: {key}");
        }
        // The scene's keys and the history follow the numbers.
        let text = desk.read("q.json");
        assert_17_digits(&text[..text.find("\"steps\"").unwrap()]);
    }
}

fn assert_17_digits(text: &str) {
    let words =
        text.split([',', '[', ']', ' ', '\n', '{', '}']).filter(|word| word.contains('e') && !word.contains('"'));
    for word in words {
        let mantissa = word.split('e').next().unwrap();
        assert_eq!(mantissa.chars().filter(char::is_ascii_digit).count(), 17, "{word}");
    }
}

#[test]
fn the_program_writes_the_energies_of_every_step() {
    for name in course_scenes() {
        let desk = Desk::new();
        desk.run_well(&format!("{name} --headless --steps {STEPS} --energies e.csv"));
        let text = desk.read("e.csv");
        let mut lines = text.lines();
        assert_eq!(lines.next(), Some("time,kinetic,potential,total"));
        let rows: Vec<Vec<f64>> =
            lines.map(|line| line.split(',').map(|word| word.parse().unwrap()).collect()).collect();
        assert_eq!(rows.len(), STEPS + 1, "{name}: one row at rest and one for each step");

        let mut simulation = build(&shipped(&name));
        for (step, row) in rows.iter().enumerate() {
            let [time, kinetic, potential, total] = row[..] else { panic!("{name}: {row:?} has not four numbers") };
            let expected = simulation.energies();
            assert!((time - step as f64 * simulation.dt()).abs() <= 1e-9, "{name}: {time} after {step} steps");
            assert_eq!((kinetic, potential, total), (expected.kinetic, expected.potential, expected.total()));
            assert!(kinetic >= 0.0 && total.is_finite(), "{name}: {row:?}");
            simulation.step().unwrap();
        }
    }
}

#[test]
fn every_shipped_scene_starts_with_zero_energy() {
    for name in course_scenes() {
        let energies = build(&shipped(&name)).energies();
        assert_eq!(energies.kinetic, 0.0, "{name}");
        assert!(energies.potential.abs() <= 1e-9, "{name}: {energies:?}");
    }
}

#[test]
fn two_runs_of_a_shipped_scene_give_the_same_files_bit_for_bit() {
    for name in course_scenes() {
        let desk = Desk::new();
        for run in ["first", "second"] {
            desk.run_well(&format!("{name} --headless --steps {STEPS} --state {run}.json --energies {run}.csv"));
        }
        assert_eq!(desk.read("first.json"), desk.read("second.json"), "{name}");
        assert_eq!(desk.read("first.csv"), desk.read("second.csv"), "{name}");
    }
}
