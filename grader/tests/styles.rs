//! Right submissions in different styles, written from the pages alone, have full marks.
#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;

/// Folders below `tests`: nested index loops; chains of iterators, f evaluated wherever its value is needed; full matrices, Newton's
/// direction by the opposite of a solve, one halving more; triplets with duplicates and stored zeros, other orders of the closures;
/// recursion; other linear algebra, the material's derivatives by dual numbers, Newton's method written out in implicit Euler.
const STYLES: [&str; 7] = [
    "other_style",
    "styles/indices",
    "styles/iterators",
    "styles/dense",
    "styles/triplets",
    "styles/recursive",
    "styles/algebra",
];

/// The points that are missing, and the checks that fail.
fn lost(style: &str, seed: u64) -> Vec<String> {
    let out = TempDir::new().expect("a folder");
    let submission = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests").join(style);
    let mut grader = Command::new(env!("CARGO_BIN_EXE_grader"));
    grader.arg("grade").arg(submission).arg("--out").arg(out.path()).args(["--seed", &seed.to_string()]);
    let output = grader.output().expect("the grader starts");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let grade = fs::read(out.path().join("grade.json")).expect("a grade");
    let grade: Value = serde_json::from_slice(&grade).expect("JSON");
    let functions = grade["functions"].as_array().expect("functions").iter().chain([&grade["simulation"]]);
    let less = functions.filter(|function| function["status"] != "passed");
    let mut lost: Vec<_> = less.map(|function| format!("{style}, seed {seed}: {function}")).collect();
    if grade["score"] != grade["max_score"] {
        lost.push(format!("{style}, seed {seed}: {} of {} points", grade["score"], grade["max_score"]));
    }
    lost
}

#[test]
fn full_matrices_have_full_marks() {
    assert_eq!(lost("styles/dense", 4), [""; 0]);
}

#[test]
fn triplets_with_duplicates_have_full_marks() {
    assert_eq!(lost("styles/triplets", 4), [""; 0]);
}

#[test]
fn other_linear_algebra_has_full_marks() {
    assert_eq!(lost("styles/algebra", 4), [""; 0]);
}

#[test]
#[ignore = "takes many minutes; .ci/long runs it"]
fn every_style_has_full_marks_with_twenty_seeds() {
    let lost: Vec<_> = STYLES.iter().flat_map(|style| (100..120).flat_map(|seed| lost(style, seed))).collect();
    assert!(lost.is_empty(), "{lost:#?}");
}
