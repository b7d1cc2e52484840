//! The files of the 22 exercises.

use std::collections::BTreeSet;
use std::path::Path;

use grader::submission::NAMES;

use super::{assert_none, files, read, stem};

/// Exercises of two parts each – a search and what to do where it finds nothing, a ray and its hit, a direction and the step
/// along it – that would not be clearer in two files.
const LONGER_EXERCISES: [&str; 3] = ["build_skinning_matrix", "pick_nearest_vertices", "newtons_method"];

#[test]
fn every_file_in_src_is_an_exercise_or_belongs_to_the_demo() {
    let rest = ["lib", "main", "assignment_setup"];
    let found: BTreeSet<_> =
        files("rs").iter().filter(|path| path.parent() == Some(Path::new("src"))).map(|path| stem(path)).collect();
    let expected: BTreeSet<_> = NAMES.iter().chain(&rest).map(|name| name.to_string()).collect();
    let both = format!("{:?}", found.symmetric_difference(&expected));
    assert_eq!(found, expected, "src/ and the list in tests/tidy.rs differ by {both}; add or remove the file");
}

#[test]
fn every_exercise_file_holds_one_public_function_that_is_named_like_it() {
    let mut problems = Vec::new();
    for name in NAMES {
        let text = read(format!("src/{name}.rs"));
        let public: Vec<_> = text.lines().filter(|line| line.starts_with("pub")).collect();
        let is_function =
            |line: &str| line.strip_prefix(&format!("pub fn {name}")).is_some_and(|rest| rest.starts_with(['(', '<']));
        if !matches!(public[..], [line] if is_function(line)) {
            problems.push(format!("src/{name}.rs: `pub fn {name}` must be its only public item; found {public:?}"));
        }
    }
    assert_none(problems);
}

#[test]
fn exercises_are_short() {
    let mut problems = Vec::new();
    for name in NAMES {
        let (lines, most) =
            (read(format!("src/{name}.rs")).lines().count(), if LONGER_EXERCISES.contains(&name) { 85 } else { 60 });
        if lines > most {
            problems.push(format!("src/{name}.rs: {lines} lines; shorten it to {most}"));
        }
    }
    assert_none(problems);
}
