//! Runs that go on from a state file: the end is that of the uninterrupted run, byte for byte.

use crate::program::{Desk, assert_names};
use crate::scene_text::{CUBE, edit};

/// The cube as the engine computes it.
pub fn engine_cube() -> String {
    edit(CUBE, "\"course\"", "\"engine\"")
}

/// Runs a scene at once, and in two parts, and compares the state files.
fn assert_goes_on(scene: &str, options: &str, part: usize, steps: usize) {
    let desk = Desk::with("cube.toml", scene);
    let run = format!("cube.toml --headless {options}");
    desk.run_well(&format!("{run} --steps {steps} --state whole.json"));
    desk.run_well(&format!("{run} --steps {part} --state part.json"));
    desk.run_well(&format!("{run} --steps {steps} --resume part.json --state end.json"));
    assert!(desk.read("end.json") == desk.read("whole.json"), "{options}: after {part} of {steps} steps");
}

#[test]
fn both_pipelines_and_precisions_go_on_with_every_kind_of_method() {
    for integrator in ["linearly_implicit_euler", "implicit_euler"] {
        assert_goes_on(CUBE, &format!("--integrator {integrator}"), 5, 12);
    }
    let newton = "--set newton.tolerance=1e-4";
    for precision in ["f64", "f32"] {
        let set = format!("--set time.precision={precision}");
        for (integrator, dt, more) in
            [("verlet", "1e-4", ""), ("implicit_euler", "0.01", newton), ("linearly_implicit_euler", "0.01", "")]
        {
            assert_goes_on(&engine_cube(), &format!("{set} --integrator {integrator} --dt {dt} {more}"), 5, 12);
        }
    }
}

#[test]
fn a_run_goes_on_with_another_number_of_threads() {
    let desk = Desk::with("cube.toml", engine_cube());
    let run = |threads: &str, arguments: &str| {
        let mut command = desk.command(&format!("cube.toml --headless {arguments}"));
        assert!(command.env("RAYON_NUM_THREADS", threads).output().unwrap().status.success(), "{arguments}");
    };
    run("1", "--steps 12 --state whole.json");
    run("2", "--steps 7 --state part.json");
    for threads in ["1", "2"] {
        run(threads, "--steps 12 --resume part.json --state end.json");
        assert!(desk.read("end.json") == desk.read("whole.json"), "{threads} threads");
    }
}

#[test]
fn the_first_row_of_a_resumed_run_is_the_resumed_state() {
    let desk = Desk::with("cube.toml", engine_cube());
    let files = |name: &str| format!("--energies {name}.csv --probe highest={name}-probe.csv");
    desk.run_well(&format!("cube.toml --headless --steps 8 {}", files("whole")));
    desk.run_well("cube.toml --headless --steps 5 --state part.json");
    desk.run_well(&format!("cube.toml --headless --steps 8 --resume part.json {} --vtu-series series", files("end")));
    for table in ["", "-probe"] {
        let lines =
            |name: &str| desk.read(&format!("{name}{table}.csv")).lines().map(str::to_owned).collect::<Vec<_>>();
        let (whole, end) = (lines("whole"), lines("end"));
        assert_eq!((whole.len(), end.len()), (10, 5));
        assert_eq!(whole[0], end[0]);
        assert_eq!(whole[6..], end[1..], "{table}");
    }
    assert!(desk.path("series/cube_000005.vtu").exists() && desk.path("series/cube_000008.vtu").exists());
    assert!(!desk.path("series/cube_000000.vtu").exists());
}

#[test]
fn a_state_that_cannot_be_resumed_is_refused() {
    let desk = Desk::with("cube.toml", CUBE);
    desk.run_well("cube.toml --headless --steps 3 --state part.json");
    desk.write("old.json", "{\"time\": 0.1, \"q\": [], \"qdot\": []}");
    for (arguments, parts) in [
        ("--resume part.json --steps 3", ["part.json", "after step 3", "--steps"]),
        (
            "--resume part.json --set material.C=2e5",
            ["part.json", "material.C is 100000.0 in the file and 200000.0 now", "resume with"],
        ),
        ("--resume part.json --dt 0.02", ["part.json", "time.dt is 0.01 in the file and 0.02 now", "resume with"]),
        ("--resume part.json --integrator linearly_implicit_euler", ["part.json", "time.integrator", "resume with"]),
        ("--resume old.json", ["old.json", "missing field `steps`", "--checkpoint"]),
        ("--resume nosuch.json", ["nosuch.json", "cannot be read", "check the path"]),
        ("--resume cube.toml", ["cube.toml", "expected", "give a file that --state"]),
    ] {
        let message = desk.refused(&format!("cube.toml --headless {arguments}"));
        assert!(message.starts_with("error: --resume "), "{message}");
        assert_names(&message, &parts);
    }
    assert_names(&desk.refused("cube.toml --checkpoint-every 5"), &["--checkpoint"]);
    assert_names(&desk.refused("cube.toml --checkpoint c.json --checkpoint-every=-1"), &["a number of minutes"]);
}

#[cfg(target_os = "linux")]
#[test]
fn a_run_goes_on_with_a_warning_where_no_checkpoint_can_be_written() {
    let desk = Desk::with("cube.toml", CUBE);
    let outcome = desk.run("cube.toml --headless --checkpoint /dev/full --checkpoint-every 0 --state q.json");
    assert_eq!(outcome.code, Some(0), "{outcome:?}");
    assert_names(&outcome.stderr, &["warning: no checkpoint after step 1: /dev/full", "disk is not full"]);
    assert_eq!(desk.json("q.json")["steps"], 4);
}

#[cfg(unix)]
#[test]
fn a_run_that_is_killed_at_any_moment_goes_on_from_its_last_checkpoint() {
    let desk = Desk::with("cube.toml", engine_cube());
    let run = "cube.toml --headless --steps 1500";
    desk.run_well(&format!("{run} --state whole.json"));
    let (mut random, mut killed) = (20_261_122_u64, 0);
    for _ in 0..20 {
        let resume = if desk.path("c.json").exists() { "--resume c.json" } else { "" };
        let command = format!("{run} --checkpoint c.json --checkpoint-every 0 {resume}");
        let mut child = desk.command(&command).stdout(std::process::Stdio::null()).spawn().unwrap();
        // Knuth's linear congruential generator.
        random = random.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        std::thread::sleep(std::time::Duration::from_millis(20 + (random >> 33) % 60));
        child.kill().unwrap();
        killed += usize::from(child.wait().unwrap().code().is_none());
        if desk.path("c.json").exists() {
            assert!(desk.json("c.json")["history"].is_object(), "the checkpoint is incomplete");
        }
    }
    assert!(killed > 10, "only {killed} runs were killed before their end");
    let steps = desk.json("c.json")["steps"].as_u64().unwrap();
    assert!(steps > 0);
    if steps < 1500 {
        desk.run_well(&format!("{run} --resume c.json --checkpoint c.json"));
    }
    assert!(desk.read("c.json") == desk.read("whole.json"), "the end is another one");
}
