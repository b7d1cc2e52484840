//! The pages of the course and the links between pages.

use std::path::{Path, PathBuf};

use grader::submission::NAMES;

use super::{assert_none, files, read, root, stem};

#[test]
fn every_exercise_has_a_page_with_the_same_headings_in_the_same_order() {
    let headings = |name: &str| -> Vec<String> {
        let text = read(format!("include-docs/{name}.md"));
        text.lines().filter(|line| line.starts_with('#')).map(str::to_owned).collect()
    };
    let expected = headings(NAMES[0]);
    assert!(expected.len() >= 5, "include-docs/{}.md has the headings {expected:?} alone; complete it", NAMES[0]);
    let differs = |name: &&str| headings(name) != expected;
    let problem = |name| format!("include-docs/{name}.md: headings {:?}; make them {expected:?}", headings(name));
    assert_none(NAMES.into_iter().filter(differs).map(problem).collect());
}

#[test]
fn links_to_files_lead_somewhere() {
    let mut problems = Vec::new();
    for path in files("md") {
        for (number, line) in read(&path).lines().enumerate() {
            let targets = line.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next());
            let is_local = |target: &&str| !target.is_empty() && !target.contains(':');
            for target in targets.filter(is_local) {
                // The page of the students' repository stands in its root.
                let place = if path.starts_with("grader/handout") { Path::new("README.md") } else { &path };
                if !root().join(place).parent().unwrap().join(target).exists() {
                    problems.push(format!(
                        "{}, line {}: there is no {target}; correct the link",
                        path.display(),
                        number + 1
                    ));
                }
            }
        }
    }
    assert_none(problems);
}

#[test]
fn files_that_the_map_and_the_decisions_name_exist() {
    let folders = ["src/", "crates/", "grader/", "tests/", "benches/", "docs/", "data/", "examples/", "include-docs/"];
    let is_path = |word: &&str| folders.iter().any(|folder| word.starts_with(folder)) && !word.contains(' ');
    let is_page = |path: &&PathBuf| *path == Path::new("ARCHITECTURE.md") || path.starts_with("docs/decisions");
    let (mut problems, mut count) = (Vec::new(), 0);
    for path in files("md").iter().filter(is_page) {
        for (number, line) in read(path).lines().enumerate() {
            for named in line.split('`').skip(1).step_by(2).filter(is_path) {
                count += 1;
                if !root().join(named).exists() {
                    problems.push(format!(
                        "{}, line {}: there is no {named}; correct the path",
                        path.display(),
                        number + 1
                    ));
                }
            }
        }
    }
    assert!(count > 80, "only {count} paths are found in ARCHITECTURE.md and docs/decisions");
    assert_none(problems);
}

#[test]
fn every_decision_is_in_the_list_of_decisions() {
    let list = read("docs/decisions/README.md");
    let is_decision = |path: &&PathBuf| path.starts_with("docs/decisions") && stem(path) != "README";
    let files = files("md");
    let names = files.iter().filter(is_decision).map(|path| stem(path));
    let missing = names.filter(|name| !list.contains(&format!("- [{name}]({name}.md): ")));
    assert_none(missing.map(|name| format!("docs/decisions/README.md: add a line for {name}.md")).collect());
}
