//! `--stats`: its keys are fixed, and its counts prove which parts a scene builds and which it leaves out.

use fem_model::simulation::Simulation;
use serde_json::Value;

use crate::program::{Desk, course_scenes};
use crate::scene_text::{CUBE, build, edit, shipped, without};

const KEYS: [&str; 24] = [
    "scene",
    "status",
    "nodes",
    "elements",
    "steps",
    "seconds_setup",
    "seconds_per_step_median",
    "seconds_per_step_p95",
    "newton_iterations",
    "unconverged_steps",
    "factorizations",
    "symbolic_factorizations",
    "solver_iterations",
    "stiffness_assemblies",
    "energy_evaluations",
    "line_search_backtracks",
    "projections",
    "accepted_steps",
    "rejected_steps",
    "skinning_rows",
    "peak_memory_bytes",
    "min_J",
    "reactions",
    "parts",
];

const STEPS: usize = 6;

fn stats_of(desk: &Desk, arguments: &str) -> Value {
    desk.run_well(&format!("{arguments} --headless --stats s.json"));
    desk.json("s.json")
}

fn count(stats: &Value, key: &str) -> usize {
    stats[key].as_u64().unwrap_or_else(|| panic!("{key} is {}", stats[key])) as usize
}

fn parts(stats: &Value) -> Vec<String> {
    let mut names: Vec<_> = stats["parts"].as_object().unwrap().keys().cloned().collect();
    names.sort();
    names
}

#[test]
fn the_statistics_of_every_shipped_scene_have_the_promised_keys_and_sound_values() {
    for name in course_scenes() {
        let desk = Desk::new();
        let stats = stats_of(&desk, &format!("{name} --steps {STEPS}"));
        let (mut found, mut promised): (Vec<_>, _) = (stats.as_object().unwrap().keys().collect(), KEYS);
        found.sort();
        promised.sort();
        assert_eq!(found, promised, "{name}");

        let mesh = &build(&shipped(&name)).shape().mesh;
        assert_eq!((&stats["scene"], &stats["status"]), (&name.clone().into(), &"done".into()));
        assert_eq!((count(&stats, "nodes"), count(&stats, "elements")), (mesh.vertices().len(), mesh.elements()));
        assert_eq!((count(&stats, "steps"), count(&stats, "symbolic_factorizations")), (STEPS, 1), "{name}");
        let seconds = |key: &str| stats[key].as_f64().unwrap();
        assert!(seconds("seconds_setup") > 0.0 && seconds("seconds_per_step_median") > 0.0, "{name}");
        assert!(seconds("seconds_per_step_p95") >= seconds("seconds_per_step_median"), "{name}");
        assert!((0.0..=1.0).contains(&stats["min_J"].as_f64().unwrap()), "{name}: min_J is {}", stats["min_J"]);
        if cfg!(target_os = "linux") {
            assert!(count(&stats, "peak_memory_bytes") > 1_000_000, "{name}");
        }
    }
}

#[test]
fn linearly_implicit_euler_assembles_and_solves_once_a_step_and_evaluates_no_energy() {
    for name in course_scenes() {
        let stats = stats_of(
            &Desk::new(),
            &format!("{name} --steps {STEPS} --integrator linearly_implicit_euler --set drag.in_stiffness=true"),
        );
        for key in ["energy_evaluations", "line_search_backtracks", "newton_iterations"] {
            assert_eq!(count(&stats, key), 0, "{name}: {key}");
        }
        assert_eq!(count(&stats, "stiffness_assemblies"), STEPS, "{name}");
        assert_eq!(count(&stats, "factorizations"), STEPS, "{name}");
        assert_eq!(count(&stats, "projections"), STEPS * count(&stats, "elements"), "{name}");
        assert!(!parts(&stats).contains(&"line_search".to_owned()), "{name}");
    }
}

#[test]
fn implicit_euler_counts_its_iterations_energies_and_assemblies() {
    for name in course_scenes() {
        let stats = stats_of(&Desk::new(), &format!("{name} --steps {STEPS} --integrator implicit_euler"));
        let iterations = count(&stats, "newton_iterations");
        assert!((STEPS..=5 * STEPS).contains(&iterations), "{name}: {iterations} iterations");
        let assemblies = count(&stats, "stiffness_assemblies");
        assert!((STEPS..=iterations).contains(&assemblies), "{name}: {assemblies} assemblies");
        assert_eq!(count(&stats, "projections"), assemblies * count(&stats, "elements"), "{name}");
        assert!((assemblies..=2 * iterations).contains(&count(&stats, "factorizations")), "{name}");
        // One or two energies at the start of a step, and one for each trial of a line search.
        let energies = count(&stats, "energy_evaluations");
        let trials = iterations + count(&stats, "line_search_backtracks");
        assert!((trials + STEPS..=trials + 2 * STEPS).contains(&energies), "{name}: {energies} energies");
        assert!(parts(&stats).contains(&"line_search".to_owned()), "{name}");
    }
}

#[test]
fn a_part_that_the_scene_leaves_out_has_no_key() {
    let surface = "v 0.2 0.2 0.5\nv 0.8 0.2 0.5\nv 0.5 0.8 0.5\nf 1 2 3\n";
    let full = edit(CUBE, "[mesh]\n", "[mesh]\ndisplay = \"surface.obj\"\n");
    let variants = [
        ("", full.clone()),
        ("gravity", without(&full, "gravity")),
        ("fixed", without(&full, "fixed")),
        ("drag", without(&full, "drag")),
        ("skinning", CUBE.to_owned()),
        ("line_search", edit(&full, "\"implicit_euler\"", "\"linearly_implicit_euler\"")),
    ];
    let all = ["drag", "fixed", "forces", "gravity", "line_search", "mass", "mesh", "skinning", "solver", "stiffness"];
    for (missing, text) in variants {
        let desk = Desk::with("cube.toml", text);
        desk.write("surface.obj", surface);
        let stats = stats_of(&desk, "cube.toml");
        let expected: Vec<_> = all.into_iter().filter(|part| *part != missing).collect();
        assert_eq!(parts(&stats), expected, "without {missing}");
        for (part, cost) in stats["parts"].as_object().unwrap() {
            assert!(cost["bytes"].is_u64() && cost["seconds"].as_f64().unwrap() >= 0.0, "{part}: {cost}");
        }
    }
}

#[test]
fn only_exports_of_the_surface_skin_it() {
    for name in course_scenes() {
        let rows = build(&shipped(&name)).shape().display.as_ref().unwrap().vertices.len();
        let desk = Desk::new();
        let skinned = |export: &str| count(&stats_of(&desk, &format!("{name} --steps 2 {export}")), "skinning_rows");
        assert_eq!(skinned(""), 0, "{name}");
        assert_eq!(skinned("--state q.json --energies e.csv"), 0, "{name}");
        assert_eq!(skinned("--export x.vtu"), 0, "{name}");
        assert_eq!(skinned("--export x.obj"), rows, "{name}");
        let animated = skinned("--export x.glb");
        assert!(animated >= rows && animated % rows == 0, "{name}: {animated} rows of {rows}");
    }
}

#[test]
fn reaction_forces_of_an_engine_scene_are_printed_and_in_the_statistics() {
    let desk = Desk::new();
    let said = desk.run_well("bar --headless --stats s.json").stdout;
    let stats = desk.json("s.json");
    let names: Vec<_> = stats["reactions"].as_object().unwrap().keys().collect();
    assert_eq!(names, ["prescribed[0]", "prescribed[1]", "prescribed[2]"]);
    // The traction of the scene on 0.25 m², balanced at the other end.
    let along = stats["reactions"]["prescribed[0]"][0].as_f64().unwrap();
    assert!((along / -(0.25 * 3.842394e5) - 1.0).abs() < 1e-8, "{along} N");
    assert!(said.contains("reaction force of prescribed[0]: (-9.6060e4, "), "{said}");
    assert_eq!(count(&stats, "unconverged_steps"), 0);
}

#[test]
fn steps_that_have_not_converged_end_in_exit_code_1_unless_the_scene_accepts_them() {
    let scene = std::fs::read_to_string(crate::program::data().join("scenes/beam.toml")).unwrap();
    let desk = Desk::with("beam.toml", format!("{scene}[newton]\nmax_iterations = 1\n"));
    let outcome = desk.run("beam.toml --headless --steps 3 --stats s.json --state q.json");
    assert_eq!(outcome.code, Some(1), "{outcome:?}");
    assert!(outcome.stderr.contains("3 of 3 steps ended before Newton's method had converged"), "{outcome:?}");
    assert_eq!(count(&desk.json("s.json"), "unconverged_steps"), 3);
    assert!(desk.json("s.json")["status"].as_str().unwrap().starts_with("failed: 3 of 3 steps"));
    assert!(desk.json("q.json")["time"].as_f64().unwrap() > 0.0, "the files are there all the same");

    desk.write("accepted.toml", format!("{scene}[newton]\nmax_iterations = 1\naccept_unconverged = true\n"));
    desk.run_well("accepted.toml --headless --steps 3 --stats s.json");
    assert_eq!(count(&desk.json("s.json"), "unconverged_steps"), 3);
    assert_eq!(desk.json("s.json")["status"], "done");
}

#[test]
fn sweeps_that_leave_a_stiff_body_far_from_balance_end_in_exit_code_1_unless_the_scene_accepts_that() {
    let scene = "pipeline = \"engine\"\n[mesh]\nbox = { size = [2, 1, 1], cells_per_unit = 2 }\n[material]\n\
                 model = \"stable_neo_hookean\"\nyoung = 1e12\npoisson = 0.3\ndensity = 1000\n[mass]\nlumped = true\n[gravity]\n\
                 acceleration = [0, 0, -9.81]\n[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n[time]\ndt = 0.01\n\
                 integrator = \"vbd\"\n[iterations]\ncount = 1\n";
    let desk = Desk::with("stiff.toml", scene);
    let outcome = desk.run("stiff.toml --headless --steps 3 --stats s.json");
    assert_eq!(outcome.code, Some(1), "{outcome:?}");
    let told = "3 of 3 steps ended far from the solution: the body has gained more than 5 % of the energy that it was supplied with";
    assert!(outcome.stderr.contains(told) && outcome.stderr.contains("iterations.count"), "{outcome:?}");

    let missed = "stiff.toml --headless --steps 3 --set iterations.tolerance=1e-9 --set iterations.count=3";
    let outcome = desk.run(missed);
    assert_eq!(outcome.code, Some(1), "{outcome:?}");
    assert!(
        outcome.stderr.contains("before the iterations had reached iterations.tolerance = 0.000000001"),
        "{outcome:?}"
    );

    desk.run_well("stiff.toml --headless --steps 3 --set iterations.accept_unconverged=true");
}

#[test]
fn the_estimated_error_of_the_stresses_falls_with_the_edges_and_with_quadratic_elements() {
    let desk = Desk::new();
    let error = |cells: usize, order: usize| {
        let arguments = format!("cantilever --set mesh.box.cells_per_unit={cells} --set mesh.order={order}");
        stats_of(&desk, &format!("{arguments} --export x.vtu"))["stress_error"].as_f64().unwrap()
    };
    let [coarse, fine, quadratic] = [error(2, 1), error(4, 1), error(2, 2)];
    assert!(coarse > 1.4 * fine && coarse > 8.0 * quadratic, "{coarse} {fine} {quadratic}");
    assert!(desk.read("x.vtu").contains("Name=\"stress_error\""));
}
