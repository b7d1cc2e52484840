//! Names of submissions as people and platforms write them.
//!
//! - Canvas, “Download Submissions”: `NAME[_LATE]_USER_FILE_HANDED-IN`, such as `doejane_LATE_4711_98765_hw-1.zip`. NAME is the student's
//!   in lower case without blanks, or the group's; USER and FILE are Canvas' numbers; `-1` marks a second file of one name. Anonymous
//!   assignments have `anon_CODE` in place of NAME and USER. (`lib/content_zipper.rb` in <https://github.com/instructure/canvas-lms>)
//! - Moodle, “Download all submissions”: folders `Full Name_NUMBER_assignsubmission_file`, or `…_file_` before Moodle 4.1, or without
//!   “Download submissions in folders” files `…_file_HANDED-IN`. NUMBER is the participant's, or the group's where groups submit; text
//!   typed into Moodle is in `…_onlinetext`. (`mod/assign/classes/downloader.php` in <https://github.com/moodle/moodle>)
//! - Gradescope, “Export Submissions”: folders `submission_NUMBER` beside `submission_metadata.yml`; see [`gradescope`](super::gradescope).
//!
//! Any other name is `STUDENT`, `STUDENT__REST` or `STUDENT@TIME`.

use super::students::Time;
use crate::archive::{attempt, stem};

/// The name that a platform gives the author of a submission.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Author {
    /// The student's name, in lower case, and Canvas' number or code of the student.
    Canvas { name: String, user: String },
    /// The name of a student or a group, and Moodle's number of one or the other; empty for Moodle's default group.
    Moodle { name: String, number: String },
    /// The name of a folder that `submission_metadata.yml` explains.
    Gradescope(String),
    /// The instructor's own name of the student.
    Own(String),
}

/// The parts of a name.
#[derive(Clone, Debug, PartialEq)]
pub struct Name {
    pub author: Author,
    /// The file's name as the student gave it; empty for a folder.
    pub file: String,
    /// Number of the attempt, where the name has one: later ones are larger.
    pub attempt: u64,
    /// The platform has marked the submission as late.
    pub is_late: bool,
    pub time: Option<Time>,
}

impl Author {
    /// The student's name in tables if no roster has a better one. Two authors of a platform never share it.
    pub fn student(&self) -> String {
        match self {
            Self::Canvas { name, user } if name.is_empty() => user.clone(),
            Self::Canvas { name, user } => format!("{name}_{user}"),
            Self::Moodle { name, number } if number.is_empty() => name.clone(),
            Self::Moodle { name, number } => format!("{name}_{number}"),
            Self::Gradescope(name) | Self::Own(name) => name.clone(),
        }
    }
}

impl Name {
    /// Reads a name of a folder or a file. A name is read as one of Canvas only if `is_of_canvas`.
    pub fn read(name: &str, is_of_canvas: bool) -> Self {
        moodle(name).or_else(|| canvas(name).filter(|_| is_of_canvas)).unwrap_or_else(|| own(name))
    }

    /// The name of a file without its ending, without the mark of a second attempt: the names of single files are compared by it.
    pub fn stem(&self) -> &str {
        let name = self.file.rsplit_once('.').map_or(self.file.as_str(), |(name, _)| name);
        repeated(name).0
    }
}

/// Returns true for a name that a platform gave to a student's file.
pub fn is_of_a_platform(name: &str) -> bool {
    moodle(name).is_some() || canvas(name).is_some()
}

/// Returns true if most names are those of Canvas. A single one may look so by chance.
pub fn are_of_canvas<'a>(names: impl Iterator<Item = &'a str>) -> bool {
    let (mut of_canvas, mut others) = (0, 0);
    names.for_each(|name| *if canvas(name).is_some() { &mut of_canvas } else { &mut others } += 1);
    of_canvas > others
}

fn is_number(text: &str) -> bool {
    !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit())
}

/// Canvas takes the numbers between underscores out of students' names, so that the first two are its own.
fn canvas(name: &str) -> Option<Name> {
    let parts: Vec<&str> = name.split('_').collect();
    let anonymous = parts.iter().position(|part| *part == "anon").filter(|place| *place <= 1);
    let user = match anonymous {
        Some(place) => place + 1,
        None => (1..parts.len()).find(|&place| is_number(parts[place]))?,
    };
    let number = parts.get(user + 1).filter(|number| is_number(number))?;
    let file = parts.get(user + 2..)?.join("_");
    file.contains('.').then_some(())?;
    let before = &parts[..anonymous.unwrap_or(user)];
    let is_late = before.last() == Some(&"LATE");
    let name = before[..before.len() - usize::from(is_late)].join("_");
    let user = if anonymous.is_some() { format!("anon_{}", parts[user]) } else { parts[user].to_owned() };
    // A later file has a larger number.
    let attempt = number.parse().ok()?;
    Some(Name { author: Author::Canvas { name, user }, file, attempt, is_late, time: None })
}

fn moodle(name: &str) -> Option<Name> {
    let (before, after) = name.split_once("_assignsubmission_file")?;
    if !(after.is_empty() || after.starts_with('_')) || before.is_empty() {
        return None;
    }
    let (name, number) = before.rsplit_once('_').filter(|(_, number)| is_number(number)).unwrap_or((before, ""));
    let file = after.trim_start_matches('_').to_owned();
    let attempt = repeated(stem(&file).map_or(file.as_str(), |(name, _)| name)).1;
    let author = Author::Moodle { name: name.to_owned(), number: number.to_owned() };
    Some(Name { author, file, attempt, is_late: false, time: None })
}

/// The student in a name, and the time, if that is what follows.
fn own(name: &str) -> Name {
    let (name, attempt) = attempt(stem(name).map_or(name, |(stem, _)| stem));
    let end = [name.find("__"), name.find('@')].into_iter().flatten().filter(|&end| end > 0).min();
    let (student, rest) = name.split_at(end.unwrap_or(name.len()));
    let time = Time::in_name(rest.trim_start_matches(['_', '@']));
    Name { author: Author::Own(student.to_owned()), file: String::new(), attempt, is_late: false, time }
}

/// A name without a number at its end, as in `hw (1)` or, as Canvas writes it, `hw-1`; and the number.
pub fn repeated(name: &str) -> (&str, u64) {
    let (base, number) = attempt(name);
    if number > 0 {
        return (base, number);
    }
    let dashed = name.rsplit_once('-').filter(|(base, number)| !base.is_empty() && is_number(number));
    dashed.and_then(|(base, number)| Some((base, number.parse().ok()?))).unwrap_or((name, 0))
}

#[cfg(test)]
mod tests {
    use super::*;

    fn of_canvas(name: &str, user: &str) -> Author {
        Author::Canvas { name: name.to_owned(), user: user.to_owned() }
    }

    fn of_moodle(name: &str, number: &str) -> Author {
        Author::Moodle { name: name.to_owned(), number: number.to_owned() }
    }

    #[test]
    fn names_of_platforms_are_read() {
        for (name, author, file, attempt, is_late) in [
            ("doejane_4711_98765_hw.zip", of_canvas("doejane", "4711"), "hw.zip", 98765, false),
            ("doejane_LATE_4711_98766_my_hw-1.zip", of_canvas("doejane", "4711"), "my_hw-1.zip", 98766, true),
            ("anon_Ab1cD_98765_hw.zip", of_canvas("", "anon_Ab1cD"), "hw.zip", 98765, false),
            ("LATE_anon_Ab1cD_98765_hw.zip", of_canvas("", "anon_Ab1cD"), "hw.zip", 98765, true),
            ("müllerjörg_12_345_psi.rs", of_canvas("müllerjörg", "12"), "psi.rs", 345, false),
            ("Jane Doe_657737_assignsubmission_file", of_moodle("Jane Doe", "657737"), "", 0, false),
            ("Jane Doe_657737_assignsubmission_file_", of_moodle("Jane Doe", "657737"), "", 0, false),
            (
                "Jane Doe_657737_assignsubmission_file_hw (2).zip",
                of_moodle("Jane Doe", "657737"),
                "hw (2).zip",
                2,
                false,
            ),
            ("Participant_17_assignsubmission_file_", of_moodle("Participant", "17"), "", 0, false),
            ("Default group_assignsubmission_file", of_moodle("Default group", ""), "", 0, false),
        ] {
            let found = Name::read(name, true);
            assert_eq!(found, Name { author, file: file.to_owned(), attempt, is_late, time: None }, "{name}");
        }
        assert_eq!(Name::read("doejane_4711_98766_psi_neo_hookean-2.rs", true).stem(), "psi_neo_hookean");
        assert_eq!(Name::read("Jane Doe_1_assignsubmission_file_a (1).rs", true).stem(), "a");
    }

    #[test]
    fn other_names_are_the_students() {
        for (name, student, attempt) in [
            ("anna", "anna", 0),
            ("anna (1).zip", "anna", 1),
            ("anna(12)", "anna", 12),
            ("anna__hw1 (2).tar.gz", "anna", 2),
            ("anna-1.zip", "anna-1", 0),
            ("team (red)", "team (red)", 0),
            ("(1)", "(1)", 0),
            ("doejane_4711_98765_hw.zip", "doejane_4711_98765_hw", 0),
        ] {
            let found = Name::read(name, false);
            assert_eq!((found.author.student().as_str(), found.attempt), (student, attempt), "{name}");
        }
        assert!(are_of_canvas(["doejane_1_2_a.zip", "roejohn_2_3_b.zip", "late-anna.zip"].into_iter()));
        assert!(!are_of_canvas(["team_1_2_a.zip", "anna.zip"].into_iter()));
        assert!(!are_of_canvas(["team_1_2", "team_1_3"].into_iter()), "no file of Canvas is without an ending");
    }
}
