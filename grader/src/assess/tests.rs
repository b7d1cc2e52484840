//! Points, adjustments and lateness of one graded submission.

use std::fs;

use super::adjustments::AdjustmentsError;
use super::*;
use crate::grade::Growth;

const RUBRIC: &str = include_str!("../../rubric.toml");

fn rubric(text: &str) -> Rubric {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("rubric.toml");
    fs::write(&path, text).unwrap();
    Rubric::load(Some(&path)).unwrap_or_else(|error| panic!("{error}"))
}

fn adjustments(rows: &str, rubric: &Rubric) -> Result<Adjustments, AdjustmentsError> {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join(ADJUSTMENTS), rows).unwrap();
    Adjustments::of_class(folder.path(), rubric)
}

fn check(name: &str, status: Status) -> CheckGrade {
    CheckGrade { name: name.to_owned(), status, message: String::new(), counterexample: None }
}

/// Graded with the grader's own rubric: phi is right, psi half, and there is no other.
fn grade() -> Grade {
    let part = |name: &str, status, score, max_score, checks| FunctionGrade {
        name: name.to_owned(),
        score,
        max_score,
        status,
        diagnosis: None,
        location: None,
        message: None,
        hint: None,
        error: None,
        seconds: None,
        reference_seconds: None,
        growth: None,
        checks,
    };
    let half = vec![check(Check::Agrees.name(), Status::Passed), check("is zero at rest", Status::Failed)];
    let text = r#"{"format_version": 1, "submission": "anna", "files": "", "score": 6.0, "max_score": 8.0, "seed": 1, "toolchain": "",
        "sandbox": {}, "remarks": [], "functions": [], "seconds": 1.0, "simulation": {"name": "simulation", "score": 0.0, "max_score": 0.0,
        "status": "missing", "diagnosis": null, "message": null, "hint": null, "error": null, "seconds": null,
        "reference_seconds": null, "checks": []}}"#;
    let mut grade: Grade = serde_json::from_str(text).unwrap();
    grade.functions.push(part("phi_linear_tetrahedron", Status::Passed, 4.0, 4.0, Vec::new()));
    grade.functions.push(part("psi_neo_hookean", Status::Failed, 2.0, 4.0, half));
    grade
}

fn accounts(more: &str, rows: &str) -> Accounts {
    let rubric = rubric(&format!("{RUBRIC}{more}"));
    let adjustments = adjustments(rows, &rubric).unwrap();
    Accounts::new(rubric, adjustments)
}

const DEADLINE: &str = "\n[deadline]\nat = 2026-05-04T12:00:00Z\npenalty_per_day = 0.25\n";

#[test]
fn the_points_of_a_rubric_apply_to_a_submission_that_is_graded_already() {
    let same = accounts("", "student\n").assess(grade(), &["anna"], None);
    assert_eq!((same.score, same.max_score), (6.0, 8.0));
    assert!(same.functions[1].hint.is_some() && same.functions[0].hint.is_none() && same.remarks.is_empty());
    let doubled = RUBRIC.replacen("points = 4.0", "points = 10.0", 1).replacen(
        "partial_credit = true",
        "partial_credit = false",
        1,
    );
    let changed = Accounts::new(rubric(&doubled), Adjustments::default()).assess(grade(), &["anna"], None);
    assert_eq!((changed.score, changed.max_score), (10.0, 14.0));
    assert_eq!((changed.functions[0].score, changed.functions[1].score), (10.0, 0.0));
}

#[test]
fn a_growth_that_costs_points_costs_them_again_when_they_are_counted_again() {
    let mut fast = grade();
    fast.functions[0].growth = Some(Growth { exponent: 2.0, reference_exponent: Some(1.0), elements: 24_576 });
    assert_eq!(accounts("", "student\n").assess(fast.clone(), &["anna"], None).score, 6.0);
    let strict = RUBRIC.replacen("growth_costs = 0.0", "growth_costs = 0.25", 1);
    let strict = Accounts::new(rubric(&strict), Adjustments::default());
    assert_eq!(strict.assess(fast, &["anna"], None).score, 5.0);
    assert_eq!(strict.assess(grade(), &["anna"], None).score, 6.0);
}

#[test]
fn a_late_submission_shows_its_score_before_and_after_the_penalty() {
    let late = accounts(DEADLINE, "student\n");
    let at = |time: &str| late.assess(grade(), &["anna"], Some(time.parse().unwrap()));
    assert_eq!(at("2026-05-04T12:00:00Z").score, 6.0);
    let second_day = at("2026-05-05T13:00:00Z");
    assert_eq!(second_day.score, 3.0);
    let account = second_day.account.unwrap();
    assert_eq!((account.raw_score, account.late.unwrap().days), (6.0, 2));
    assert_eq!(second_day.remarks, ["2 days late: 6 points, less 50 %, are 3"]);
    assert_eq!(at("2026-06-05T13:00:00Z").score, 0.0);
}

#[test]
fn points_by_hand_of_a_function_come_before_the_penalty_and_those_of_the_whole_after_it() {
    let rows =
        "student,function,points,reason,comment\nanna,psi_neo_hookean,4,the page was wrong,Well done\nbob,,7,ill,\n";
    let accounts = accounts(DEADLINE, rows);
    let late = "2026-05-04T13:00:00Z".parse().unwrap();
    let anna = accounts.assess(grade(), &["anna"], Some(late));
    assert_eq!((anna.score, anna.functions[1].score, anna.account.unwrap().raw_score), (6.0, 4.0, 6.0));
    let told = ["psi_neo_hookean: 4 points, given by hand", "1 day late: 8 points, less 25 %, are 6", "Well done"];
    assert_eq!(anna.remarks, told);
    let bob = accounts.assess(grade(), &["bob"], Some(late));
    assert_eq!((bob.score, bob.account.unwrap().adjustments[0].reason.as_deref()), (7.0, Some("ill")));
    assert_eq!(accounts.strangers(&["anna", "carl"]), ["bob"]);
}

#[test]
fn a_row_that_cannot_be_used_is_named_with_its_line() {
    let rubric = rubric(RUBRIC);
    for (row, word) in [
        ("anna,psi,1,x,", "line 2: the rubric asks for no function `psi`"),
        ("anna,psi_neo_hookean,5,x,", "points = 5; give a number from 0 to 4"),
        ("anna,psi_neo_hookean,nan,x,", "from 0 to 4"),
        ("anna,psi_neo_hookean,1,,", "need a reason"),
        ("anna,psi_neo_hookean,many,x,", "`many` is no number"),
        ("anna,,,x,", "neither points nor a comment"),
        (",,1,x,", "name one"),
    ] {
        let problem = adjustments(&format!("student,function,points,reason,comment\n{row}\n"), &rubric).unwrap_err();
        assert!(problem.to_string().contains(word), "{problem}");
    }
    assert!(adjustments("student,point\nanna,1\n", &rubric).unwrap_err().to_string().contains("its columns are"));
}

#[test]
fn a_check_with_points_of_its_own_earns_or_costs_these_alone() {
    let all = |agrees, own| {
        [check(Check::Agrees.name(), agrees), check("is zero at rest", Status::Passed), check("own", own)]
    };
    let worth = |own| Worth { max_score: 6.0, partial_credit: true, edge_cases: 0.2, own };
    let of = |status, checks: &[CheckGrade]| points("psi_neo_hookean", &worth(vec![("own", 2.0)]), (status, checks));
    assert_eq!(of(Status::Passed, &all(Status::Passed, Status::Passed)), 6.0);
    assert_eq!(of(Status::Failed, &all(Status::Passed, Status::Failed)), 4.0);
    assert_eq!(of(Status::Failed, &all(Status::Failed, Status::Passed)), 2.0);
    assert_eq!(of(Status::Missing, &[]), 0.0);
    let share =
        [check(Check::Agrees.name(), Status::Passed), check("other", Status::Failed), check("own", Status::Passed)];
    assert_eq!(of(Status::Failed, &share), 2.0 + 2.0);
    let shared = points("psi_neo_hookean", &worth(Vec::new()), (Status::Failed, &share));
    assert_eq!(shared, 4.0, "it counts like any other check");
}

#[test]
fn the_points_of_a_check_are_added_to_those_of_its_function() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("own.rs"), "").unwrap();
    let load = |points: &str| {
        let own = format!("\n[[check]]\nfunction = \"psi_neo_hookean\"\nname = \"own\"\nfile = \"own.rs\"\n{points}");
        let path = folder.path().join("rubric.toml");
        fs::write(&path, format!("{RUBRIC}{own}")).unwrap();
        Rubric::load(Some(&path))
    };
    let (without, with) = (load("").unwrap(), load("points = 2.5").unwrap());
    assert_eq!(with.max_score() - without.max_score(), 2.5);
    assert_eq!(with.own_points("psi_neo_hookean"), [("own", 2.5)]);
    assert_eq!(with.judging(), without.judging(), "no new grading");
    let refused = load("points = -1.0").unwrap_err().to_string();
    assert!(refused.contains("own.rs") && refused.contains("from 0 to"), "{refused}");
}
