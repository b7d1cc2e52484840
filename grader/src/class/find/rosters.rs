//! Rosters and worksheets of platforms, as they come, among the submissions. They are known by their headings:
//!
//! | file | headings |
//! |---|---|
//! | Canvas, gradebook | `Student` (or `LastName,FirstName`), `ID`, `SIS User ID`, `SIS Login ID`, `Section`, assignments (`lib/gradebook_exporter.rb` of Canvas) |
//! | Moodle, grading worksheet | `Identifier`, `Full name`, `ID number`, `Email address`, `Status`, `Group`, … (`mod/assign/gradingtable.php` of Moodle) |
//! | Moodle, participants | `First name`, `Last name`, `Email address`, `Groups` |
//! | Gradescope, roster or grades | `First Name`, `Last Name`, `SID`, `Email`, `Role` or `Sections`, and for one assignment `Submission ID`, `Submission Time` |

use std::path::Path;

use super::students::Time;
use super::{ClassError, Person};

/// A student of a roster, with what leads from a submission to it.
#[derive(Clone, Default)]
pub struct Listed {
    /// The student; `student` is empty until all rosters are read.
    pub person: Person,
    /// Moodle's number of the participant.
    pub participant: String,
    /// Groups, whose submissions Moodle names after them.
    pub groups: Vec<String>,
    /// The name of the student's submission.
    pub submission: String,
    pub time: Option<Time>,
    pub is_late: bool,
}

/// The columns of a roster by their meaning: the first heading that the file has.
struct Columns(Vec<String>);

impl Columns {
    fn new(headings: &csv::StringRecord) -> Self {
        Self(headings.iter().map(|heading| heading.trim_start_matches('\u{feff}').trim().to_lowercase()).collect())
    }

    fn has(&self, heading: &str) -> bool {
        self.0.iter().any(|own| own == heading)
    }

    fn cell(&self, row: &csv::StringRecord, headings: &[&str]) -> String {
        let place = headings.iter().find_map(|heading| self.0.iter().position(|own| own == heading));
        place.and_then(|place| row.get(place)).map_or_else(String::new, |cell| cell.trim().to_owned())
    }

    /// Returns true if the headings are those of a roster.
    fn are_known(&self) -> bool {
        let has_name = self.has("first name") && (self.has("last name") || self.has("surname"));
        let canvas = (self.has("student") || self.has("lastname")) && self.has("id") && self.has("section");
        let worksheet = self.has("identifier") && (self.has("status") || self.has("full name"));
        canvas || worksheet || has_name && (self.has("email address") || self.has("sid"))
    }
}

/// The students of a file; `None` if it is no roster.
pub fn read(path: &Path) -> Result<Option<Vec<Listed>>, ClassError> {
    let unreadable =
        |error: csv::Error| ClassError::Unreadable { path: path.to_path_buf(), message: error.to_string() };
    let mut reader = csv::ReaderBuilder::new().flexible(true).from_path(path).map_err(unreadable)?;
    let Ok(headings) = reader.headers() else { return Ok(None) };
    let columns = Columns::new(headings);
    if !columns.are_known() {
        return Ok(None);
    }
    let mut listed = Vec::new();
    for row in reader.records() {
        listed.extend(student(&columns, &row.map_err(unreadable)?));
    }
    Ok(Some(listed))
}

/// The student of a row; `None` for rows of points, for staff and for Canvas' test student.
fn student(columns: &Columns, row: &csv::StringRecord) -> Option<Listed> {
    let cell = |headings: &[&str]| columns.cell(row, headings);
    let canvas = if columns.has("section") && !columns.has("sid") { cell(&["id"]) } else { String::new() };
    let is_of_canvas = columns.has("student") || columns.has("lastname");
    let first_and_last = [cell(&["first name", "firstname"]), cell(&["last name", "surname", "lastname"])].join(" ");
    let name = Some(cell(&["student", "full name"])).filter(|name| !name.is_empty());
    let name = name.unwrap_or_else(|| first_and_last.trim().to_owned());
    let role = cell(&["role", "roles"]).to_lowercase();
    let is_staff = !role.is_empty() && !role.contains("student");
    let is_test = name == "Student, Test" || name.trim() == "Test Student";
    if is_of_canvas && (canvas.is_empty() || is_test) || is_staff {
        return None;
    }
    let participant = cell(&["identifier"]).chars().filter(char::is_ascii_digit).collect();
    let groups = cell(&["group", "groups"]);
    let number = cell(&["submission id"]);
    let time = cell(&["submission time"]);
    let person = Person {
        student: String::new(),
        name,
        id: cell(&["sis user id", "sid", "id number"]),
        login: cell(&["sis login id", "username"]),
        email: cell(&["email address", "email"]),
        section: cell(&["section", "sections"]),
        canvas,
    };
    Some(Listed {
        person,
        participant,
        groups: groups.split(',').map(|group| group.trim().to_owned()).filter(|group| !group.is_empty()).collect(),
        submission: if number.is_empty() { number } else { format!("submission_{number}") },
        time: (!time.is_empty()).then(|| Time::read(time)),
        // “Submitted for grading - 3 mins 31 secs late - …”
        is_late: cell(&["status"]).to_lowercase().contains(" late"),
    })
}

/// Joins the rows of several files about one student, and names each student: by login, else address, number, name, whichever is the
/// first that no other student has.
pub fn joined(mut rows: Vec<Listed>) -> Vec<Listed> {
    rows.retain(|row| {
        let Person { name, id, login, email, canvas, .. } = &row.person;
        [name, id, login, email, canvas, &row.participant].iter().any(|text| !text.is_empty())
    });
    let mut students: Vec<Listed> = Vec::new();
    for row in rows {
        let is_one = |a: &str, b: &str| !a.is_empty() && a.eq_ignore_ascii_case(b);
        let is_same = |other: &&mut Listed| {
            let (a, b) = (&other.person, &row.person);
            let ids = [(&a.email, &b.email), (&a.id, &b.id), (&a.login, &b.login), (&a.canvas, &b.canvas)];
            ids.iter().any(|(a, b)| is_one(a, b)) || is_one(&other.participant, &row.participant)
        };
        let is_other_submission = |other: &&mut Listed| {
            !row.submission.is_empty() && !other.submission.is_empty() && row.submission != other.submission
        };
        match students.iter_mut().find(|other| is_same(other) && !is_other_submission(other)) {
            Some(student) => student.complete(row),
            None => students.push(row),
        }
    }
    name_all(&mut students);
    students
}

fn name_all(students: &mut [Listed]) {
    let labels = |person: &Person| [&person.login, &person.email, &person.id, &person.name].map(Clone::clone);
    let all: Vec<[String; 4]> = students.iter().map(|listed| labels(&listed.person)).collect();
    let identity = |i: usize| (&all[i][1], &all[i][2], &all[i][3]);
    for (index, listed) in students.iter_mut().enumerate() {
        let is_free = |kind: usize, label: &String| {
            let has_it = |other: usize| all[other][kind] == *label && identity(other) != identity(index);
            !label.is_empty() && !(0..all.len()).any(has_it)
        };
        let found = all[index].iter().enumerate().find(|(kind, label)| is_free(*kind, label));
        let numbered = || format!("{} {}{}", all[index][3], listed.person.canvas, listed.participant).trim().to_owned();
        listed.person.student = found.map_or_else(numbered, |(_, label)| label.clone());
    }
}

impl Listed {
    fn complete(&mut self, other: Self) {
        let Self { person, participant, groups, submission, time, is_late } = other;
        self.person.complete(person);
        for (own, told) in [(&mut self.participant, participant), (&mut self.submission, submission)] {
            if own.is_empty() {
                *own = told;
            }
        }
        self.groups.extend(groups);
        self.time = self.time.take().or(time);
        self.is_late |= is_late;
    }
}
