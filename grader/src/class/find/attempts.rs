//! Several submissions of one student: which belong together, and which of them counts.

use std::cmp::Ordering;
use std::collections::{BTreeSet, HashMap};

use super::names::repeated;
use super::owners::{further, unlisted};
use super::{Person, Submission};

/// Gives the further attempts of a listed author, such as `anna (1)` or `anna-1` beside `anna`, to the students of the listed
/// submission, and remarks on all others that `students.csv` does not list.
pub fn join(
    given: &[(String, String)],
    people: &[Person],
    submissions: &mut Vec<Submission>,
    remarks: &mut Vec<String>,
) {
    let is_given = |submission: &Submission| given.iter().any(|(name, _)| *name == submission.name);
    let (mut listed, others): (Vec<_>, Vec<_>) = submissions.drain(..).partition(is_given);
    for submission in others {
        let author = submission.author.student();
        let known = |name: &str| people.iter().any(|person| person.student == name);
        if known(&author) {
            listed.push(submission);
            continue;
        }
        let students = |of: &str| -> BTreeSet<String> {
            let of_author = listed.iter().filter(|listed| listed.author.student() == of);
            let itself = known(of).then(|| of.to_owned());
            of_author.map(|listed| listed.student.clone()).chain(itself).collect()
        };
        let (first, number) = repeated(&author);
        let (students, attempt) = match students(&author) {
            own if own.is_empty() => (students(first), number),
            own => (own, submission.attempt),
        };
        if students.is_empty() {
            remarks.push(unlisted(&submission, "students.csv"));
            listed.push(submission);
            continue;
        }
        if attempt != submission.attempt {
            remarks.push(further(&submission, first));
        }
        listed.extend(students.into_iter().map(|student| Submission { student, attempt, ..submission.clone() }));
    }
    *submissions = listed;
}

/// Marks all but the newest submission of each student.
pub fn mark_older(submissions: &mut [Submission]) {
    let mut newest: HashMap<String, usize> = HashMap::new();
    for (i, submission) in submissions.iter().enumerate() {
        let best = newest.entry(submission.student.clone()).or_insert(i);
        if is_newer(submission, &submissions[*best]) {
            *best = i;
        }
    }
    for i in 0..submissions.len() {
        if let Some(&best) = newest.get(&submissions[i].student)
            && best != i
        {
            submissions[i].newer = Some(submissions[best].name.clone());
        }
    }
}

/// Compares times where both have one, then the numbers of attempts, and only then what is less certain.
fn is_newer(one: &Submission, other: &Submission) -> bool {
    let by_time = match (&one.time, &other.time) {
        (Some(one), Some(other)) => one.partial_cmp(other).unwrap_or(Ordering::Equal),
        _ => Ordering::Equal,
    };
    let by_attempt = by_time.then(one.attempt.cmp(&other.attempt));
    let by_files =
        by_attempt.then(one.time.is_some().cmp(&other.time.is_some())).then(one.modified.cmp(&other.modified));
    by_files.then(one.name.cmp(&other.name)).is_gt()
}
