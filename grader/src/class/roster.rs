//! The students of a class: those without a submission, those unknown, and the submission of a student that counts.

use super::find::Class;
use super::{ClassError, ClassOptions, Entry, Outcome};
use crate::assess::ADJUSTMENTS;

/// Rows for the students of the roster that have handed in nothing, with this score.
pub fn without_a_submission(class: &Class, score: Option<f64>) -> impl Iterator<Item = Entry> {
    let has_one = |student: &str| class.submissions.iter().any(|submission| submission.student == student);
    class.people.iter().filter(move |person| !has_one(&person.student)).map(move |person| Entry {
        submission: String::new(),
        student: person.student.clone(),
        outcome: Outcome::NoSubmission(score),
    })
}

/// Lets the best of a student's graded submissions count, the first of equal ones. The others are marked as superseded by it.
pub fn keep_the_best(entries: &mut [Entry], student: &str) {
    let score = |entry: &Entry| match &entry.outcome {
        Outcome::Graded(grade, _) if entry.student == student => Some(grade.score),
        _ => None,
    };
    let best = (0..entries.len())
        .filter(|&i| score(&entries[i]).is_some())
        .reduce(|best, next| if score(&entries[next]) > score(&entries[best]) { next } else { best });
    let Some(best) = best else { return };
    let name = entries[best].submission.clone();
    for i in (0..entries.len()).filter(|&i| i != best) {
        let leads_to_another = matches!(&entries[i].outcome, Outcome::Older { .. }) && entries[i].student == student;
        if score(&entries[i]).is_some() || leads_to_another {
            entries[i].outcome = Outcome::Older { newer: name.clone() };
        }
    }
}

/// Refuses to regrade unknown students, and remarks on adjustments and extensions for students that are not in the class.
pub fn strangers(options: &ClassOptions, class: &Class) -> Result<Vec<String>, ClassError> {
    let is_there = |name: &&String| {
        !class.submissions.iter().any(|submission| submission.student == **name || submission.name == **name)
    };
    if let Some(name) = options.only.iter().find(is_there) {
        return Err(ClassError::NoSuchSubmission(name.clone()));
    }
    let people = class.people.iter().map(|person| person.student.as_str());
    let students: Vec<&str> =
        people.chain(class.submissions.iter().map(|submission| submission.student.as_str())).collect();
    let adjusted = options.accounts.strangers(&students).into_iter();
    let adjusted = adjusted.map(|name| format!("{}: there is no student {name}", ADJUSTMENTS));
    let rubric = options.accounts.rubric();
    let extended = rubric.extensions.iter().map(|extension| extension.student.get_ref());
    let extended = extended.filter(|name| !students.contains(&name.as_str()));
    let mut remarks: Vec<String> = adjusted
        .chain(extended.map(|name| format!("the rubric has an extension for {name}, who is no student")))
        .collect();
    let late = class.submissions.iter().filter(|submission| submission.is_late && submission.stated_time().is_none());
    let late: Vec<&str> = late.map(|submission| submission.name.as_str()).collect();
    if rubric.deadline.is_some() && !late.is_empty() {
        remarks.push(format!("marked as late, but without a time: {}; give times in students.csv", late.join(", ")));
    }
    let by_file = class.submissions.iter().filter(|submission| submission.stated_time().is_none()).count();
    if rubric.deadline.is_some() && by_file > 0 {
        remarks.push(format!(
            "{by_file} submissions count as handed in when their files were written; give times in students.csv"
        ));
    }
    Ok(remarks)
}
