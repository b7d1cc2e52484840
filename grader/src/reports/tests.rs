//! Every format stays valid for all texts and figures of a submission.

mod formats;
mod study;

use std::fs;

use serde_json::Value;

use super::sample::{self, HOSTILE, SECRET};
use super::*;
use crate::class::Person;

fn options() -> Options {
    let variables = |name: &str| Some(format!("{}{name}", if name == "SUBMISSION_TAG" { "submit/" } else { "" }));
    Options { show_diagnosis: true, origin: classroom50::Origin::from_variables(variables) }
}

const FOR_STUDENTS: [&str; 5] = ["results.json", "result.json", "junit.xml", "report.md", "report.html"];

#[test]
fn students_read_no_counterexample() {
    let folder = tempfile::tempdir().unwrap();
    write_all(&sample::grade(2), folder.path(), &options()).unwrap();
    for name in FOR_STUDENTS {
        assert!(!fs::read_to_string(folder.path().join(name)).unwrap().contains(SECRET), "{name}");
    }
    assert!(!terminal::render(&sample::grade(2), true, true).contains(SECRET));
    assert!(fs::read_to_string(folder.path().join("grade.json")).unwrap().contains(SECRET));
}

#[test]
fn a_hidden_diagnosis_is_hidden_with_its_sentence() {
    let folder = tempfile::tempdir().unwrap();
    write_all(&sample::grade(2), folder.path(), &Options { show_diagnosis: false, ..options() }).unwrap();
    for name in FOR_STUDENTS {
        let text = fs::read_to_string(folder.path().join(name)).unwrap();
        assert!(!text.contains("negated") && !text.contains("opposite sign"), "{name}");
        assert!(text.contains("finite difference of the energy"), "the hint is missing in {name}");
    }
}

#[test]
fn a_grade_is_read_back_and_leaves_no_other_file() {
    let folder = tempfile::tempdir().unwrap();
    write_all(&sample::grade(2), folder.path(), &Options::default()).unwrap();
    let (written, back) = (sample::grade(2), json::read(&folder.path().join("grade.json")).unwrap());
    assert_eq!((back.submission, back.seed, back.score), (written.submission, written.seed, written.score));
    assert_eq!(back.sandbox, written.sandbox);
    for (back, written) in back.functions.iter().zip(&written.functions) {
        assert_eq!((&back.name, back.status, &back.diagnosis), (&written.name, written.status, &written.diagnosis));
        assert_eq!((back.checks.len(), back.error.is_some()), (written.checks.len(), written.error.is_some()));
    }
    let mut names: Vec<_> = fs::read_dir(folder.path()).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    names.sort();
    assert_eq!(names, ["grade.json", "junit.xml", "report.html", "report.md", "results.json"]);
}

#[test]
fn another_format_version_is_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("grade.json");
    let grade = Grade { format_version: 99, ..sample::grade(0) };
    fs::write(&path, json::render(&grade).unwrap()).unwrap();
    assert!(json::read(&path).unwrap_err().to_string().contains("version 99"));
}

#[test]
fn figures_that_are_no_numbers_become_null_and_scores_are_refused() {
    let grade: Value = serde_json::from_str(&json::render(&sample::hostile()).unwrap()).unwrap();
    assert_eq!(grade["functions"][0]["error"], Value::Null);
    assert_eq!(grade["functions"][0]["seconds"], Value::Null);
    let folder = tempfile::tempdir().unwrap();
    let grade = Grade { score: f64::NAN, ..sample::grade(0) };
    assert!(write_all(&grade, folder.path(), &options()).is_err());
    assert_eq!(fs::read_dir(folder.path()).unwrap().count(), 0);
}

#[test]
fn pages_run_no_text_of_a_submission() {
    let class = sample::class();
    let people = vec![Person { student: HOSTILE.to_owned(), name: HOSTILE.to_owned(), ..Person::default() }];
    let class = Summary { people, title: HOSTILE.to_owned(), ..class };
    let class_page = class_html::render(&rows::rows(&class.entries), &class);
    for (page, scripts) in [(html::render(&sample::hostile(), true), 0), (class_page, 1)] {
        assert_eq!(page.matches("<script").count(), scripts);
        assert_eq!(page.matches("</title>").count(), page.matches("<title>").count());
        assert!(!page.contains("NaN") && !page.contains("inf"));
        assert!(!page.contains("src=") && !page.contains("href=\"http") && !page.contains("url("));
    }
}

#[test]
fn links_stay_beside_the_page() {
    assert_eq!(escape::link("a b/report.html"), "./a%20b/report.html");
    assert_eq!(escape::link("javascript:alert(1)"), "./javascript%3Aalert%281%29");
    assert_eq!(escape::link("//evil.example/x"), "./evil.example/x");
}

#[test]
fn markdown_shows_marks_as_they_are() {
    assert_eq!(escape::markdown("a|b `c` <b> _d_ @e"), r"a\|b \`c\` \<b\> \_d\_ \@e");
    assert_eq!(escape::markdown("- http://x\n# y"), r"\- http\://x \# y");
    assert_eq!(escape::fenced("x\n````\ny"), "`````text\nx\n````\ny\n`````\n");
    assert!(markdown::render(&sample::hostile(), true).lines().all(|line| !line.starts_with("</")));
}

#[test]
fn a_terminal_obeys_no_submission() {
    assert_eq!(escape::plain("a\u{1b}[31mb\u{1b}]0;title\u{7}c\u{0}\u{9b}d\r\ne\rf"), "abcd\ne\nf");
    assert!(!terminal::render(&sample::hostile(), true, false).contains(|c: char| c.is_control() && c != '\n'));
    assert!(terminal::render(&sample::grade(2), true, true).contains("\u{1b}[32m"));
    let table = terminal::render(&sample::grade(2), true, false);
    let widths: Vec<usize> = table.lines().take(24).map(|line| line.chars().count()).collect();
    assert!(widths.iter().all(|width| *width == widths[0]), "the table is not aligned:\n{table}");
}

#[test]
fn a_spreadsheet_runs_no_cell() {
    for text in ["=1+1", "+1", "-1", "@x", "\t=1", " =1", "＝1", "\r\n@x"] {
        assert!(escape::cell(text).starts_with('\''), "{text:?}");
    }
    assert_eq!(escape::cell("O'Brien, \"x\""), "O'Brien, \"x\"");
}

/// The cells of a written table, the heading first.
fn table(folder: &Path, name: &str) -> Vec<Vec<String>> {
    let text = fs::read_to_string(folder.join(name)).unwrap();
    let text = text.strip_prefix('\u{feff}').expect("a mark for Excel");
    let mut reader = ::csv::ReaderBuilder::new().has_headers(false).from_reader(text.as_bytes());
    reader.records().map(|row| row.unwrap().iter().map(str::to_owned).collect()).collect()
}

#[test]
fn the_class_table_has_a_row_for_each_submission_that_counts_graded_or_not() {
    let folder = tempfile::tempdir().unwrap();
    write_class(&sample::class(), folder.path()).unwrap();
    let rows = table(folder.path(), "grades.csv");
    assert_eq!(rows[0][..6], ["student", "submission", "score", "max_score", "note", "phi_linear_tetrahedron"]);
    assert_eq!(rows.len(), 1 + 33);
    let row = |submission: &str| rows.iter().find(|row| row[1] == submission).expect(submission);
    assert_eq!(row("late")[..5], ["'+late", "late", "", "", "not graded yet"]);
    assert_eq!(row("lost")[4], "not graded: no end within 600 s; see failed/lost.log");
    assert!(row("lost")[5..].iter().all(String::is_empty));
    assert_eq!(row("submission-03")[4], "in place of first");
    assert_eq!(row("submission-01")[4], "README.txt was left aside");
    assert!(!rows.iter().any(|row| row[1] == "first"), "an older submission would be a second row of its student");
}

#[test]
fn no_cell_of_a_class_table_is_a_formula() {
    let folder = tempfile::tempdir().unwrap();
    write_class(&sample::class(), folder.path()).unwrap();
    let (grades, errors) = (table(folder.path(), "grades.csv"), table(folder.path(), "errors.csv"));
    assert_eq!((grades.len(), errors.len()), (34, 3));
    assert!(!grades.iter().chain(&errors).flatten().any(|cell| cell.starts_with(['=', '+', '-', '@', '\t', '\r'])));
    for rows in [&grades, &errors] {
        assert!(rows.iter().any(|row| row[..2] == ["'=odd", "'-odd"]));
    }
    assert!(grades.iter().any(|row| row[1] == escape::cell(HOSTILE)));
}

#[test]
fn the_class_page_shows_what_is_not_graded_and_counts_it_in_no_figure() {
    let folder = tempfile::tempdir().unwrap();
    write_class(&sample::class(), folder.path()).unwrap();
    let page = fs::read_to_string(folder.path().join("class.html")).unwrap();
    assert!(
        page.contains("<b>33</b><span>students with a submission</span>")
            && page.contains("<b>3</b><span>without a grade</span>")
    );
    assert!(page.contains("<td>@lost</td><td>lost</td><td class=\"right\">–</td>"));
    assert!(page.contains("not graded: no end within 600 s") && page.contains("in place of first"));
    let graded = Summary { entries: sample::class().entries.drain(..30).collect(), ..sample::empty_class() };
    write_class(&graded, folder.path()).unwrap();
    let without = fs::read_to_string(folder.path().join("class.html")).unwrap();
    assert!(!without.contains("without a grade"));
    let median = |page: &str| page[..page.find("median score").unwrap()].rsplit("<b>").next().unwrap().to_owned();
    assert_eq!(median(&page), median(&without));
}

#[test]
fn the_class_page_has_the_title_names_and_numbers_to_sort_by() {
    let person =
        |student: &str, name: &str| Person { student: student.to_owned(), name: name.to_owned(), ..Person::default() };
    let mut class = sample::class();
    class.people = vec![person("Ünal 00", "Ünal, Anna"), person("@lost", "Berg, Bob")];
    // A group's submission.
    class.entries[1].submission = class.entries[0].submission.clone();
    let page = class_html::render(&rows::rows(&class.entries), &class);
    assert!(page.contains("<h1>Homework</h1>") && page.contains("<title>Homework: class</title>"), "{page}");
    assert!(
        page.contains("<b>33</b><span>students with a submission</span>")
            && page.contains("<b>32</b><span>submissions</span>")
    );
    assert!(
        page.contains("<td>Ünal 00</td><td>Ünal, Anna</td><td><a href=")
            && page.contains("<td>@lost</td><td>Berg, Bob</td>")
    );
    assert!(page.contains("table class=\"sortable\"><thead>") && page.contains("<td class=\"right\" data-sort=\""));
}

#[test]
fn the_students_page_links_to_the_page_of_each_function() {
    let page = html::render(&sample::grade(2), true);
    let link = r#"<a href="include-docs/psi_neo_hookean.md">include-docs/psi_neo_hookean.md</a>"#;
    assert!(page.contains(link), "{page}");
    assert_eq!(page.matches("Page: <a").count(), 22);
    let grade = Grade { pages: Some("https://x.org/\"{name}.html".to_owned()), ..sample::grade(2) };
    assert!(html::render(&grade, true).contains(r#"href="https://x.org/&quot;newtons_method.html""#));
}

#[test]
fn an_empty_class_still_has_its_page() {
    let folder = tempfile::tempdir().unwrap();
    write_class(&sample::empty_class(), folder.path()).unwrap();
    assert!(fs::read_to_string(folder.path().join("class.html")).unwrap().contains("No submission"));
    assert_eq!(table(folder.path(), "grades.csv").len(), 1);
}
