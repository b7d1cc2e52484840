//! Rubrics that ask for some of the functions, graded by the real program.
#![cfg(target_os = "linux")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Output};

use grader::status::Status;
use grader::submission::NAMES;
use serde_json::Value;
use tempfile::TempDir;

fn repository() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().expect("the grader lies in the repository").to_owned()
}

fn solution(name: &str) -> String {
    fs::read_to_string(repository().join(format!("src/{name}.rs"))).expect("a solution")
}

/// A submission with the solutions of these functions.
fn submission(names: &[&str]) -> TempDir {
    let folder = TempDir::new().expect("a folder");
    fs::create_dir(folder.path().join("src")).expect("a folder");
    names.iter().for_each(|name| add(&folder, name, &solution(name)));
    folder
}

fn add(folder: &TempDir, name: &str, text: &str) {
    fs::write(folder.path().join(format!("src/{name}.rs")), text).expect("a file");
}

fn graded(submission: &Path, rubric: &Path, out: &Path, more: &[&str]) -> Output {
    let mut grader = Command::new(env!("CARGO_BIN_EXE_grader"));
    grader.arg("grade").arg(submission).arg("--rubric").arg(rubric).arg("--out").arg(out).args(more);
    grader.output().expect("the grader starts")
}

fn grade(submission: &Path, rubric: &Path) -> Value {
    grade_with(submission, rubric, &["--seed", "5"])
}

fn grade_with(submission: &Path, rubric: &Path, more: &[&str]) -> Value {
    let out = TempDir::new().expect("a folder");
    let output = graded(submission, rubric, out.path(), more);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    serde_json::from_slice(&fs::read(out.path().join("grade.json")).expect("a grade")).expect("JSON")
}

fn functions(grade: &Value) -> Vec<(&str, &str)> {
    let all = grade["functions"].as_array().expect("functions").iter();
    all.map(|function| (function["name"].as_str().unwrap_or(""), function["status"].as_str().unwrap_or(""))).collect()
}

#[test]
fn the_reference_stands_in_for_what_is_given_also_in_the_simulation() {
    let folder = submission(&NAMES[13..]);
    add(&folder, "psi_neo_hookean", &solution("psi_neo_hookean").replace("- 3.0", "- 2.0"));
    add(&folder, "fixed_point_constraints", "pub fn fixed_point_constraints() {}");
    let grade = grade(folder.path(), &repository().join("grader/rubrics/second.toml"));
    let expected =
        |name: &&'static str| (*name, if *name == "fixed_point_constraints" { "did_not_compile" } else { "passed" });
    assert_eq!(functions(&grade), NAMES[13..].iter().map(expected).collect::<Vec<_>>());
    assert_eq!((&grade["score"], &grade["max_score"]), (&Value::from(44.0), &Value::from(47.0)));
    let remarks = grade["remarks"].to_string();
    assert!(
        remarks.contains("src/psi_neo_hookean.rs is given solved") && remarks.matches("given").count() == 1,
        "{remarks}"
    );

    add(&folder, "fixed_point_constraints", &solution("fixed_point_constraints"));
    let whole = self::grade(folder.path(), &repository().join("grader/rubrics/second.toml"));
    assert_eq!((&whole["simulation"]["status"], &whole["score"]), (&Value::from("passed"), &Value::from(47.0)));
}

#[test]
fn a_given_function_that_calls_what_is_asked_for_calls_the_students_own() {
    let all = fs::read_to_string(repository().join("grader/rubric.toml")).expect("the rubric");
    let tables: Vec<&str> = all.split("[[function]]\n").collect();
    let is_asked =
        |table: &&&str| ["\"psi_neo_hookean\"", "\"newtons_method\""].iter().any(|name| table.contains(name));
    let asked = tables[1..].iter().filter(is_asked).map(|table| format!("[[function]]\n{table}")).collect::<String>();
    let folder = submission(&["psi_neo_hookean", "newtons_method"]);
    let rubric = folder.path().join("rubric.toml");
    fs::write(&rubric, format!("{}{asked}", tables[0])).expect("a file");
    let right = grade(folder.path(), &rubric);
    assert_eq!(functions(&right), [("psi_neo_hookean", "passed"), ("newtons_method", "passed")]);
    assert_eq!(right["simulation"]["status"], "passed");

    add(&folder, "psi_neo_hookean", &solution("psi_neo_hookean").replace("C *", "2.0 * C *"));
    let wrong = grade(folder.path(), &rubric);
    assert_eq!(functions(&wrong), [("psi_neo_hookean", "failed"), ("newtons_method", "passed")]);
    assert_eq!(wrong["simulation"]["status"], "failed", "the energy that the simulation minimises is the student's");
}

#[test]
fn what_a_later_assignment_asks_for_is_not_needed_a_deadline_counts_and_one_function_is_graded_again() {
    let folder = submission(&NAMES[..13]);
    let rubric = folder.path().join("rubric.toml");
    let first = fs::read_to_string(repository().join("grader/rubrics/first.toml")).expect("the rubric");
    let strict =
        first.replace("2026-05-04T23:59:00+02:00", "2026-05-04T12:00:00Z").replace("per_day = 0.1", "per_day = 0.5");
    fs::write(&rubric, strict).expect("a file");
    let metadata = folder.path().join("submission_metadata.json");
    let who = r#"{"created_at": "2026-05-04T06:00:00-07:00", "users": [{"email": "anna@x.org"}]}"#;
    fs::write(&metadata, who).expect("a file");
    let late = grade_with(folder.path(), &rubric, &["--seed", "5", "--metadata", &metadata.display().to_string()]);
    assert_eq!((&late["score"], &late["account"]["raw_score"]), (&Value::from(26.5), &Value::from(53.0)));
    assert_eq!(functions(&late), NAMES[..13].iter().map(|name| (*name, "passed")).collect::<Vec<_>>());
    assert_eq!(late["max_score"], 53.0);
    assert!(late["simulation"]["message"].as_str().is_some_and(|told| told.contains("later assignment")));
    assert!(late["remarks"].to_string().contains("1 day late: 53 points, less 50 %, are 26.5"), "{}", late["remarks"]);

    let mut earlier = late.clone();
    for function in earlier["functions"].as_array_mut().expect("functions") {
        function["diagnosis"] = Value::from("of the first time");
    }
    let path = folder.path().join("earlier.json");
    fs::write(&path, earlier.to_string()).expect("a file");
    let again = ["--seed", "5", "--earlier", &path.display().to_string(), "--function", "T_linear_tetrahedron"];
    let again = grade_with(folder.path(), &rubric, &again);
    assert_eq!(again["functions"][5]["diagnosis"], Value::Null);
    let kept = again["functions"].as_array().expect("functions").iter();
    assert_eq!(kept.filter(|function| function["diagnosis"] == "of the first time").count(), 12);
    assert_eq!(functions(&again), functions(&late));
}

#[test]
fn students_check_what_is_asked_for_beside_what_is_given_and_read_nothing_of_what_comes_later() {
    for (file, missing, passed) in
        [("first.toml", &NAMES[..13], &NAMES[..0]), ("second.toml", &NAMES[13..], &NAMES[..13])]
    {
        let folder = TempDir::new().expect("a folder");
        let mut grader = Command::new(env!("CARGO_BIN_EXE_grader"));
        grader.arg("handout").arg(folder.path()).arg("--rubric").arg(repository().join("grader/rubrics").join(file));
        assert!(grader.status().expect("the grader starts").success());
        let reports = grader::check::check(folder.path(), None).unwrap_or_else(|error| panic!("{error}"));
        let with = |status| {
            reports.iter().filter(|report| report.status == status).map(|report| report.name).collect::<Vec<_>>()
        };
        assert_eq!((with(Status::Missing), with(Status::Passed)), (missing.to_vec(), passed.to_vec()));
        assert_eq!(reports.len(), missing.len() + passed.len());
    }
}

/// Grades with an own check of psi_neo_hookean.
fn with_own_check(submission: &Path, check: &str) -> (Output, Value) {
    let folder = TempDir::new().expect("a folder");
    let rubric = folder.path().join("rubric.toml");
    let first = fs::read_to_string(repository().join("grader/rubrics/first.toml")).expect("the rubric");
    let own = "\n[[check]]\nfunction = \"psi_neo_hookean\"\nname = \"it is linear in its constants\"\nfile = \"checks/own.rs\"\n";
    fs::write(&rubric, format!("{first}{own}")).expect("a file");
    fs::create_dir(folder.path().join("checks")).expect("a folder");
    fs::write(folder.path().join("checks/own.rs"), check).expect("a file");
    let output = graded(submission, &rubric, &folder.path().join("out"), &["--seed", "3"]);
    let grade = fs::read(folder.path().join("out/grade.json")).ok().and_then(|text| serde_json::from_slice(&text).ok());
    (output, grade.unwrap_or_default())
}

#[test]
#[ignore = "builds the grader anew, with its dependencies the first time; run it after a change of own_checks.rs or build.rs"]
fn a_check_beside_the_rubric_judges_like_any_other_and_its_mistakes_are_named_with_their_line() {
    let example = repository().join("grader/rubrics/checks/energy_is_linear_in_its_constants.rs");
    let check = fs::read_to_string(example).expect("the example");
    let folder = submission(&NAMES[..13]);
    let (output, right) = with_own_check(folder.path(), &check);
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let checks = right["functions"][2]["checks"].as_array().expect("checks");
    assert_eq!(checks.last().map(|check| check["name"].clone()), Some(Value::from("it is linear in its constants")));
    assert_eq!(right["score"], right["max_score"]);

    add(
        &folder,
        "psi_neo_hookean",
        &solution("psi_neo_hookean").replace("+ D * J_minus_1 * J_minus_1", "+ D * D * J_minus_1 * J_minus_1"),
    );
    let (_, wrong) = with_own_check(folder.path(), &check);
    let psi = &wrong["functions"][2];
    let failed = psi["checks"].as_array().and_then(|checks| checks.last()).expect("checks");
    assert_eq!(
        (&failed["status"], &failed["message"]),
        (&Value::from("failed"), &Value::from("three times C and D is three times the energy"))
    );

    let (output, none) = with_own_check(folder.path(), &check.replace("near_number(rule,", "near_numbers(rule,"));
    let told = String::from_utf8_lossy(&output.stderr);
    assert_eq!((output.status.code(), none), (Some(2), Value::Null));
    assert!(told.contains("checks/own.rs:12:") && told.contains("near_numbers"), "{told}");
}
