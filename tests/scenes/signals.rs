//! Ctrl-C and SIGTERM: the run ends after its step, with complete files, and goes on from there.

use std::io::{BufRead, BufReader};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use fem_mesh::read_tetrahedra;

use crate::program::{Desk, Outcome};
use crate::resumed::engine_cube;

fn send(signal: &str, child: &Child) {
    assert!(Command::new("kill").args([signal, &child.id().to_string()]).status().unwrap().success());
}

/// Runs until a file is there and a moment longer, sends the signal, and waits for the end.
fn interrupted(desk: &Desk, arguments: &str, signal: &str, file: &str, moment: Duration) -> Outcome {
    let mut command = desk.command(arguments);
    let child = command.stdout(Stdio::piped()).stderr(Stdio::piped()).spawn().unwrap();
    let start = Instant::now();
    while !desk.path(file).exists() {
        assert!(start.elapsed() < Duration::from_secs(60), "{file} is not written");
        std::thread::sleep(Duration::from_millis(1));
    }
    std::thread::sleep(moment);
    send(signal, &child);
    let output = child.wait_with_output().unwrap();
    let text = |bytes| String::from_utf8(bytes).unwrap();
    Outcome { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
}

/// Asserts that every file of a run of some steps is complete, and that none is left unfinished.
fn assert_complete(desk: &Desk, steps: usize) {
    assert_eq!(desk.json("stats.json")["status"], "interrupted");
    assert_eq!(desk.json("stats.json")["steps"], steps);
    assert_eq!(desk.read("state.json"), desk.read("c.json"));
    for table in ["e.csv", "p.csv"] {
        assert_eq!(desk.read(table).lines().count(), steps + 2, "{table}");
    }
    let glb = std::fs::read(desk.path("x.glb")).unwrap();
    assert_eq!(u32::from_le_bytes(glb[8..12].try_into().unwrap()) as usize, glb.len());
    let list = desk.read("series/cube.pvd");
    for step in 0..=steps {
        let name = format!("cube_{step:06}.vtu");
        assert!(list.contains(&name) && read_tetrahedra(&desk.path("series").join(&name)).is_ok(), "{name}");
    }
    for folder in [".", "series"] {
        for entry in std::fs::read_dir(desk.path(folder)).unwrap().flatten() {
            assert!(!entry.file_name().to_string_lossy().ends_with(".part"), "{entry:?}");
        }
    }
    assert_eq!(std::fs::read_dir(desk.path("series")).unwrap().count(), steps + 2);
}

#[test]
fn a_signal_ends_the_run_after_its_step_with_complete_files() {
    let outputs = "--state state.json --stats stats.json --energies e.csv --probe 7=p.csv --export x.glb --vtu-series series \
                   --checkpoint c.json --checkpoint-every 0";
    for (number, (signal, code)) in
        [("-INT", 130), ("-TERM", 143), ("-INT", 130), ("-TERM", 143)].into_iter().enumerate()
    {
        let desk = Desk::with("cube.toml", engine_cube());
        let arguments = format!("cube.toml --headless --steps 1000000 {outputs}");
        let moment = Duration::from_millis(7 * number as u64);
        let outcome = interrupted(&desk, &arguments, signal, "series/cube_000003.vtu", moment);
        assert_eq!(outcome.code, Some(code), "{outcome:?}");
        let steps = desk.json("state.json")["steps"].as_u64().unwrap() as usize;
        let message = format!("interrupted: the run ended after step {steps} (t = ");
        assert!(outcome.stderr.starts_with(&message), "{}", outcome.stderr);
        assert!(outcome.stderr.contains("go on with --resume state.json"), "{}", outcome.stderr);
        assert!(outcome.stdout.contains("cube, implicit_euler"), "{}", outcome.stdout);
        assert_complete(&desk, steps);
        desk.run_well(&format!("cube.toml --headless --steps {} --resume state.json --state end.json", steps + 2));
        desk.run_well(&format!("cube.toml --headless --steps {} --state whole.json", steps + 2));
        assert!(desk.read("end.json") == desk.read("whole.json"), "{signal} after {steps} steps");
    }
}

#[test]
fn during_a_long_step_the_first_signal_is_answered_and_a_second_one_ends_the_program_at_once() {
    // One load step of this body takes minutes.
    let scene =
        engine_cube().replace("cells_per_unit = 2", "cells_per_unit = 24").replace("\"implicit_euler\"", "\"static\"")
            + "[solver]\nkind = \"lu\"\n";
    let desk = Desk::with("cube.toml", scene);
    let arguments = "cube.toml --headless --steps 3 --energies e.csv --vtu-series series";
    let mut child = desk.command(arguments).stderr(Stdio::piped()).spawn().unwrap();
    let start = Instant::now();
    while !desk.path("series/cube_000000.vtu").exists() {
        assert!(start.elapsed() < Duration::from_secs(60), "the run does not begin");
        std::thread::sleep(Duration::from_millis(1));
    }
    std::thread::sleep(Duration::from_millis(100));
    send("-INT", &child);
    let mut answer = String::new();
    BufReader::new(child.stderr.take().unwrap()).read_line(&mut answer).unwrap();
    assert!(answer.starts_with("the run ends after this step; the same signal again ends it at once"), "{answer}");
    assert!(child.try_wait().unwrap().is_none(), "the step has ended too early for this test");
    send("-INT", &child);
    assert_eq!(child.wait().unwrap().code(), Some(130));
    assert!(!desk.path("e.csv").exists());
}
