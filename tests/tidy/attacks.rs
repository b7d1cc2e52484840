//! The table of attacks names tests that exist.

use super::{assert_none, files, read};

#[test]
fn every_attack_of_the_table_has_tests_that_exist() {
    let sources: String = files("rs").iter().filter(|path| path.starts_with("grader")).map(read).collect();
    let text = read("docs/book/attacks.md");
    let rows: Vec<&str> =
        text.lines().filter(|line| line.starts_with("| ") && !line.starts_with("| attack |")).collect();
    assert!(rows.len() >= 30, "docs/book/attacks.md has {} attacks; keep the table", rows.len());
    let mut problems = Vec::new();
    for row in rows {
        let tests = row.trim_end_matches([' ', '|']).rsplit(" | ").next().unwrap_or_default();
        let names: Vec<&str> = tests.split('`').skip(1).step_by(2).collect();
        let unknown = names.iter().filter(|name| !sources.contains(&format!("fn {name}()")));
        problems.extend(unknown.map(|name| format!("docs/book/attacks.md: there is no test {name}; correct the row")));
        if names.is_empty() {
            problems.push(format!("docs/book/attacks.md: {row}; name the test of this attack"));
        }
    }
    assert_none(problems);
}
