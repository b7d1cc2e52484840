//! Killing the grading of a class ends every process that works for it.
#![cfg(target_os = "linux")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::{Duration, Instant};

use grader::submission::NAMES;
use tempfile::TempDir;

/// Longest time until the libraries are built and a submission's program runs, on a slow machine.
const START: Duration = Duration::from_secs(400);

/// Longest time until everything is gone.
const END: Duration = Duration::from_secs(10);

/// Longest time until everything is gone that a library was built with: far less than the build takes.
const SOON: Duration = Duration::from_secs(3);

/// A class of one, whose first function never ends, in a folder whose name is on the command line of all that works for it.
fn class(folder: &Path) -> Command {
    let repository = Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the grader lies in the repository");
    let source = folder.join("class/anna/src");
    fs::create_dir_all(&source).expect("a folder");
    fs::create_dir(folder.join("work")).expect("a folder");
    for name in NAMES {
        let text = fs::read_to_string(repository.join(format!("src/{name}.rs"))).expect("a solution");
        let endless = text.replace(") -> f64 {\n", ") -> f64 {\n    loop { std::hint::spin_loop() }\n");
        fs::write(source.join(format!("{name}.rs")), endless).expect("a file");
    }
    let rubric = fs::read_to_string(repository.join("grader/rubric.toml")).expect("the rubric");
    let patient = rubric.replace("\nseconds = 5.0", "\nseconds = 100.0");
    assert_ne!(patient, rubric);
    fs::write(folder.join("rubric.toml"), patient).expect("a file");
    let mut command = Command::new(env!("CARGO_BIN_EXE_grader"));
    command.arg("class").arg(folder.join("class")).arg("--out").arg(folder.join("out")).args(["--seed", "5"]);
    command.arg("--rubric").arg(folder.join("rubric.toml")).env("TMPDIR", folder.join("work"));
    command.stdout(Stdio::null()).stderr(Stdio::null());
    command
}

fn start(command: &mut Command) -> Child {
    command.spawn().expect("the grader starts")
}

/// Command lines of the processes that work in a folder.
fn at_work(folder: &Path) -> Vec<String> {
    let processes = fs::read_dir("/proc").expect("processes").flatten();
    let lines = processes.filter_map(|process| fs::read(process.path().join("cmdline")).ok());
    let lines = lines.map(|line| String::from_utf8_lossy(&line).replace('\0', " "));
    lines.filter(|line| line.contains(&*folder.to_string_lossy())).collect()
}

/// Waits until the processes that work in a folder satisfy a condition.
fn wait(folder: &Path, limit: Duration, is_wanted: impl Fn(&[String]) -> bool) {
    let begun = Instant::now();
    loop {
        let found = at_work(folder);
        if is_wanted(&found) {
            return;
        }
        assert!(begun.elapsed() < limit, "{found:#?}");
        std::thread::sleep(Duration::from_millis(20));
    }
}

#[test]
fn no_grader_and_no_submission_outlives_a_killed_class() {
    let folder = TempDir::new().expect("a folder");
    let path: PathBuf = folder.path().canonicalize().expect("a path");
    let mut class = start(&mut class(&path));
    // The class itself, the grader of the submission, and the keeper of a program with the submission's code.
    let runs = |line: &String| line.contains("confine keep") && line.contains("\"Submission\"");
    wait(&path, START, |found| found.iter().any(|line| line.contains(" grade ")) && found.iter().any(runs));
    class.kill().expect("it runs");
    class.wait().expect("it ends");
    wait(&path, END, |found| found.is_empty());
}

#[test]
fn no_compiler_outlives_a_class_that_is_killed_while_it_builds_its_libraries() {
    let folder = TempDir::new().expect("a folder");
    let path: PathBuf = folder.path().canonicalize().expect("a path");
    let mut class = start(class(&path).env("CARGO_TARGET_DIR", path.join("target")));
    // Cargo, and one of the compilers that it starts.
    let builds = |line: &String| line.contains("--crate-name") && !line.contains("build_script");
    wait(&path, START, |found| found.iter().any(|line| line.contains("--manifest-path")) && found.iter().any(builds));
    class.kill().expect("it runs");
    class.wait().expect("it ends");
    wait(&path, SOON, |found| found.is_empty());
    assert!(
        !path
            .join("target/grader")
            .read_dir()
            .expect("a folder")
            .flatten()
            .any(|entry| entry.path().join("complete").exists())
    );
}
