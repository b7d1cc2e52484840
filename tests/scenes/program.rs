//! Runs the program in a temporary folder.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use fem_scene::Pipeline;
use serde_json::Value;
use tempfile::TempDir;

/// Exit code and output of the program.
#[derive(Debug)]
pub struct Outcome {
    pub code: Option<i32>,
    pub stdout: String,
    pub stderr: String,
}

/// A current folder for the program.
pub struct Desk(TempDir);

impl Desk {
    pub fn new() -> Self {
        Self(tempfile::tempdir().unwrap())
    }

    /// One with a file in it.
    pub fn with(name: &str, content: impl AsRef<[u8]>) -> Self {
        let desk = Self::new();
        desk.write(name, content);
        desk
    }

    pub fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    pub fn write(&self, name: &str, content: impl AsRef<[u8]>) {
        fs::create_dir_all(self.path(name).parent().unwrap()).unwrap();
        fs::write(self.path(name), content).unwrap();
    }

    pub fn read(&self, name: &str) -> String {
        fs::read_to_string(self.path(name)).unwrap_or_else(|error| panic!("{name}: {error}"))
    }

    pub fn json(&self, name: &str) -> Value {
        serde_json::from_str(&self.read(name)).unwrap()
    }

    /// The program with these words as its arguments. No window can open.
    pub fn command(&self, arguments: &str) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_finite-elements-3d"));
        command.args(arguments.split_whitespace()).current_dir(self.0.path());
        command.env_remove("DISPLAY").env_remove("WAYLAND_DISPLAY");
        command
    }

    /// Runs the program with these words as its arguments.
    pub fn run(&self, arguments: &str) -> Outcome {
        let output = self.command(arguments).output().unwrap();
        let text = |bytes| String::from_utf8(bytes).unwrap();
        Outcome { code: output.status.code(), stdout: text(output.stdout), stderr: text(output.stderr) }
    }

    /// Runs the program; asserts exit code 0 and no output on stderr.
    pub fn run_well(&self, arguments: &str) -> Outcome {
        let outcome = self.run(arguments);
        assert_eq!(outcome.code, Some(0), "{arguments}: {outcome:?}");
        assert_eq!(outcome.stderr, "", "{arguments}");
        outcome
    }

    /// Runs the program; asserts exit code 2, no output on stdout and one message, and returns the message.
    pub fn refused(&self, arguments: &str) -> String {
        let outcome = self.run(arguments);
        assert_eq!(outcome.code, Some(2), "{arguments}: {outcome:?}");
        assert_eq!(outcome.stdout, "", "{arguments}");
        assert_one_message(&outcome.stderr);
        outcome.stderr.trim_end().to_owned()
    }
}

/// Asserts that stderr is one message without a trace of a panic.
pub fn assert_one_message(stderr: &str) {
    assert!(stderr.starts_with("error: "), "{stderr}");
    assert_eq!(stderr.matches("error: ").count(), 1, "{stderr}");
    assert!(!stderr.contains("panicked") && !stderr.contains("RUST_BACKTRACE"), "{stderr}");
}

/// Asserts that the message contains all parts.
pub fn assert_names(message: &str, parts: &[&str]) {
    for part in parts {
        assert!(message.contains(part), "`{part}` is not in: {message}");
    }
}

/// The repository's `data`.
pub fn data() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("data")
}

/// Names of all shipped scenes.
pub fn shipped_scenes() -> Vec<String> {
    fem_scene::names(&data())
}

/// Names of the shipped scenes of the course; there are some.
pub fn course_scenes() -> Vec<String> {
    let is_course = |name: &String| fem_scene::load(name, &data()).unwrap().pipeline == Pipeline::Course;
    let names: Vec<_> = shipped_scenes().into_iter().filter(is_course).collect();
    assert!(names.len() >= 3, "data/scenes holds {names:?}");
    names
}

/// The numbers of a list.
pub fn numbers(value: &Value) -> Vec<f64> {
    value.as_array().unwrap().iter().map(|number| number.as_f64().unwrap()).collect()
}
