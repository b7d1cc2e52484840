//! A run that is resumed from a state file ends bit for bit where the uninterrupted run ends.

use std::path::Path;

use fem_model::simulation::Simulation;
use fem_scene::{Scene, body};
use fem_scene::{resume, write_state};
use tempfile::TempDir;

use crate::{DYNAMIC, run, scene, side, soft};

const STEPS: usize = 14;

/// Steps after which the run is interrupted.
const INTERRUPTED: [usize; 3] = [1, 6, 11];

fn start(scene: &Scene) -> Box<dyn Simulation> {
    let body = body(scene, Path::new("no data")).unwrap();
    fem_engine::simulator::build(body, &scene.method()).unwrap_or_else(|error| panic!("{error}"))
}

/// Every bit of the state: displacements, velocities, time and steps, and what the next steps depend on.
fn bits(simulation: &dyn Simulation) -> (Vec<u64>, usize, String) {
    let state = simulation.checkpoint();
    let numbers = state.displacements.iter().chain(&state.velocities).chain([&state.time]);
    (numbers.map(|x| x.to_bits()).collect(), state.steps, serde_json::to_string(&state.history).unwrap())
}

fn in_threads<R: Send>(threads: usize, work: impl FnOnce() -> R + Send) -> R {
    rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap().install(work)
}

/// Interrupts the run of a scene with one thread, resumes it with one and with two, and compares the ends.
fn assert_goes_on(text: &str) {
    let (scene, folder) = (scene(text), TempDir::new().unwrap());
    let file = |steps: usize| folder.path().join(format!("{steps}.json"));
    let end = in_threads(1, || {
        let mut simulation = start(&scene);
        for steps in 1..=STEPS {
            run(&mut *simulation, 1);
            if INTERRUPTED.contains(&steps) {
                write_state(&file(steps), &scene, &*simulation).unwrap();
            }
        }
        bits(&*simulation)
    });
    for (steps, threads) in INTERRUPTED.into_iter().flat_map(|steps| [(steps, 1), (steps, 2)]) {
        let resumed = in_threads(threads, || {
            let mut simulation = start(&scene);
            resume(&file(steps), &scene, &mut *simulation).unwrap();
            run(&mut *simulation, STEPS - steps);
            bits(&*simulation)
        });
        assert!(resumed == end, "resumed after {steps} steps with {threads} threads, the end is another one:\n{text}");
    }
}

/// A clamped body under its weight and a pressure, with a side that moves, a pull, and damping.
fn body_of(integrator: &str, precision: &str, solver: &str, cells: usize) -> String {
    let motion = side("x", "max", 0.05) + "over = 0.1\n";
    let tables = format!(
        "precision = \"{precision}\"\n\
         [fixed]\nplane = {{ axis = \"x\", below = 1e-9 }}\n[gravity]\nacceleration = [0, 0, -9.81]\n\
         [[traction]]\non = {{ axis = \"x\", side = \"max\", within = 1e-9 }}\npressure = 300\n\
         [drag]\nvertex = 1\nstiffness = 100\ndirection = [0, 0, 1]\namplitude = 0.1\nfrequency = 3\n{solver}{motion}"
    );
    let is_explicit = ["explicit_euler", "semi_implicit_euler", "rk2", "rk4", "verlet"].contains(&integrator);
    let dt = if is_explicit { 1e-4 } else { 0.01 };
    soft(integrator, dt, &tables).replace("cells_per_unit = 1", &format!("cells_per_unit = {cells}"))
}

const PRECISIONS: [&str; 2] = ["f64", "f32"];

/// A tolerance that single precision reaches.
const NEWTON: &str = "[newton]\ntolerance = 1e-4\n";

#[test]
fn every_method_goes_on_in_double_and_single_precision() {
    for precision in PRECISIONS {
        for integrator in DYNAMIC {
            let has_newton = integrator == "implicit_euler" || crate::SECOND_ORDER.contains(&integrator);
            let newton = if has_newton { NEWTON } else { "" };
            let damping = "[damping]\nalpha = 1\nbeta = 1e-4\n";
            assert_goes_on(&body_of(integrator, precision, newton, 2));
            assert_goes_on(&body_of(integrator, precision, &format!("{damping}{newton}"), 1));
        }
    }
}

#[test]
fn adaptive_steps_go_on_with_the_size_that_they_had() {
    for integrator in crate::SECOND_ORDER {
        let text = body_of(integrator, "f64", "[damping]\nbeta = 1e-3\n", 1);
        assert_goes_on(&text.replace("precision", "adaptive = { tolerance = 1e-4 }\nprecision"));
    }
}

#[test]
fn verlet_goes_on_with_the_acceleration_that_it_keeps() {
    for precision in PRECISIONS {
        assert_goes_on(&soft(
            "verlet",
            1e-3,
            &format!("precision = \"{precision}\"\n[gravity]\nacceleration = [0, -9, 0]\n"),
        ));
    }
}

#[test]
fn a_release_before_or_after_the_interruption_is_kept() {
    let cases = ["implicit_euler", "newmark", "bdf2", "bathe"].map(|integrator| (integrator, "0.08"));
    for (integrator, until) in cases.into_iter().chain([("verlet", "8e-4")]) {
        let text = body_of(integrator, "f64", if integrator == "verlet" { "" } else { NEWTON }, 2);
        assert_goes_on(&format!("{text}until = {until}\n"));
    }
}

const SOLVERS: [&str; 6] = [
    "kind = \"cholesky\"",
    "kind = \"lu\"",
    "kind = \"cg\"",
    "kind = \"pcg\"",
    "kind = \"pcg\"\npreconditioner = \"multigrid\"",
    "kind = \"pcg\"\npreconditioner = \"ssor\"",
];

#[test]
fn implicit_methods_go_on_with_every_solver() {
    for precision in PRECISIONS {
        for solver in SOLVERS {
            let tolerance = if precision == "f32" { 1e-4 } else { 1e-10 };
            for integrator in ["implicit_euler", "linearly_implicit_euler"] {
                let has_newton = integrator == "implicit_euler" || crate::SECOND_ORDER.contains(&integrator);
                let newton = if has_newton { NEWTON } else { "" };
                let solver = format!("[solver]\n{solver}\ntolerance = {tolerance:e}\n{newton}");
                assert_goes_on(&body_of(integrator, precision, &solver, 2));
            }
        }
    }
}

#[test]
fn load_steps_go_on_with_every_solver() {
    let load = "[fixed]\nplane = { axis = \"x\", below = 1e-9 }\n[gravity]\nacceleration = [0, 0, -2]\n";
    for solver in SOLVERS {
        for law in ["neo_hookean", "linear"] {
            let text = soft(
                "static",
                1.0,
                &format!("{load}[static]\nload_steps = 12\n[solver]\n{solver}\ntolerance = 1e-10\n"),
            );
            let text = text.replace("cells_per_unit = 1", "cells_per_unit = 2");
            assert_goes_on(&crate::of_law(law, &text));
        }
    }
}

#[test]
fn a_body_too_large_for_one_thread_goes_on() {
    // Beyond 5 000 rows another factorisation takes over, with several threads.
    let text = body_of("implicit_euler", "f64", &format!("[solver]\nkind = \"cholesky\"\n{NEWTON}"), 14);
    let (scene, folder) = (scene(&text), TempDir::new().unwrap());
    let file = folder.path().join("state.json");
    let mut simulation = start(&scene);
    run(&mut *simulation, 2);
    write_state(&file, &scene, &*simulation).unwrap();
    run(&mut *simulation, 1);
    let mut resumed = start(&scene);
    resume(&file, &scene, &mut *resumed).unwrap();
    run(&mut *resumed, 1);
    assert!(bits(&*resumed) == bits(&*simulation));
}

#[test]
fn a_state_of_another_scene_is_refused_with_the_difference() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("state.json");
    let (text, solver) = (body_of("implicit_euler", "f64", NEWTON, 1), "[solver]\nkind = \"lu\"\n");
    let first = scene(&text);
    let mut simulation = start(&first);
    run(&mut *simulation, 1);
    write_state(&file, &first, &*simulation).unwrap();
    let refused = |text: &str| {
        let other = scene(text);
        let mut simulation = start(&other);
        let error = resume(&file, &other, &mut *simulation).unwrap_err().to_string();
        assert_eq!((simulation.time(), simulation.positions().amax()), (0.0, 2.0));
        error
    };
    for (from, to, difference) in [
        ("C = 1e4", "C = 2e4", "material.C is 10000.0 in the file and 20000.0 now"),
        ("implicit_euler", "verlet", "time.integrator is implicit_euler in the file and verlet now"),
        ("\"f64\"", "\"f32\"", "time.precision is f64 in the file and f32 now"),
        ("[newton]", &format!("{solver}[newton]"), "solver.kind is not given in the file and lu now"),
        ("cells_per_unit = 1", "cells_per_unit = 2", "number of nodes is 12 in the file and 45 now"),
    ] {
        let other = text.replacen(from, to, 1);
        // Explicit methods do without Newton's.
        let message = refused(&if to == "verlet" { other.replace(NEWTON, "") } else { other });
        assert!(message.contains(difference), "{message}");
        assert!(message.contains("state.json: is a state of another scene"), "{message}");
    }
}

#[test]
fn a_damaged_state_is_refused() {
    let folder = TempDir::new().unwrap();
    let file = folder.path().join("state.json");
    let scene = scene(&body_of("implicit_euler", "f64", NEWTON, 1));
    let mut simulation = start(&scene);
    run(&mut *simulation, 1);
    write_state(&file, &scene, &*simulation).unwrap();
    let text = std::fs::read_to_string(&file).unwrap();
    for (from, to) in [
        ("\"steps\"", "\"step\""),
        ("\"implicit_euler.last_change\"", "\"other\""),
        ("\"displacements\": [", "\"displacements\": [0, "),
        ("f64:", "f64:A"),
        ("}\n", ""),
    ] {
        assert!(text.contains(from), "`{from}` is not in the file");
        std::fs::write(&file, text.replacen(from, to, 1)).unwrap();
        let message = resume(&file, &scene, &mut *simulation).unwrap_err().to_string();
        assert!(message.contains("state.json: ") && message.contains("; give a file that --state"), "{message}");
    }
}

#[test]
fn a_run_with_pressures_as_unknowns_goes_on_bit_for_bit() {
    for integrator in ["implicit_euler", "newmark", "bathe"] {
        let text = body_of(integrator, "f64", "", 1);
        assert_goes_on(&text.replace("density = 1000.0", "density = 1000.0\nvolumetric = \"mixed\""));
    }
}
