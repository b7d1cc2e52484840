//! The pictures of `grade --report`.

use super::*;
use crate::grade::Study;
use grader::status::Status;

fn drawn(mut grade: Grade) -> String {
    grade.study = Some(sample::study());
    html::render(&grade, true)
}

#[test]
fn each_function_and_each_run_is_drawn_beside_the_reference() {
    let (grade, page) = (sample::grade(0), drawn(sample::grade(0)));
    let with =
        |wanted: fn(&crate::grade::FunctionGrade) -> bool| view::parts(&grade).filter(|part| wanted(part)).count();
    let (errors, times) = (with(|part| part.error.is_some()), with(|part| view::timed(part).is_some()));
    let dots = |class: &str| page.matches(&format!("<g class=\"{class}\">")).count();
    assert!(errors > 10 && errors < 23, "some functions of the sample have no answer");
    // Of the eight runs, four are hollow; the last two have no answer. The legend shows each of the four curves once more.
    assert_eq!((dots("dot k0"), dots("dot k7")), (errors + times + 2 + 1, times + 4 + 1));
    assert_eq!((dots("dot hollow k0"), dots("dot hollow k7")), (4 + 1, 4 + 1));
    assert!(page.contains("2 of 8 runs of the submission gave no finite positions"));
    assert!(page.contains("submission, linearly implicit euler, time step 0.01 s: 5.0e-2 m, 60.0 ms"));
    assert!(page.contains("<td>implicit euler</td><td class=\"right\">2.5 ms</td><td class=\"right\">–</td>"));
}

#[test]
fn a_time_is_drawn_only_where_the_answers_are_right() {
    let mut grade = sample::grade(0);
    let mut study = sample::study();
    let drawn = |grade: &Grade, study: &Study| {
        let page = html::render(&Grade { study: Some(study.clone()), ..grade.clone() }, true);
        let dots = |class: &str| page.matches(&format!("<g class=\"{class}\">")).count();
        (dots("dot k0"), dots("dot hollow k0"), page.contains("1 of 8 gave other positions"))
    };
    let before = drawn(&grade, &study);
    study.runs[0].is_right = false;
    let quick = grade.functions.iter().position(|f| f.status == Status::Passed && f.seconds.is_some()).unwrap();
    let (all, count) = view::total_seconds(&grade);
    grade.functions[quick].status = Status::Failed;
    // The time of the function; the hollow run.
    assert_eq!(drawn(&grade, &study), (before.0 - 1, before.1 - 1, true));
    let (fewer, less) = view::total_seconds(&grade);
    assert!(less == count - 1 && fewer < all);
    let results: serde_json::Value = serde_json::from_str(&gradescope::render(&grade, true).unwrap()).unwrap();
    let standings = results["leaderboard"].as_array().unwrap();
    assert!(standings.iter().all(|standing| standing["name"] != "Run time (s)"), "{standings:?}");
}

#[test]
fn without_being_asked_for_nothing_is_drawn_and_without_a_run_it_is_said() {
    assert!(!html::render(&sample::grade(0), true).contains("<svg"));
    let mut grade = sample::grade(0);
    grade.study = Some(Study { runs: Vec::new(), ..sample::study() });
    let page = html::render(&grade, true);
    assert!(page.contains("has no runs of the simulation") && page.contains("Run time"));
}

#[test]
fn the_pictures_show_students_no_more_than_the_table_and_run_no_text() {
    for page in [drawn(sample::grade(2)), drawn(sample::hostile())] {
        assert!(!page.contains(sample::SECRET) && !page.contains("<script") && !page.contains("NaN"));
        assert!(!page.contains("inf") && !page.contains("src=") && !page.contains("url("));
    }
}

#[test]
fn a_grade_keeps_its_study_and_one_without_says_nothing_of_it() {
    let grade = Grade { study: Some(sample::study()), ..sample::grade(0) };
    let back: Grade = serde_json::from_str(&json::render(&grade).unwrap()).unwrap();
    let runs = back.study.unwrap().runs;
    assert_eq!((runs.len(), runs[7].submission.is_some(), runs[0].reference.error), (8, false, 0.1));
    assert!(!json::render(&sample::grade(0)).unwrap().contains("study"));
}
