//! A submission that starts as the solutions, is spoilt function by function, and is graded by the real program.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::Mutex;
use std::time::{Duration, Instant};

use grader::submission::NAMES;
use serde_json::Value;
use tempfile::TempDir;

/// Longest time for a grading on a slow machine, libraries and late answers included.
const LIMIT: Duration = Duration::from_secs(400);

/// Files that students may read.
pub const OPEN: [&str; 4] = ["results.json", "report.md", "report.html", "junit.xml"];

/// An attack that takes the machine's memory and time does so beside no other that must fail for its own reason.
static ONE_AT_A_TIME: Mutex<()> = Mutex::new(());

/// A submission before it is graded.
pub struct Classroom {
    folder: TempDir,
    expected: BTreeMap<&'static str, &'static str>,
    solutions: BTreeMap<&'static str, String>,
}

/// The grades of a class.
pub struct Attacked {
    out: TempDir,
    expected: BTreeMap<&'static str, &'static str>,
    grade: Value,
}

/// The repository that the grader is built from.
pub fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the grader lies in the repository").to_owned()
}

/// The 22 files of the solved repository.
pub fn solutions() -> BTreeMap<&'static str, String> {
    let read = |name| fs::read_to_string(repository().join(format!("src/{name}.rs"))).expect("a solution");
    NAMES.map(|name| (name, read(name))).into()
}

impl Classroom {
    /// All functions as they should be.
    pub fn new() -> Self {
        let folder = TempDir::new().expect("a folder");
        let room = Self { folder, expected: NAMES.map(|name| (name, "passed")).into(), solutions: solutions() };
        room.solutions.iter().for_each(|(name, text)| room.add(&format!("src/{name}.rs"), text));
        room
    }

    /// Writes a file of the submission.
    pub fn add(&self, path: &str, text: &str) {
        let path = self.folder.path().join("hostile").join(path);
        fs::create_dir_all(path.parent().expect("it has a folder")).expect("a folder");
        fs::write(path, text).expect("a file");
    }

    /// Changes a function's file, and records its expected result.
    pub fn change(&mut self, name: &'static str, status: &'static str, change: impl FnOnce(String) -> String) {
        self.expected.insert(name, status);
        self.add(&format!("src/{name}.rs"), &change(self.solutions[name].clone()));
    }

    /// Puts another body into a function.
    pub fn replace_body(&mut self, name: &'static str, status: &'static str, body: &str) {
        self.change(name, status, |text| {
            let start = text.find(&format!("pub fn {name}")).expect("the function");
            let open = start + text[start..].find("{\n").expect("its body");
            format!("{}\n{{\n{body}\n}}\n", &text[..open])
        });
    }

    /// Grades it while no other attack goes on, and makes sure that the repository is as before.
    pub fn grade(self) -> Attacked {
        let _guard = ONE_AT_A_TIME.lock().unwrap_or_else(std::sync::PoisonError::into_inner);
        self.grade_with(&[])
    }

    /// Grades it beside others, with the time for an answer that students have.
    pub fn grade_beside_others(self) -> Attacked {
        self.grade_with(&[("\nseconds = 1.0", "\nseconds = 5.0")])
    }

    /// The same with a rubric in which some lines are others.
    pub fn grade_with(self, lines: &[(&str, &str)]) -> Attacked {
        let out = TempDir::new().expect("a folder");
        let rubric = self.folder.path().join("rubric.toml");
        let text = fs::read_to_string(repository().join("grader/rubric.toml")).expect("the rubric");
        assert!(text.contains("\nseconds = 5.0") && text.contains("compile_seconds = 20.0"));
        let strict = text.replace("\nseconds = 5.0", "\nseconds = 1.0");
        let mut strict = strict.replace("compile_seconds = 20.0", "compile_seconds = 5.0");
        for (line, other) in lines {
            assert!(strict.contains(line), "{line}");
            strict = strict.replace(line, other);
        }
        fs::write(&rubric, strict).expect("a file");
        let begun = Instant::now();
        let output = Command::new(env!("CARGO_BIN_EXE_grader"))
            .arg("grade")
            .arg(self.folder.path().join("hostile"))
            .arg("--out")
            .arg(out.path())
            .arg("--rubric")
            .arg(&rubric)
            .args(["--seed", "1"])
            .output()
            .expect("the grader starts");
        println!("{}\n{:?}", String::from_utf8_lossy(&output.stdout), begun.elapsed());
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        assert!(begun.elapsed() < LIMIT, "{:?}", begun.elapsed());
        assert_eq!(solutions(), self.solutions, "the repository is as before");
        let grade = fs::read(out.path().join("grade.json")).expect("a grade");
        let grade = serde_json::from_slice(&grade).expect("JSON");
        Attacked { out, expected: self.expected, grade }
    }
}

impl Attacked {
    /// The grade of a function.
    pub fn function(&self, name: &str) -> &Value {
        let functions = self.grade["functions"].as_array().expect("functions");
        functions.iter().find(|function| function["name"] == name).expect("all 22 are there")
    }

    /// Asserts that each function has its expected status: full marks if that is `passed`, no marks otherwise.
    pub fn is_as_expected(&self) {
        let mut wrong = Vec::new();
        for (name, status) in &self.expected {
            let found = self.function(name);
            let points = if *status == "passed" { &found["max_score"] } else { &Value::from(0.0) };
            if !status.split(" or ").any(|status| found["status"] == status) || found["score"] != *points {
                wrong.push(format!(
                    "{name} should be {status}: {} {} {}",
                    found["status"], found["score"], found["message"]
                ));
            }
        }
        assert!(wrong.is_empty(), "{}", wrong.join("\n"));
    }

    /// Asserts all points, those of the simulation too.
    pub fn has_full_marks(&self) {
        assert_eq!(self.grade["score"], self.grade["max_score"], "{}", self.grade["simulation"]);
    }

    /// The message for the author of a function.
    pub fn message(&self, name: &str) -> &str {
        self.function(name)["message"].as_str().unwrap_or_default()
    }

    /// The remarks on the submission as a whole.
    pub fn remarks(&self) -> Vec<&str> {
        self.grade["remarks"].as_array().into_iter().flatten().filter_map(Value::as_str).collect()
    }

    /// A submission's text does not become markup on a page.
    pub fn shows_no_browser(&self, markup: &str) {
        for name in ["report.html", "junit.xml"] {
            let text = fs::read_to_string(self.out.path().join(name)).expect("a report");
            assert!(!text.contains(markup), "{name} holds {markup}");
        }
    }

    /// Bytes of a report.
    pub fn length(&self, name: &str) -> u64 {
        fs::metadata(self.out.path().join(name)).expect("a report").len()
    }

    /// A word of the instructor's is in no file that students read.
    pub fn shows_students_nothing_of(&self, secret: &str) {
        for name in OPEN {
            let text = fs::read_to_string(self.out.path().join(name)).expect("a report");
            assert!(!text.contains(secret), "{name} holds {secret}");
        }
    }
}
