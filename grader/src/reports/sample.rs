//! Grades for the tests: an ordinary one, and one whose every text attacks the reports.

use std::collections::BTreeMap;
use std::path::PathBuf;

use grader::status::Status;
use grader::submission::NAMES;

use crate::class::{Entry, Identity, Outcome, Summary};
use crate::grade::{CheckGrade, FORMAT_VERSION, FunctionGrade, Grade, Growth, Outcome as Ended, Run, Study};

/// Text that only the instructor may read, and that must not be in a student's file.
pub const SECRET: &str = "SECRET-INPUT-0.4711";

/// Text with markup of every format.
pub const HOSTILE: &str = "=cmd|'/C calc'!A0 </title><script>alert(1)</script> ``` `x` | ]]> \
    \u{1b}[2J\u{1b}]0;owned\u{7}\u{0}\u{8}\u{ffff}\u{202e} \"q\" & 'a' [l](http://x)";

/// A submission whose functions fare differently, by `variant`.
pub fn grade(variant: usize) -> Grade {
    let functions: Vec<FunctionGrade> = (0..NAMES.len()).map(|i| function(i, variant)).collect();
    let score = functions.iter().map(|f| f.score).sum();
    Grade {
        format_version: FORMAT_VERSION,
        submission: format!("submission-{variant:02}"),
        files: "0123abcd".to_owned(),
        score,
        max_score: 100.0,
        seed: u64::MAX,
        toolchain: "rustc 1.89.0".to_owned(),
        sandbox: BTreeMap::from([("namespaces".to_owned(), true), ("landlock".to_owned(), false)]),
        remarks: if variant % 5 == 1 { vec!["README.txt was left aside".to_owned()] } else { Vec::new() },
        functions,
        simulation: FunctionGrade { name: "simulation".to_owned(), max_score: 12.0, score: 0.0, ..function(3, 0) },
        account: None,
        pages: None,
        study: None,
        seconds: 12.345678,
    }
}

fn function(i: usize, variant: usize) -> FunctionGrade {
    let status = match (i * 7 + variant * 5 + i * variant) % 17 {
        1 | 9 => Status::Failed,
        4 => Status::DidNotCompile,
        6 if variant.is_multiple_of(3) => Status::TimedOut,
        8 if variant.is_multiple_of(4) => Status::Missing,
        11 if variant.is_multiple_of(5) => Status::Crashed,
        13 if variant.is_multiple_of(6) => Status::Refused,
        _ => Status::Passed,
    };
    let answers = matches!(status, Status::Passed | Status::Failed);
    let failed = status == Status::Failed;
    let spread = ((i * 13 + variant * 29) % 10) as f64;
    FunctionGrade {
        name: NAMES[i].to_owned(),
        score: if status == Status::Passed {
            4.0
        } else if failed {
            1.5
        } else {
            0.0
        },
        max_score: 4.0,
        status,
        location: failed.then(|| "Right: the diagonal; wrong entries are elsewhere.".to_owned()),
        diagnosis: failed.then(|| ["negated", "scaled by 0.5", "transposed"][(i + variant) % 3].to_owned()),
        message: message(status),
        hint: (status != Status::Passed).then(|| "compare with a finite difference of the energy".to_owned()),
        error: answers.then(|| if failed { 10_f64.powf(-spread) } else { 1e-15 * (1.0 + spread) }),
        seconds: answers.then(|| 1e-6 * (1.0 + spread) * 10_f64.powi((i % 4) as i32)),
        reference_seconds: Some(2e-6 * 10_f64.powi((i % 4) as i32)),
        growth: (i == 1).then_some(Growth { exponent: 1.97, reference_exponent: Some(1.02), elements: 24_576 }),
        checks: if answers { checks(status) } else { Vec::new() },
    }
}

fn message(status: Status) -> Option<String> {
    match status {
        Status::Failed => Some("Every entry has the opposite sign.".to_owned()),
        Status::DidNotCompile => Some(
            "error[E0308]: mismatched types\n --> src/x.rs:12:5\n   |\n\
             12 |     0\n   |     ^ expected `f64`, found integer"
                .to_owned(),
        ),
        Status::Refused => Some("line 3: `unsafe` is not allowed".to_owned()),
        Status::Crashed => Some("The function panicked: index out of bounds.".to_owned()),
        Status::TimedOut => Some("No answer within 10 seconds.".to_owned()),
        _ => None,
    }
}

fn checks(status: Status) -> Vec<CheckGrade> {
    let check = |name: &str, status, message: &str| CheckGrade {
        name: name.to_owned(),
        status,
        message: message.to_owned(),
        counterexample: Some(SECRET.to_owned()),
    };
    vec![
        check("is_zero_at_rest", Status::Passed, ""),
        check("does_not_change_under_rotation", Status::Passed, ""),
        check("equals_the_reference", status, "the answer differs from the energy's finite difference"),
    ]
}

/// A study in which the submission errs like the reference, is slower, and stops answering.
pub fn study() -> Study {
    let run = |integrator: &str, k: i32, answers: bool| {
        let outcome = |slower: f64| Ended { error: 0.1 * 0.5_f64.powi(k), seconds: 0.01 * slower * 2_f64.powi(k) };
        let submission = answers.then(|| outcome(3.0));
        let (dt, reference) = (0.02 * 0.5_f64.powi(k), outcome(1.0));
        Run { integrator: integrator.to_owned(), dt, submission, reference, is_right: true }
    };
    let runs = (0..8).map(|i| run(["linearly_implicit_euler", "implicit_euler"][i / 4], i as i32 % 4, i < 6));
    Study { runs: runs.collect(), uncertainty: 3e-9 }
}

/// A submission whose every text is [`HOSTILE`] and whose figures are no numbers.
pub fn hostile() -> Grade {
    let mut grade = grade(1);
    grade.submission = HOSTILE.to_owned();
    grade.remarks = vec![HOSTILE.to_owned()];
    grade.seconds = 0.0;
    for function in &mut grade.functions {
        function.diagnosis = Some(HOSTILE.to_owned());
        function.message = Some(format!("{HOSTILE}\n{HOSTILE}"));
        function.error = Some(f64::NAN);
        function.seconds = Some(f64::INFINITY);
        for check in &mut function.checks {
            check.status = Status::Failed;
            check.message = HOSTILE.to_owned();
        }
    }
    grade
}

/// A class of 33: 29 ordinary grades, a hostile one, three without a grade; besides, an older submission.
pub fn class() -> Summary {
    let entry = |submission: &str, student: &str, outcome| Entry {
        submission: submission.to_owned(),
        student: student.to_owned(),
        outcome,
    };
    let graded = |grade: Grade| Outcome::Graded(Box::new(grade), PathBuf::from("grades/key"));
    let mut entries: Vec<Entry> =
        (0..29).map(|i| entry(&format!("submission-{i:02}"), &format!("Ünal {i:02}"), graded(grade(i)))).collect();
    entries.push(entry(HOSTILE, HOSTILE, graded(hostile())));
    entries.push(entry("late", "+late", Outcome::Waiting));
    entries.push(entry("lost", "@lost", Outcome::NotGraded("no end within 600 s; see failed/lost.log".to_owned())));
    entries.push(entry("-odd", "\t=odd", Outcome::NotGraded(HOSTILE.to_owned())));
    entries.push(entry("first", "Ünal 03", Outcome::Older { newer: "submission-03".to_owned() }));
    Summary { entries, ..empty_class() }
}

/// A class without submissions.
pub fn empty_class() -> Summary {
    Summary {
        identity: Identity {
            grader: String::new(),
            toolchain: String::new(),
            seed: 1,
            rubric: None,
            extra: Vec::new(),
        },
        shard: None,
        entries: Vec::new(),
        people: Vec::new(),
        title: "Homework".to_owned(),
        max_score: 100.0,
        release: None,
        changes: Vec::new(),
        remarks: Vec::new(),
        graded_now: 0,
        kept: 0,
        interrupted: false,
    }
}
