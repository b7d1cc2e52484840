//! The path of a student: in every state of the 22 functions, and of both assignments, `check` names the function that a tutor would.

#[path = "../common/mod.rs"]
mod common;
mod student;

use std::cell::RefCell;
use std::collections::{BTreeMap, BTreeSet};
use std::path::Path;
use std::process::Command;
use std::time::Duration;

use common::repository;
use grader::check::{Judge, Judged, Report, View, next, reports, roles};
use grader::status::Status;
use grader::submission::{NAMES, Source, Submission, mentions};
use student::{Broken, Student, place, process_within, right};
use tempfile::TempDir;

fn next_of(reports: &[Report]) -> Option<&'static str> {
    next(reports, None).map(|next| next.name)
}

/// The last lines that `check` prints.
fn end_of(reports: &[Report]) -> String {
    let view = View { hints: 0, colour: false, folder: Path::new("."), only_one: false };
    let text = view.render(reports, None);
    text.lines().rev().take(2).collect()
}

/// The functions whose checks take longest, and those that they or their checks call directly.
const INTEGRATORS: [&str; 2] = ["linearly_implicit_euler", "implicit_euler"];
const NEAR_INTEGRATORS: [&str; 7] = [
    "V_linear_tetrahedron",
    "mass_matrix_mesh",
    "assemble_forces",
    "assemble_stiffness",
    "linearly_implicit_euler",
    "newtons_method",
    "implicit_euler",
];

/// Breaks each function in one way while all others are right, and expects `check` to name it, and to blame no other. The integrators
/// are not written yet while functions far from them are broken.
fn is_blamed_alone(how: impl Fn(usize) -> Broken) {
    let mut student = Student::done();
    INTEGRATORS.iter().for_each(|name| student.break_one(name, Broken::NotWritten));
    let almost_done = student.judged(None);
    assert_eq!(next_of(&student.reports(&almost_done)), Some(INTEGRATORS[0]), "all others are right");
    let of_each = |student: &mut Student, base: &Judged, names: &[&'static str]| {
        for name in names {
            let how = how(place(name));
            student.break_one(name, how);
            let reports = student.reports(&student.judged(Some((base.clone(), name))));
            assert_eq!(next_of(&reports), Some(*name), "{name} is broken: {how:?}");
            let is_waiting = |report: &&Report| {
                report.name != *name && report.status != Status::Passed && student.is_written(report.name)
            };
            for report in reports.iter().filter(is_waiting) {
                let causes: Vec<_> = report.waits_for.iter().map(|cause| cause.name).collect();
                assert_eq!(causes, [*name], "{} fails although {name} alone is broken", report.name);
            }
            student.mend(name);
        }
    };
    let far: Vec<_> = NAMES.into_iter().filter(|name| !NEAR_INTEGRATORS.contains(name)).collect();
    of_each(&mut student, &almost_done, &far);
    let mut done = almost_done;
    for name in INTEGRATORS {
        student.mend(name);
        done = student.judged(Some((done, name)));
    }
    assert_eq!(next_of(&student.reports(&done)), None, "all is right");
    of_each(&mut student, &done, &NEAR_INTEGRATORS);
}

#[test]
fn a_wrong_function_is_next_and_what_needs_it_waits() {
    is_blamed_alone(|_| Broken::Wrong);
}

#[test]
fn a_function_that_is_not_written_does_not_compile_or_is_refused_is_next_and_what_needs_it_waits() {
    is_blamed_alone(|index| [Broken::NotWritten, Broken::DoesNotCompile, Broken::Refused][index % 3]);
}

/// The order in which the functions are written: that of the course, but what a function calls comes right after it.
fn order(asked: &[&'static str]) -> Vec<&'static str> {
    let mut order: Vec<_> = asked.iter().copied().filter(|name| *name != "mass_matrix_linear_tetrahedron").collect();
    let after = order.iter().position(|name| *name == "T_linear_tetrahedron").map(|at| at + 1);
    let at = after.unwrap_or(0);
    if asked.contains(&"mass_matrix_linear_tetrahedron") {
        order.insert(at, "mass_matrix_linear_tetrahedron");
    }
    order
}

/// Writes one asked function after the other, each first wrong if `stumbles`, and expects `check` to lead through them.
fn leads_through(mut student: Student, asked: &[&'static str], stumbles: bool) -> String {
    let mut judged = student.judged(None);
    for name in order(asked) {
        assert_eq!(next_of(&student.reports(&judged)), Some(name), "{name} is not written");
        if stumbles {
            judged = stumbled(&mut student, judged, name);
        }
        student.mend(name);
        judged = student.judged(Some((judged, name)));
    }
    let reports = student.reports(&judged);
    assert_eq!(next_of(&reports), None);
    end_of(&reports)
}

/// Writes a function that is wrong, of which `check` tells, or of what it waits for.
fn stumbled(student: &mut Student, judged: Judged, name: &'static str) -> Judged {
    student.break_one(name, Broken::Wrong);
    let judged = student.judged(Some((judged, name)));
    let reports = student.reports(&judged);
    let own = reports.iter().find(|report| report.name == name).expect("a report");
    match &own.waits_for[..] {
        [] => assert_eq!(next_of(&reports), Some(name), "{name} is wrong"),
        [cause] => assert_eq!(next_of(&reports), Some(cause.name), "{name} waits"),
        more => panic!("{name} waits for {} functions", more.len()),
    }
    judged
}

/// The repository of an assignment as it is handed out.
fn handed_out(rubric: Option<&str>) -> Student {
    let folder = TempDir::new().expect("a folder");
    let mut grader = Command::new(env!("CARGO_BIN_EXE_grader"));
    grader.arg("handout").arg(folder.path());
    if let Some(rubric) = rubric {
        grader.arg("--rubric").arg(repository().join("grader/rubrics").join(rubric));
    }
    let output = grader.output().expect("the grader starts");
    assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
    assert!(output.stderr.is_empty(), "{}", String::from_utf8_lossy(&output.stderr));
    let submission = Submission::read_folder(folder.path()).expect("src");
    let state = |name: &str| if matches!(submission.functions[name], Source::Written(_)) { b'.' } else { b'?' };
    let state = NAMES.map(state).to_vec();
    Student { state, faults: BTreeMap::new(), roles: roles(folder.path(), &submission), submission }
}

#[test]
fn check_leads_through_the_course_and_both_assignments_to_their_ends() {
    let end = leads_through(handed_out(None), &NAMES, true);
    assert!(end.contains("all of them; run the simulation"), "{end}");

    let first = handed_out(Some("first.toml"));
    let (asked, later) = NAMES.split_at(13);
    let end = leads_through(first, asked, false);
    assert!(end.contains("hand in the folder src") && !end.contains("cargo run"), "{end}");

    let end = leads_through(handed_out(Some("second.toml")), later, false);
    assert!(end.contains("all of them; run the simulation"), "{end}");
}

#[test]
fn of_several_broken_functions_those_that_need_another_wait_and_mending_what_is_next_mends_all() {
    let mut student = Student::done();
    let wrong = [
        "dphi_linear_tetrahedron_dX",
        "psi_neo_hookean",
        "V_linear_tetrahedron",
        "mass_matrix_linear_tetrahedron",
        "newtons_method",
    ];
    wrong.iter().for_each(|name| student.break_one(name, Broken::Wrong));
    let mut judged = student.judged(None);
    let mut left = BTreeSet::from(wrong);
    while !left.is_empty() {
        let reports = student.reports(&judged);
        for report in &reports {
            let is_own = report.status != Status::Passed && report.waits_for.is_empty();
            assert!(!is_own || left.contains(report.name), "{} is right", report.name);
        }
        let next = next_of(&reports).expect("functions are wrong");
        assert!(left.remove(next), "{next} is right");
        let called = mentions(&right(next));
        assert!(left.iter().all(|name| !called.contains(name)), "{next} calls a wrong function");
        student.mend(next);
        judged = student.judged(Some((judged, next)));
    }
    assert_eq!(next_of(&student.reports(&judged)), None);
}

#[test]
fn what_calls_a_function_that_never_ends_waits_and_is_not_run() {
    let mut student = Student::done();
    student.state[place("psi_neo_hookean")] = b'l';
    let state = String::from_utf8(student.state.clone()).expect("letters");
    let [subject, trusted] = [(); 2].map(|()| process_within(&state, Duration::from_secs(2)));
    let begun = RefCell::new(BTreeSet::new());
    let begins = |name| {
        begun.borrow_mut().insert(name);
    };
    let (submission, faults) = (&student.submission, &student.faults);
    let judge = Judge { submission, faults, subject: &subject, trusted: &trusted, begins: &begins };
    let found = reports(&judge.one("V_linear_tetrahedron"), &student.roles, Some("V_linear_tetrahedron"));
    assert_eq!(found[0].messages, ["waits for psi_neo_hookean"]);
    assert_eq!(next_of(&found), Some("psi_neo_hookean"));
    assert!(
        begun.borrow().contains("psi_neo_hookean") && !begun.borrow().contains("V_linear_tetrahedron"),
        "{begun:?}"
    );
}
