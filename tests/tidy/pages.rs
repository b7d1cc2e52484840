//! The pages of the course and the links between pages.

use std::path::Path;

use grader::submission::NAMES;

use super::{assert_none, files, read, root};

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
