//! The whole course: the handout has no points, every solved function counts, and right solutions have full marks.

mod common;

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::LazyLock;
use std::time::Duration;

use grader::check::{Report, check};
use grader::compile::prebuilt::Prebuilt;
use grader::compile::{Plan, build};
use grader::implementation::sandboxed::Sandboxed;
use grader::properties::{Course, FUNCTIONS};
use grader::sandbox::Sandbox;
use grader::status::Status;
use grader::submission::NAMES;
use tempfile::TempDir;

use common::repository;

/// The grader's libraries, built by whichever test comes first.
static LIBRARIES: LazyLock<Prebuilt> =
    LazyLock::new(|| Prebuilt::new(&repository(), Sandbox::none()).unwrap_or_else(|error| panic!("{error}")));

/// The students' repository.
static HANDOUT: LazyLock<TempDir> = LazyLock::new(|| {
    let folder = TempDir::new().expect("a folder");
    let output = Command::new(env!("CARGO_BIN_EXE_grader")).arg("handout").arg(folder.path()).output();
    let output = output.expect("the grader starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    folder
});

/// The 22 files of a repository.
fn texts(repository: &Path) -> BTreeMap<&'static str, String> {
    let read = |name| fs::read_to_string(repository.join(format!("src/{name}.rs"))).expect("a function");
    NAMES.map(|name| (name, read(name))).into()
}

/// Output of `check` for a repository with these files.
fn checked(texts: &BTreeMap<&'static str, String>) -> BTreeMap<&'static str, Report> {
    LazyLock::force(&LIBRARIES);
    let folder = TempDir::new().expect("a folder");
    fs::create_dir(folder.path().join("src")).expect("a folder");
    for (name, text) in texts {
        fs::write(folder.path().join(format!("src/{name}.rs")), text).expect("a file");
    }
    let reports = check(folder.path(), None).unwrap_or_else(|error| panic!("{error}"));
    reports.into_iter().map(|report| (report.name, report)).collect()
}

#[test]
fn each_solved_function_counts_in_teaching_order_and_changes_no_other() {
    let (empty, full) = (texts(HANDOUT.path()), texts(&repository()));
    for solved in [0, 11, NAMES.len()] {
        let is_solved = |name: &str| NAMES[..solved].contains(&name);
        let of = |name| if is_solved(name) { &full[name] } else { &empty[name] };
        let reports = checked(&NAMES.map(|name| (name, of(name).clone())).into());
        for (name, Report { status, messages, .. }) in &reports {
            let expected = if is_solved(name) { Status::Passed } else { Status::Missing };
            assert_eq!((*status, messages.len()), (expected, 0), "{name} of {solved}");
        }
    }
}

#[test]
fn an_error_of_the_compiler_belongs_to_the_file_that_causes_it_and_a_panic_to_the_line_of_the_student() {
    let mut files = texts(&repository());
    let mut change = |name, from: &str, to: &str| {
        let text: &mut String = files.get_mut(name).expect("a function");
        assert!(text.contains(from), "{name}: {from}");
        *text = text.replace(from, to);
    };
    change("phi_linear_tetrahedron", "pub fn", "fn");
    change("dpsi_neo_hookean_dF", "D: f64", "D: f32");
    change("psi_neo_hookean", "pub fn", "fn ( {}\npub fn");
    // The simulation passes closures by value, and a debug build panics where indices become less than zero.
    change("linearly_implicit_euler", "force: impl Fn", "force: &dyn Fn");
    change("pick_nearest_vertices", "-> Vec<usize> {", "-> Vec<usize> {\n    let _ = V.len() - 1_000_000;");
    change(
        "mass_matrix_mesh",
        "add_block(&mut M, element[a], element[b], &block);",
        "add_block(&mut M, q_size, 0, &block);",
    );
    change(
        "fixed_point_constraints",
        "-> CsrMatrix<f64> {",
        "-> CsrMatrix<f64> {\n    let _ = nalgebra::DVector::from_element(1, 1.0)[q_size];",
    );
    let reports = checked(&files);
    let first_message = |name: &str| reports[name].messages.first().map_or("", String::as_str);
    for (name, told) in [
        (
            "phi_linear_tetrahedron",
            "the file has no public function of this name; write `pub fn phi_linear_tetrahedron(V: &[Vector3<f64>]",
        ),
        (
            "dpsi_neo_hookean_dF",
            "the signature is not the course's, which is `pub fn dpsi_neo_hookean_dF(F: &Matrix3<f64>",
        ),
        ("psi_neo_hookean", "src/psi_neo_hookean.rs"),
        ("linearly_implicit_euler", "which is `pub fn linearly_implicit_euler(q: &mut DVector<f64>"),
    ] {
        assert_eq!(reports[name].status, Status::DidNotCompile, "{name}");
        assert!(first_message(name).contains(told), "{name}: {}", first_message(name));
    }
    for name in
        ["dphi_linear_tetrahedron_dX", "V_linear_tetrahedron", "dV_linear_tetrahedron_dq", "build_skinning_matrix"]
    {
        assert!(!reports[name].waits_for.is_empty(), "{name}: {:?} {:?}", reports[name].status, reports[name].messages);
    }
    for name in ["mass_matrix_mesh", "fixed_point_constraints", "pick_nearest_vertices"] {
        let line = files[name]
            .lines()
            .position(|line| ["q_size, 0", "from_element", "1_000_000"].iter().any(|mark| line.contains(mark)))
            .expect("a line");
        let told = format!("the function panicked at src/{name}.rs:{}: ", line + 1);
        assert_eq!(reports[name].status, Status::Crashed, "{name}");
        assert!(first_message(name).starts_with(&told), "{name}: {}", first_message(name));
    }
}

/// A program with these functions.
fn program(texts: BTreeMap<&'static str, String>, folder: &Path) -> PathBuf {
    let plan = Plan { own: texts, reference: None, helpers: BTreeMap::new(), limit: Duration::from_secs(20) };
    let built = build(&LIBRARIES, &Sandbox::none(), &plan, folder).expect("the compiler starts");
    assert!(built.faults.is_empty(), "{:?}", built.faults);
    built.program.expect("a program")
}

/// The program in a process of its own.
fn process(program: &Path, folder: &Path) -> Sandboxed {
    common::process(program.to_owned(), folder.to_owned(), Vec::new(), Duration::from_secs(30))
}

#[test]
fn an_empty_function_fails_each_of_its_checks_and_a_solved_one_passes_them() {
    let folders = [(); 2].map(|()| TempDir::new().expect("a folder"));
    let [at_empty, at_solved] = folders.each_ref().map(TempDir::path);
    let empty = process(&program(texts(HANDOUT.path()), at_empty), at_empty);
    let solution = program(texts(&repository()), at_solved);
    // Two processes, because a closure of one that is judged may ask another function.
    let (solved, trusted) = (process(&solution, at_solved), process(&solution, at_solved));
    for (name, checks) in FUNCTIONS {
        assert!(!checks.is_empty(), "{name} has no checks");
        for check in checks {
            empty.next_function();
            let failed = (check.run)(&Course { subject: &empty, trusted: &trusted, seed: 7 });
            assert!(failed.is_err(), "{name}: {} passes although nothing is written", check.name);
            let passed = (check.run)(&Course { subject: &solved, trusted: &trusted, seed: 7 });
            assert!(passed.is_ok(), "{name}: {}: {passed:?}", check.name);
        }
    }
}

#[cfg(target_os = "linux")]
mod grades {
    use super::*;
    use serde_json::Value;

    /// The grade that the program gives a submission.
    fn graded(submission: &Path, seed: u64, more: &[&str]) -> Value {
        LazyLock::force(&LIBRARIES);
        let out = TempDir::new().expect("a folder");
        let mut grader = Command::new(env!("CARGO_BIN_EXE_grader"));
        grader.arg("grade").arg(submission).arg("--out").arg(out.path()).args(["--seed", &seed.to_string()]).args(more);
        let output = grader.output().expect("the grader starts");
        assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
        let grade = fs::read(out.path().join("grade.json")).expect("a grade");
        serde_json::from_slice(&grade).expect("JSON")
    }

    fn has_full_marks(grade: &Value) {
        let functions = grade["functions"].as_array().expect("functions");
        let less: Vec<_> = functions.iter().filter(|function| function["status"] != "passed").collect();
        assert!(less.is_empty(), "{less:#?}");
        assert_eq!(functions.len(), NAMES.len());
        assert!(grade["score"].as_f64() > Some(0.0) && grade["score"] == grade["max_score"], "{}", grade["score"]);
    }

    #[test]
    fn a_style_of_its_own_has_full_marks_and_errs_like_the_reference() {
        let grade = graded(&Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/other_style"), 3, &["--report"]);
        has_full_marks(&grade);
        errs_like_the_reference(&grade["study"]);
    }

    fn errs_like_the_reference(study: &Value) {
        let runs = study["runs"].as_array().expect("runs");
        assert_eq!(runs.len(), 8);
        let error = |run: &Value, whose: &str| run[whose]["error"].as_f64().expect("an error");
        for run in runs {
            let (own, reference) = (error(run, "submission"), error(run, "reference"));
            assert!((own - reference).abs() < 1e-3 * reference, "{run}");
        }
        for pair in runs.windows(2).filter(|pair| pair[0]["integrator"] == pair[1]["integrator"]) {
            assert!(error(&pair[1], "reference") < 0.7 * error(&pair[0], "reference"), "{pair:?}");
        }
    }
}
