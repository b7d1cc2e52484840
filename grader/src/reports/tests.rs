//! Each format keeps its shape, whatever a submission's texts and figures are.

use std::fs;

use serde_json::Value;

use super::sample::{self, HOSTILE, SECRET};
use super::*;

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
fn grade_json_has_the_keys_of_the_contract() {
    let grade: Value = serde_json::from_str(&json::render(&sample::grade(0)).unwrap()).unwrap();
    for key in ["format_version", "score", "max_score", "seed", "toolchain", "sandbox", "functions"] {
        assert!(!grade[key].is_null(), "{key}");
    }
    let function = grade["functions"][0].as_object().unwrap();
    for key in ["name", "score", "max_score", "status", "diagnosis", "error", "seconds", "reference_seconds", "checks"]
    {
        assert!(function.contains_key(key), "{key}");
    }
    assert_eq!(grade["seed"].as_u64(), Some(u64::MAX));
}

#[test]
fn gradescope_gets_allowed_values_alone() {
    for grade in [sample::grade(2), sample::hostile()] {
        let results: Value = serde_json::from_str(&gradescope::render(&grade, true).unwrap()).unwrap();
        let score = results["score"].as_f64().unwrap();
        assert!((0.0..=grade.max_score).contains(&score));
        assert_eq!(results["stdout_visibility"], "hidden");
        assert_eq!(results["visibility"], "visible");
        assert!(results["execution_time"].is_number());
        let tests = results["tests"].as_array().unwrap();
        assert_eq!(tests.len(), 23);
        for test in tests {
            assert!(test["score"].as_f64().unwrap() <= test["max_score"].as_f64().unwrap());
            assert!(["passed", "failed"].contains(&test["status"].as_str().unwrap()));
            assert_eq!(test["output_format"], "text");
        }
        assert!(results["leaderboard"].as_array().unwrap().iter().all(|entry| entry["value"].is_number()));
    }
}

#[test]
fn classroom50_gets_whole_numbers_and_the_origin() {
    let text = classroom50::render(&sample::grade(2), &options().origin.unwrap(), true).unwrap();
    let result: Value = serde_json::from_str(&text).unwrap();
    assert_eq!(result["schema"], "classroom50/result/v1");
    assert!(result["submission"].as_str().unwrap().starts_with("submit/"));
    assert!(result["score"].as_u64().unwrap() <= result["max-score"].as_u64().unwrap());
    assert_eq!(result["max-score"], 10_000);
    for test in result["tests"].as_array().unwrap() {
        assert!(test["test-name"].is_string() && test["passed"].is_boolean());
        assert!(test["score"].as_u64().unwrap() <= test["max-score"].as_u64().unwrap());
    }
    assert!(classroom50::Origin::from_variables(|_| None).is_none());
}

#[test]
fn junit_has_a_case_for_every_check_and_for_every_function_without() {
    let grade = sample::grade(2);
    let report = quick_junit::Report::deserialize_from_str(&junit::render(&grade, true).unwrap()).unwrap();
    assert_eq!(report.test_suites.len(), 23);
    for (suite, part) in report.test_suites.iter().zip(view::parts(&grade)) {
        assert_eq!(suite.test_cases.len(), part.checks.len().max(1), "{}", part.name);
        assert_eq!(suite.failures + suite.errors > 0, part.status != grader::status::Status::Passed, "{}", part.name);
    }
    let hostile = junit::render(&sample::hostile(), true).unwrap();
    assert!(!hostile.contains(|c: char| c.is_control() && c != '\n' || c == '\u{ffff}'));
    quick_junit::Report::deserialize_from_str(&hostile).unwrap();
}

#[test]
fn pages_run_no_text_of_a_submission() {
    let class = sample::class();
    let ordered: Vec<&ClassEntry> = class.iter().collect();
    for page in [html::render(&sample::hostile(), true), class_html::render(&ordered)] {
        assert!(!page.contains("<script"));
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

#[test]
fn the_class_table_has_a_row_per_submission_and_a_mark_for_excel() {
    let folder = tempfile::tempdir().unwrap();
    write_class(&sample::class(), folder.path()).unwrap();
    let text = fs::read_to_string(folder.path().join("grades.csv")).unwrap();
    let mut reader = ::csv::Reader::from_reader(text.strip_prefix('\u{feff}').unwrap().as_bytes());
    assert_eq!(
        reader.headers().unwrap().iter().take(4).collect::<Vec<_>>(),
        ["submission", "student", "score", "max_score"]
    );
    let rows: Vec<::csv::StringRecord> = reader.records().map(Result::unwrap).collect();
    assert_eq!(rows.len(), 30);
    let unsafe_cell = |cell: &str| cell.starts_with(['=', '+', '-', '@', '\t']);
    assert!(!rows.iter().flatten().any(unsafe_cell));
    assert!(rows.iter().any(|row| row[0] == escape::cell(HOSTILE)));
}

#[test]
fn an_empty_class_still_has_its_page() {
    let folder = tempfile::tempdir().unwrap();
    write_class(&[], folder.path()).unwrap();
    assert!(fs::read_to_string(folder.path().join("class.html")).unwrap().contains("No submission"));
}
