//! Whose the submissions are by the rosters of platforms.

use super::names::{Author, repeated};
use super::rosters::Listed;
use super::{Person, Submission};

/// Assigns submissions to the students of rosters, and returns these. A submission without one keeps its own name and is remarked on.
pub fn assign(students: &[Listed], submissions: &mut Vec<Submission>, remarks: &mut Vec<String>) -> Vec<Person> {
    let mut further = Vec::new();
    for submission in submissions.iter_mut() {
        let mut owners = owners(students, submission).into_iter();
        let Some(first) = owners.next() else {
            remarks.push(unlisted(submission, "the roster"));
            continue;
        };
        remarks.extend(another_name(submission, first));
        let original = submission.clone();
        for owner in owners {
            further.push(owned(original.clone(), owner));
        }
        *submission = owned(original, first);
    }
    submissions.extend(further);
    let mut people: Vec<Person> = Vec::new();
    for listed in students {
        if !people.iter().any(|person| person.student == listed.person.student) {
            people.push(listed.person.clone());
        }
    }
    people
}

fn owned(submission: Submission, owner: &Listed) -> Submission {
    Submission {
        student: owner.person.student.clone(),
        time: owner.time.clone().or(submission.time.clone()),
        is_late: submission.is_late || owner.is_late,
        ..submission
    }
}

/// The students of a submission: several if it is a group's.
fn owners<'a>(students: &'a [Listed], submission: &Submission) -> Vec<&'a Listed> {
    let all = |is_it: &dyn Fn(&Listed) -> bool| students.iter().filter(|listed| is_it(listed)).collect::<Vec<_>>();
    match &submission.author {
        Author::Canvas { user, .. } => all(&|listed| listed.person.canvas == *user),
        Author::Gradescope(folder) => all(&|listed| listed.submission == *folder),
        Author::Moodle { name, number } => {
            // Of a group the number is the group's, which may be that of another participant.
            let is_named = |listed: &Listed| letters(&listed.person.name) == letters(name);
            let is_blind = |listed: &Listed| listed.person.name.is_empty();
            // Of one group of a course Moodle before 4.1 wrote `GROUP-Full Name` (`mod/assign/locallib.php`).
            let ends_so = |listed: &Listed| letters(name).ends_with(&letters(&listed.person.name));
            let by_number = all(&|listed| listed.participant == *number && (ends_so(listed) || is_blind(listed)));
            let by_group = all(&|listed| listed.groups.iter().any(|group| letters(group) == letters(name)));
            let by_name = all(&|listed| is_named(listed) && (listed.participant.is_empty() || number.is_empty()));
            let found = [by_number, by_group, by_name];
            let is_clear =
                |(kind, found): &(usize, Vec<&Listed>)| !found.is_empty() && (*kind == 1 || found.len() == 1);
            found.into_iter().enumerate().find(is_clear).map_or(Vec::new(), |(_, found)| found)
        }
        Author::Own(name) => {
            let labels = |listed: &Listed| {
                let Person { student, login, email, id, name, .. } = &listed.person;
                [student, login, email, id, name].map(String::clone)
            };
            let found = all(&|listed| labels(listed).contains(name));
            let found = if found.is_empty() {
                all(&|listed| labels(listed).iter().any(|label| label == repeated(name).0))
            } else {
                found
            };
            // Two students of one name are told apart by nothing else.
            if found.iter().all(|listed| listed.person.student == found[0].person.student) { found } else { Vec::new() }
        }
    }
}

/// A name without blanks, marks and capitals, which platforms change in names of files.
fn letters(name: &str) -> String {
    name.chars().filter(|c| c.is_alphanumeric()).flat_map(char::to_lowercase).collect()
}

/// A remark on a submission with another name than its student's: a group's of Canvas, or `anna-1` for `anna`.
fn another_name(submission: &Submission, owner: &Listed) -> Option<String> {
    let sorted = |name: &str| {
        let mut letters: Vec<char> = letters(name).chars().collect();
        letters.sort_unstable();
        letters
    };
    let Person { student, login, email, id, name: full, .. } = &owner.person;
    match &submission.author {
        Author::Canvas { name, .. } if !name.is_empty() && sorted(name) != sorted(full) => Some(format!(
            "{}: counts for {student} alone, whose number it has; if it is a group's, students.csv must name the others",
            submission.name
        )),
        Author::Own(name) if ![student, login, email, id, full].contains(&name) => Some(further(submission, student)),
        _ => None,
    }
}

/// A remark on a submission that counts as a further attempt by its name alone.
pub fn further(submission: &Submission, student: &str) -> String {
    format!(
        "{}: counts as a further attempt of {student}; if it is another student's, the table must say so",
        submission.name
    )
}

/// A remark on a submission that counts for nobody whom the table names.
pub fn unlisted(submission: &Submission, table: &str) -> String {
    format!(
        "{}: {table} does not list it; it counts as the submission of another student, {}",
        submission.name, submission.student
    )
}
