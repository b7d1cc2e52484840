//! Length and layout of every file.

use super::{assert_none, files, read};

#[test]
fn the_map_of_the_code_has_at_most_150_lines() {
    let lines = read("ARCHITECTURE.md").lines().count();
    assert!(lines <= 150, "ARCHITECTURE.md: {lines} lines; move what explains a choice to docs/decisions");
}

#[test]
fn no_file_has_tabs_spaces_at_the_end_of_a_line_or_a_last_line_without_an_end() {
    let mut problems = Vec::new();
    for path in ["rs", "md", "toml"].iter().flat_map(|extension| files(extension)) {
        let text = read(&path);
        for (number, line) in text.lines().enumerate() {
            if line.contains('\t') || line.ends_with([' ', '\r']) {
                problems.push(format!(
                    "{}, line {}: remove the tab or the spaces at its end",
                    path.display(),
                    number + 1
                ));
            }
        }
        if !text.ends_with('\n') || text.ends_with("\n\n") {
            problems.push(format!("{}: let it end in one line end", path.display()));
        }
    }
    assert_none(problems);
}

#[test]
fn no_code_is_left_unfinished() {
    // Inside quotes a word is talked about, not used.
    let is_used = |line: &str, word: &str| line.find(word).is_some_and(|at| !line[..at].contains(['"', '`']));
    let note = concat!("FIX", "ME");
    let mut problems = Vec::new();
    for path in files("rs") {
        for (number, line) in read(&path).lines().enumerate() {
            if ["todo!", "unimplemented!", "dbg!"].iter().any(|word| is_used(line, word)) || line.contains(note) {
                problems.push(format!("{}, line {}: `{}`; finish it", path.display(), number + 1, line.trim()));
            }
        }
    }
    assert_none(problems);
}
