//! A student's repository in any state, without a call of the compiler for each: one program holds every function three times, right,
//! wrong and without an answer, and a variable of its environment says which of them answers.

use std::collections::BTreeMap;
use std::fs;
use std::path::PathBuf;
use std::sync::LazyLock;
use std::time::Duration;

use grader::check::{Judge, Judged, Report, Role, Roles, reports};
use grader::compile::prebuilt::Prebuilt;
use grader::compile::{Fault, Plan, build};
use grader::implementation::sandboxed::Sandboxed;
use grader::sandbox::Sandbox;
use grader::status::Status;
use grader::submission::{NAMES, Source, Submission};
use tempfile::TempDir;

use crate::common::{self, repository};

/// The page of function 6 takes the matrix of function 13, which the solution does not.
const T_BY_ITS_PAGE: &str = "use crate::mass_matrix_linear_tetrahedron;
use nalgebra::{DVector, SVector};

pub fn T_linear_tetrahedron(qdot: &DVector<f64>, element: &[usize; 4], density: f64, volume: f64) -> f64 {
    let v = SVector::<f64, 12>::from_fn(|i, _| qdot[3 * element[i / 3] + i % 3]);
    0.5 * v.dot(&(mass_matrix_linear_tetrahedron(density, volume) * v))
}
";

/// A right function.
pub fn right(name: &str) -> String {
    match name {
        "T_linear_tetrahedron" => T_BY_ITS_PAGE.to_owned(),
        _ => fs::read_to_string(repository().join(format!("src/{name}.rs"))).expect("a solution"),
    }
}

/// A file whose function answers as `STATE` says: by `x` wrong, by `?` as if it were not written, by `l` never, else right.
fn switched(place: usize, name: &str) -> String {
    let text = right(name);
    let start = text.find(&format!("pub fn {name}")).expect("the function");
    let signature = &text[start..start + text[start..].find(" {\n").expect("its body")];
    let imports: String =
        text.lines().take_while(|line| !line.starts_with("///") && !line.starts_with("pub")).collect();
    let arguments = &signature[signature.find('(').expect("arguments") + 1..signature.rfind(')').expect("arguments")];
    let names = arguments.split(": ").filter_map(|part| part.rsplit([' ', ',', '(']).next());
    let names: Vec<_> = names.filter(|word| arguments.contains(&format!("{word}: "))).collect();
    let call = format!("right::{name}({})", names.join(", "));
    let result = signature.rsplit(')').next().and_then(|rest| rest.trim().strip_prefix("-> "));
    let wrong = match result {
        Some("f64") => format!("1.0 + 1.5 * {call}"),
        Some("Vec<usize>") => format!("{call}.into_iter().chain([0]).rev().collect()"),
        Some(_) => format!("{call} * 1.5"),
        None => format!("{call}; *qdot *= 1.5"),
    };
    format!(
        "{imports}\nmod right {{\n{text}\n}}\n\n{signature} {{\n    match state() {{\n        b'x' => {{ {wrong} }}\n        \
         b'?' => panic!(\"not yet implemented\"),\n        b'l' => loop {{ std::thread::park(); }},\n        _ => {call},\n    }}\n}}\n\nfn state() -> u8 {{\n    \
         static STATE: std::sync::OnceLock<u8> = std::sync::OnceLock::new();\n    \
         *STATE.get_or_init(|| std::env::var(\"STATE\").expect(\"a state\").as_bytes()[{place}])\n}}\n"
    )
}

/// The program, in its folder.
static PROGRAM: LazyLock<(TempDir, PathBuf)> = LazyLock::new(|| {
    let libraries = Prebuilt::new(&repository(), Sandbox::none()).unwrap_or_else(|error| panic!("{error}"));
    let folder = TempDir::new().expect("a folder");
    let own = NAMES.iter().enumerate().map(|(place, name)| (*name, switched(place, name))).collect();
    let plan = Plan { own, reference: None, helpers: BTreeMap::new(), limit: Duration::from_secs(60) };
    let built = build(&libraries, &Sandbox::none(), &plan, folder.path()).expect("the compiler starts");
    assert!(built.faults.is_empty(), "{:?}", built.faults);
    (folder, built.program.expect("a program"))
});

/// A process whose functions are in these states, one letter each.
fn process(state: &str) -> Sandboxed {
    process_within(state, Duration::from_secs(30))
}

/// The same with this time for an answer.
pub fn process_within(state: &str, limit: Duration) -> Sandboxed {
    let (folder, program) = &*PROGRAM;
    let (folder, program, state) = (folder.path().to_owned(), program.clone(), state.to_owned());
    common::process(program, folder, vec![("STATE".to_owned(), state)], limit)
}

/// A student's repository: the states of the functions, and its files as they would be.
pub struct Student {
    pub state: Vec<u8>,
    pub submission: Submission,
    pub faults: BTreeMap<&'static str, Fault>,
    pub roles: Roles,
}

/// How a function is broken.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Broken {
    Wrong,
    NotWritten,
    DoesNotCompile,
    Refused,
}

impl Student {
    /// With every function right.
    pub fn done() -> Self {
        let functions = NAMES.map(|name| (name, Source::Written(right(name)))).into();
        let submission = Submission { name: "student".to_owned(), functions, remarks: Vec::new() };
        let roles = NAMES.map(|name| (name, Role::Asked)).into();
        Self { state: vec![b'.'; NAMES.len()], submission, faults: BTreeMap::new(), roles }
    }

    pub fn break_one(&mut self, name: &'static str, how: Broken) {
        let source = match how {
            Broken::Wrong | Broken::DoesNotCompile => Source::Written(right(name)),
            Broken::NotWritten => Source::Missing("empty".to_owned()),
            Broken::Refused => Source::Refused { line: Some(1), reason: "not allowed".to_owned() },
        };
        self.submission.functions.insert(name, source);
        if how == Broken::DoesNotCompile {
            self.faults.insert(name, Fault { status: Status::DidNotCompile, message: "an error".to_owned() });
        }
        self.state[place(name)] = if how == Broken::Wrong { b'x' } else { b'?' };
    }

    pub fn mend(&mut self, name: &'static str) {
        self.submission.functions.insert(name, Source::Written(right(name)));
        self.faults.remove(name);
        self.state[place(name)] = b'.';
    }

    pub fn is_written(&self, name: &str) -> bool {
        matches!(self.submission.functions[name], Source::Written(_))
    }

    /// What `check` finds: of all functions, or of those that the change of one concerns.
    pub fn judged(&self, change: Option<(Judged, &str)>) -> Judged {
        let state = String::from_utf8(self.state.clone()).expect("letters");
        let (subject, trusted) = (process(&state), process(&state));
        let (submission, faults) = (&self.submission, &self.faults);
        let judge = Judge { submission, faults, subject: &subject, trusted: &trusted, begins: &|_| {} };
        match change {
            Some((earlier, changed)) => judge.after_a_change(earlier, changed),
            None => judge.all(),
        }
    }

    pub fn reports(&self, judged: &Judged) -> Vec<Report> {
        reports(judged, &self.roles, None)
    }
}

pub fn place(name: &str) -> usize {
    NAMES.iter().position(|found| *found == name).expect("a function of the course")
}
