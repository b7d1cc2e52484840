//! `students.csv`: students and times of the submissions, and the roster.
//!
//! Columns: `student`; `submission`, its file name with or without the ending, empty for a student who has handed in nothing; `time`; and
//! for gradebooks `name`, `id`, `login`, `email`, `section`. All but `student` may be left out. A group has a row for each student, with one
//! submission.

use std::path::Path;

use jiff::Timestamp;
use jiff::fmt::strtime;
use serde::Deserialize;

use super::{ClassError, Person, Submission};

pub const STUDENTS: &str = "students.csv";

/// Times with an offset as gradebooks write them, beside RFC 3339.
const FORMATS: [&str; 4] =
    ["%Y-%m-%d %H:%M:%S %z", "%Y-%m-%d %H:%M %z", "%Y-%m-%d %H:%M:%S%.f %z", "%a, %d %b %Y %H:%M:%S %z"];

/// A time of submission: a moment, a number, or another text that sorts by time such as `2026-05-01`.
#[derive(Clone, Debug, PartialEq, PartialOrd)]
pub enum Time {
    Number(f64),
    Text(String),
    Moment(Timestamp),
}

#[derive(Deserialize)]
struct Row {
    #[serde(default)]
    submission: String,
    student: String,
    time: Option<String>,
    #[serde(default)]
    name: String,
    #[serde(default)]
    id: String,
    #[serde(default)]
    login: String,
    #[serde(default)]
    email: String,
    #[serde(default)]
    section: String,
}

/// Assigns the students of the table to the submissions, and returns the students. `given` holds the pairs of submission and student.
pub fn apply(
    path: &Path,
    submissions: &mut Vec<Submission>,
    given: &mut Vec<(String, String)>,
    remarks: &mut Vec<String>,
) -> Result<Vec<Person>, ClassError> {
    let unreadable =
        |error: csv::Error| ClassError::Unreadable { path: path.to_path_buf(), message: error.to_string() };
    let mut reader = csv::ReaderBuilder::new().trim(csv::Trim::All).from_path(path).map_err(unreadable)?;
    let mut people: Vec<Person> = Vec::new();
    for row in reader.deserialize() {
        let row: Row = row.map_err(unreadable)?;
        if row.student.is_empty() {
            remarks.push(format!("{STUDENTS}: {} has no student", row.submission));
            continue;
        }
        match people.iter_mut().find(|person| person.student == row.student) {
            Some(person) => person.complete(row.person()),
            None => people.push(row.person()),
        }
        if !row.submission.is_empty() && !row.assign(submissions, given) {
            remarks.push(format!("{STUDENTS}: there is no submission {}", row.submission));
        }
    }
    Ok(people)
}

impl Row {
    /// Assigns the submission of this row to its student, beside those of earlier rows. Returns false if there is no such submission.
    fn assign(&self, submissions: &mut Vec<Submission>, given: &mut Vec<(String, String)>) -> bool {
        let is_it = |submission: &&mut Submission| {
            submission.name == self.submission
                || submission.path.file_name().is_some_and(|name| *name == *self.submission)
        };
        let Some(submission) = submissions.iter_mut().find(is_it) else { return false };
        let time = self.time.clone().filter(|time| !time.is_empty()).map(Time::read);
        let pair = (submission.name.clone(), self.student.clone());
        let is_first = given.iter().all(|(name, _)| *name != pair.0);
        if is_first {
            submission.student = self.student.clone();
            submission.time = time.or(submission.time.take());
        } else if !given.contains(&pair) {
            let own = Submission { student: self.student.clone(), ..submission.clone() };
            submissions.push(Submission { time: time.or(own.time.clone()), ..own });
        }
        given.push(pair);
        true
    }

    fn person(&self) -> Person {
        Person {
            student: self.student.clone(),
            name: self.name.clone(),
            id: self.id.clone(),
            login: self.login.clone(),
            email: self.email.clone(),
            section: self.section.clone(),
            canvas: String::new(),
        }
    }
}

impl Time {
    /// Reads a cell of the table.
    pub fn read(text: String) -> Self {
        if let Ok(number) = text.parse() {
            return Self::Number(number);
        }
        let moment = text.parse().ok().or_else(|| {
            let parsed = FORMATS.iter().find_map(|format| strtime::parse(format, &text).ok()?.to_timestamp().ok());
            // `2026-05-04 21:59:00 UTC`, `2026-05-04 21:59:00.262843000 Z`, `… +02:00`
            parsed.or_else(|| text.replacen(" UTC", "Z", 1).replacen(' ', "T", 1).replacen(' ', "", 1).parse().ok())
        });
        moment.map_or(Self::Text(text), Self::Moment)
    }

    /// The time at the end of a name: RFC 3339, with or without its colons and dashes, or with dashes in place of the colons.
    pub fn in_name(text: &str) -> Option<Self> {
        let (date, clock) = text.split_once(['T', 't'])?;
        let colons = clock.replacen('-', ":", 2);
        let moment = [text.to_owned(), format!("{date}T{colons}")].iter().find_map(|text| text.parse().ok());
        moment.map(Self::Moment)
    }

    /// The moment, if it is one.
    pub fn moment(&self) -> Option<Timestamp> {
        if let Self::Moment(moment) = self { Some(*moment) } else { None }
    }
}

#[cfg(test)]
mod tests {
    use super::Time;

    #[test]
    fn times_are_read_as_platforms_and_names_write_them() {
        let read = |text: &str| Time::read(text.to_owned()).moment().map(|moment| moment.to_string());
        let evening = Some("2026-05-04T21:59:00Z".to_owned());
        for text in [
            "2026-05-04T23:59:00+02:00",
            "2026-05-04 23:59:00 +0200",
            "2026-05-04 21:59:00 UTC",
            "2026-05-04 21:59:00.000000000 Z",
            "2026-05-04 23:59:00.000000000 +02:00",
            "2026-05-04 23:59 +0200",
            "Mon, 04 May 2026 23:59:00 +0200",
        ] {
            assert_eq!(read(text), evening, "{text}");
        }
        for text in ["2026-05-04", "10", "2026-05-04T23:59:00", "soon"] {
            assert_eq!(read(text), None, "{text}");
        }
        for name in ["2026-05-04T21:59:00Z", "20260504T215900Z", "2026-05-04T21-59-00Z", "2026-05-04T23-59-00+02:00"] {
            assert_eq!(Time::in_name(name).and_then(|time| time.moment()).map(|at| at.to_string()), evening, "{name}");
        }
        assert!(["hw1", "Test", "2"].iter().all(|name| Time::in_name(name).is_none()));
    }
}
