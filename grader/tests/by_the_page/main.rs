//! Each page is a contract: 22 functions that follow their pages to the letter, without a guard that a page does not ask for, have full
//! marks, whatever the random inputs.
#![cfg(target_os = "linux")]

use std::fs;
use std::path::Path;
use std::process::Command;

use serde_json::Value;
use tempfile::TempDir;

/// The functions with less than full marks, each with its failed checks.
fn lost(seed: u64) -> Vec<String> {
    let out = TempDir::new().expect("a folder");
    let submission = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/by_the_page");
    let mut grader = Command::new(env!("CARGO_BIN_EXE_grader"));
    grader.arg("grade").arg(submission).arg("--out").arg(out.path()).args(["--seed", &seed.to_string()]);
    let output = grader.output().expect("the grader starts");
    assert_eq!(output.status.code(), Some(0), "{}", String::from_utf8_lossy(&output.stderr));
    let grade = fs::read(out.path().join("grade.json")).expect("a grade");
    let grade: Value = serde_json::from_slice(&grade).expect("JSON");
    let functions = grade["functions"].as_array().expect("functions").iter().chain([&grade["simulation"]]);
    let mut lost: Vec<_> = functions
        .filter(|part| part["status"] != "passed")
        .map(|part| format!("seed {seed}: {}", failures(part)))
        .collect();
    if grade["score"] != grade["max_score"] {
        lost.push(format!("seed {seed}: {} of {} points", grade["score"], grade["max_score"]));
    }
    lost
}

/// Name, message and failed checks of a function.
fn failures(part: &Value) -> String {
    let checks = part["checks"].as_array().map(Vec::as_slice).unwrap_or_default();
    let failed: Vec<_> = checks.iter().filter(|check| check["status"] != "passed").collect();
    format!("{} ({}): {failed:#?}", part["name"], part["message"])
}

#[test]
fn functions_that_follow_their_pages_to_the_letter_have_full_marks() {
    let lost = lost(1);
    assert!(lost.is_empty(), "{}", lost.join("\n"));
}

#[test]
#[ignore = "takes some minutes; run it after a change of the checks"]
fn functions_that_follow_their_pages_to_the_letter_have_full_marks_with_fifty_seeds() {
    let lost: Vec<_> = (1..=50).flat_map(lost).collect();
    assert!(lost.is_empty(), "{}", lost.join("\n"));
}
