//! Classes graded by a stand-in for the grader, which runs the script `do.sh` of each submission.

mod fuzz;
mod limits;

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant, SystemTime};

use super::*;
use crate::assess::Adjustments;
use crate::reports;
use crate::rubric::{Counts, Rubric};

mod imports;
mod people;
mod regrading;
mod shards;

const OURS: &str = include_str!("../../rubric.toml");

/// Records the call and runs the script. `base` is the folder of the test, `out` that of the grade.
const GRADER: &str = r#"#!/bin/sh
base=$(dirname "$0")
out=$4
basename "$2" >>"$base/calls"
. "$2/do.sh"
"#;
const GOOD: &str = r#"cp "$base/grade.json" "$out/grade.json""#;
const WAIT: &str = r#"while [ ! -e "$base/go" ]; do sleep 0.02; done; cp "$base/grade.json" "$out/grade.json""#;
/// Names the test folder to a process that a test starts to kill it.
const BASE: &str = "CLASS_TEST_BASE";

struct Room(tempfile::TempDir);

impl Room {
    fn new(submissions: &[(&str, &str)]) -> Self {
        let room = Self(tempfile::tempdir().unwrap());
        fs::create_dir(room.path("hw")).unwrap();
        for (name, commands) in submissions {
            room.submit(name, commands);
        }
        fs::write(room.path("grade.json"), grade(7)).unwrap();
        fs::write(room.path("grader.txt"), GRADER).unwrap();
        // Another process writes it: while this process had the file open for writing, its threads could not execute it.
        let script = r#"cp "$1/grader.txt" "$1/grader" && chmod +x "$1/grader""#;
        assert!(Command::new("sh").args(["-c", script, "sh"]).arg(room.0.path()).status().unwrap().success());
        room
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn submit(&self, name: &str, commands: &str) {
        fs::create_dir(self.path("hw").join(name)).unwrap();
        fs::write(self.path("hw").join(name).join("do.sh"), commands).unwrap();
    }

    fn run(&self) -> Summary {
        run(&options(self.0.path())).unwrap()
    }

    /// Names of the graded students in alphabetical order, one for each time.
    fn calls(&self) -> Vec<String> {
        let text = fs::read_to_string(self.path("calls")).unwrap_or_default();
        let mut calls: Vec<String> = text.lines().map(String::from).collect();
        calls.sort();
        calls
    }

    /// The cells of a table, the heading first.
    fn table(&self, name: &str) -> Vec<Vec<String>> {
        let text = fs::read_to_string(self.path(name)).unwrap();
        let text = text.trim_start_matches('\u{feff}').as_bytes();
        let mut reader = csv::ReaderBuilder::new().has_headers(false).from_reader(text);
        reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect()
    }

    fn start(&self) -> Child {
        // The test harness has further threads, which a signal would end, so only the watching thread receives it.
        Command::new("env")
            .arg("--block-signal=INT")
            .arg(std::env::current_exe().unwrap())
            .args(["--exact", "class::tests::a_process_grades_the_class_that_it_is_told"])
            .env(BASE, self.0.path())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .unwrap()
    }

    fn wait_for_calls(&self, n: usize) {
        let start = Instant::now();
        while self.calls().len() < n {
            assert!(start.elapsed() < Duration::from_secs(30), "the grader is not called");
            std::thread::sleep(Duration::from_millis(5));
        }
    }
}

fn options(base: &Path) -> ClassOptions {
    ClassOptions {
        folder: base.join("hw"),
        roster: None,
        out: base.join("out"),
        jobs: 1,
        shard: None,
        seed: 7,
        grader: base.join("grader"),
        time_limit: Duration::from_secs(60),
        rubric: None,
        accounts: accounts(OURS, base),
        only: Vec::new(),
        functions: Vec::new(),
        extra: Vec::new(),
        report: reports::write_class,
        write: reports::write_final,
    }
}

/// The rules of a rubric's text, with the adjustments of the class.
fn accounts(text: &str, base: &Path) -> Accounts {
    let path = base.join("rubric.toml");
    fs::write(&path, text).unwrap();
    let rubric = Rubric::load(Some(&path)).unwrap_or_else(|error| panic!("{error}"));
    let adjustments = Adjustments::of_class(&base.join("hw"), &rubric).unwrap_or_else(|error| panic!("{error}"));
    Accounts::new(rubric, adjustments)
}

fn grade(seed: u64) -> String {
    let function = r#"{"name": "f", "score": 1, "max_score": 2, "status": "failed", "diagnosis": null, "message": null,
        "hint": null, "error": null, "seconds": null, "reference_seconds": null, "checks": []}"#;
    format!(
        r#"{{"format_version": 1, "submission": "", "files": "", "score": 1.5, "max_score": 2, "seed": {seed}, "toolchain": "",
        "sandbox": {{}}, "remarks": [], "functions": [{function}], "simulation": {function}, "seconds": 1}}"#
    )
}

/// `+` graded, `-` not, `o` older, `.` waiting: by student.
fn outcomes(summary: &Summary) -> String {
    let letter = |entry: &Entry| match entry.outcome {
        Outcome::Graded(..) => '+',
        Outcome::NotGraded(_) => '-',
        Outcome::Older { .. } => 'o',
        Outcome::Waiting => '.',
        Outcome::NoSubmission(_) => 'n',
    };
    summary.entries.iter().map(letter).collect()
}

#[test]
fn a_process_grades_the_class_that_it_is_told() {
    if let Some(base) = std::env::var_os(BASE) {
        let summary = run(&options(Path::new(&base))).unwrap();
        assert!(summary.interrupted, "only a signal ends it");
    }
}

#[test]
fn one_that_hangs_crashes_or_writes_garbage_costs_nobody_else_a_grade() {
    let hang = r#"sleep 1000 & echo $! >"$base/forked"; wait"#;
    let room = Room::new(&[
        ("a", GOOD),
        ("b", hang),
        ("c", "kill -SEGV $$"),
        ("d", r#"echo '{"score": 100' >"$out/grade.json""#),
        ("e", "exit 1"),
        ("f", "exit 0"),
        ("g", GOOD),
    ]);
    let options = ClassOptions { jobs: 3, time_limit: Duration::from_millis(1500), ..options(room.0.path()) };
    let summary = run(&options).unwrap();
    assert_eq!(outcomes(&summary), "+-----+");
    assert_eq!(room.calls(), ["a", "b", "c", "d", "e", "f", "g"]);
    let table = room.table("out/grades.csv");
    assert_eq!(table[0][..6], ["student", "submission", "score", "max_score", "note", "f"]);
    assert_eq!(table[1][..6], ["a", "a", "1.5", "2", "", "1"]);
    assert_eq!(table[2][..6], ["b", "b", "", "", "not graded: no end within 1.5 s; see failed/b.log", ""]);
    assert_eq!((table.len(), room.table("out/errors.csv").len()), (8, 6));
    assert!(room.path("out/submissions/a/grade.json").exists());
    assert!(room.path("out/failed/b.log").exists());
    assert!(fs::read_to_string(room.path("out/class.html")).unwrap().contains("<b>5</b><span>without a grade"));
    let forked = fs::read_to_string(room.path("forked")).unwrap();
    let state = fs::read_to_string(format!("/proc/{}/stat", forked.trim())).unwrap_or_default();
    assert!(state.is_empty() || state.contains(") Z "), "what it forked still runs: {state}");
}

#[test]
fn a_second_run_repeats_what_failed_or_changed_and_nothing_else() {
    let room = Room::new(&[("a", GOOD), ("b", GOOD), ("c", "exit 1")]);
    room.run();
    fs::write(room.path("hw/b/do.sh"), format!("{GOOD}\n")).unwrap();
    let summary = room.run();
    assert_eq!(room.calls(), ["a", "b", "b", "c", "c"]);
    assert_eq!((summary.kept, summary.graded_now, outcomes(&summary).as_str()), (1, 1, "++-"));
    let other_seed = ClassOptions { seed: 8, ..options(room.0.path()) };
    let summary = run(&other_seed).unwrap();
    assert_eq!((outcomes(&summary).as_str(), room.calls().len()), ("---", 8), "a grade with another seed is none");
}

#[test]
fn a_rubric_that_judges_in_another_way_grades_all_again_and_other_points_do_not() {
    let room = Room::new(&[("a", GOOD)]);
    let strict = OURS.replacen("tolerance = 1e-9", "tolerance = 1e-12", 1);
    let richer = OURS.replacen("points = 4.0", "points = 8.0", 1);
    for (text, calls) in [(OURS, 1), (OURS, 1), (&strict, 2), (&richer, 2), (&strict, 2)] {
        run(&ClassOptions { accounts: accounts(text, room.0.path()), ..options(room.0.path()) }).unwrap();
        assert_eq!(room.calls().len(), calls, "{text}");
    }
}

#[test]
fn a_killed_run_loses_nothing_that_was_done_and_repeats_none_of_it() {
    let room = Room::new(&[("a", GOOD), ("b", WAIT), ("c", GOOD)]);
    let mut killed = room.start();
    room.wait_for_calls(2);
    assert!(matches!(run(&options(room.0.path())), Err(ClassError::Locked(_))));
    killed.kill().unwrap();
    killed.wait().unwrap();
    fs::write(room.path("go"), "").unwrap();
    fs::write(room.path("out/grades/.partial-1-x"), "of a grader whose folder was gone").unwrap();
    let summary = room.run();
    assert_eq!((summary.kept, summary.graded_now, outcomes(&summary).as_str()), (1, 2, "+++"));
    assert_eq!(room.calls(), ["a", "b", "b", "c"]);
    let left = fs::read_dir(room.path("out/grades")).unwrap().count();
    assert_eq!(left, 3, "something unfinished lies about");
}

#[cfg(target_os = "linux")]
#[test]
fn an_interrupt_ends_what_runs_and_keeps_what_is_done() {
    let room = Room::new(&[("a", GOOD), ("b", WAIT), ("c", GOOD)]);
    let mut child = room.start();
    room.wait_for_calls(2);
    let id = nix::unistd::Pid::from_raw(child.id().try_into().unwrap());
    nix::sys::signal::kill(id, nix::sys::signal::Signal::SIGINT).unwrap();
    assert!(child.wait().unwrap().success());
    let notes: Vec<[String; 3]> =
        room.table("out/grades.csv").into_iter().map(|row| [0, 2, 4].map(|i| row[i].clone())).collect();
    assert_eq!(notes[1..], [["a", "1.5", ""], ["b", "", "not graded yet"], ["c", "", "not graded yet"]]);
    fs::write(room.path("go"), "").unwrap();
    room.run();
    assert_eq!(room.calls(), ["a", "b", "b", "c"]);
}

#[test]
fn the_newest_submission_of_a_student_counts_and_the_older_ones_are_named() {
    let room = Room::new(&[("anna", GOOD), ("bob__2", GOOD), ("bob__1", GOOD), ("anna-2", GOOD), ("carl", GOOD)]);
    let early = fs::File::options().write(true).open(room.path("hw/bob__2/do.sh")).unwrap();
    early.set_modified(SystemTime::UNIX_EPOCH + Duration::from_secs(1)).unwrap();
    fs::write(room.path("hw/notes.txt"), "").unwrap();
    let summary = room.run();
    assert_eq!(outcomes(&summary), "+++o+");
    assert_eq!(room.table("out/grades.csv")[3][..5], ["bob", "bob__1", "1.5", "2", "in place of bob__2"]);
    assert!(matches!(&summary.entries[3].outcome, Outcome::Older { newer } if newer == "bob__1"));
    assert_eq!(summary.remarks.len(), 2, "the strange file, and anna with anna-2: {:?}", summary.remarks);

    let students =
        "submission,student,time\nanna,Anna,2026-05-02\nanna-2,Anna,2026-05-01\nbob__2,Bob,10\nbob__1,Bob,9\n";
    fs::write(room.path("hw/students.csv"), students).unwrap();
    let summary = room.run();
    let names: Vec<_> = summary.entries.iter().map(|entry| entry.submission.as_str()).collect();
    assert_eq!(names, ["anna", "anna-2", "bob__1", "bob__2", "carl"]);
    assert_eq!(outcomes(&summary), "+oo++");
}

#[test]
fn archives_and_folders_are_found_under_names_that_differ() {
    let room = Room::new(&[("anna", GOOD), (".git", GOOD)]);
    for name in ["anna.zip", "bob@2026.tar.gz", "carl__hw1.TGZ", "dora.rar", ".zip"] {
        fs::write(room.path("hw").join(name), name).unwrap();
    }
    let class = find::class(&room.path("hw"), None, Counts::Newest).unwrap();
    let names: Vec<_> = class.submissions.iter().map(|found| (found.student.as_str(), found.name.as_str())).collect();
    assert_eq!(names, [("anna", "anna"), ("anna", "anna.zip"), ("bob", "bob@2026"), ("carl", "carl__hw1")]);
    assert_eq!(class.remarks.len(), 3, "{:?}", class.remarks);
}
