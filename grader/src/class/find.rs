//! Finds the submissions of a folder and whose they are.
//!
//! `students.csv` decides where it names a submission; see [`students`]. Otherwise the student is the name up to the first `__` or `@`,
//! or all of it, and the rest may be the time. No other rule is used, because two students taken for one would cost one of them the
//! grade. Of a student's submissions the newest counts: by its time where there is one, else by the newest modification, else by name;
//! or the best, if the rubric says so.

mod students;

use std::collections::{BTreeMap, HashMap};
use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use jiff::Timestamp;

use super::{ClassError, Person, at};
use crate::assess::ADJUSTMENTS;
use crate::rubric::Counts;
use students::{STUDENTS, Time, apply};

const ENDINGS: [&str; 3] = [".tar.gz", ".tgz", ".zip"];

/// Contents of a class folder.
pub struct Class {
    /// Submissions; that of a group is listed once for each of its students.
    pub submissions: Vec<Submission>,
    /// The students that `students.csv` names.
    pub people: Vec<Person>,
    pub remarks: Vec<String>,
}

/// One submission of one student as it was handed in.
#[derive(Clone)]
pub struct Submission {
    pub name: String,
    pub path: PathBuf,
    pub student: String,
    /// Name of the newer submission of the same student.
    pub newer: Option<String>,
    time: Option<Time>,
    modified: SystemTime,
}

/// The submissions of `folder`, by student and name.
pub fn class(folder: &Path, counts: Counts) -> Result<Class, ClassError> {
    let (mut submissions, mut remarks) = list(folder)?;
    unique_names(&mut submissions);
    let path = folder.join(STUDENTS);
    let mut people = Vec::new();
    if path.is_file() {
        people = apply(&path, &mut submissions, &mut remarks)?;
    } else {
        remarks.extend(lookalikes(&submissions));
    }
    if counts == Counts::Newest {
        mark_older(&mut submissions);
    }
    submissions.sort_by(|a, b| (&a.student, &a.name).cmp(&(&b.student, &b.name)));
    Ok(Class { submissions, people, remarks })
}

fn list(folder: &Path) -> Result<(Vec<Submission>, Vec<String>), ClassError> {
    let mut submissions = Vec::new();
    let mut remarks = Vec::new();
    for entry in fs::read_dir(folder).map_err(at(folder))? {
        let path = entry.map_err(at(folder))?.path();
        let name = shown(path.file_name().unwrap_or_default());
        if name == STUDENTS || name == ADJUSTMENTS {
            continue;
        }
        if name.starts_with('.') || !(path.is_dir() || stem(&name).is_some()) {
            remarks.push(format!("{name}: left aside, it is neither a folder nor a .zip, .tar.gz or .tgz"));
            continue;
        }
        // Grading reports unreadable submissions. Here they must not prevent the grading of others.
        let modified = newest(&path, &mut MOST_LOOKED_AT.clone()).unwrap_or(SystemTime::UNIX_EPOCH);
        let (student, time) = student(&name);
        submissions.push(Submission { student, name, path, newer: None, time, modified });
    }
    remarks.sort();
    Ok((submissions, remarks))
}

/// A file's name for use in tables and names of files. Invisible characters and invalid Unicode are escaped, so that different names
/// stay different.
fn shown(name: &OsStr) -> String {
    let visible = |c: char| if c.is_control() { c.escape_default().to_string() } else { c.to_string() };
    match name.to_str() {
        Some(name) => name.chars().map(visible).collect(),
        None => name.as_encoded_bytes().escape_ascii().to_string(),
    }
}

/// The name of an archive without its ending.
fn stem(name: &str) -> Option<&str> {
    let lower = name.to_ascii_lowercase();
    let ending = ENDINGS.iter().find(|ending| lower.ends_with(*ending) && lower.len() > ending.len())?;
    name.get(..name.len() - ending.len())
}

/// The student in a name, and the time, if that is what follows.
fn student(name: &str) -> (String, Option<Time>) {
    let name = stem(name).unwrap_or(name);
    let end = [name.find("__"), name.find('@')].into_iter().flatten().filter(|&end| end > 0).min();
    let (student, rest) = name.split_at(end.unwrap_or(name.len()));
    (student.to_string(), Time::in_name(rest.trim_start_matches(['_', '@'])))
}

/// Removes the endings, except where `anna.zip` and `anna` would then have the same name.
fn unique_names(submissions: &mut [Submission]) {
    let mut counts: HashMap<String, usize> = HashMap::new();
    for submission in &*submissions {
        *counts.entry(stem(&submission.name).unwrap_or(&submission.name).to_string()).or_default() += 1;
    }
    for submission in submissions {
        if let Some(stem) = stem(&submission.name)
            && counts.get(stem) == Some(&1)
        {
            submission.name = stem.to_string();
        }
    }
}

/// Largest number of files of a submission whose times are read.
const MOST_LOOKED_AT: usize = 10_000;

/// Time of the last change in `path`. At most `room` files are looked at; links are not followed.
fn newest(path: &Path, room: &mut usize) -> io::Result<SystemTime> {
    let data = fs::symlink_metadata(path)?;
    let mut time = data.modified()?;
    if data.is_dir() {
        // A folder's own time is that of unpacking; its files have the times of the student's work.
        let mut files = Vec::new();
        for entry in fs::read_dir(path)? {
            let Some(less) = room.checked_sub(1) else { break };
            *room = less;
            files.push(newest(&entry?.path(), room)?);
        }
        time = files.into_iter().max().unwrap_or(time);
    }
    Ok(time)
}

/// Names such as `anna` and `anna-2`, or `anna` and `Anna`, that only an instructor can tell to be one student.
fn lookalikes(submissions: &[Submission]) -> Vec<String> {
    let mut alike: BTreeMap<String, Vec<&str>> = BTreeMap::new();
    for submission in submissions {
        let student = submission.student.as_str();
        let end = student.find(['_', '-', ' ', '(']).unwrap_or(student.len());
        let students = alike.entry(student[..end].to_lowercase()).or_default();
        if !students.contains(&student) {
            students.push(student);
        }
    }
    // `submission_1`, `submission_2` … share a first word and are different students: one name must be that word alone.
    alike.retain(|word, students| students.len() > 1 && students.iter().any(|student| student.to_lowercase() == *word));
    let tell = |students: &mut Vec<&str>| {
        students.sort_unstable();
        format!("{}: counted as different students; if they are one, {STUDENTS} must say so", students.join(", "))
    };
    alike.values_mut().map(tell).collect()
}

fn mark_older(submissions: &mut [Submission]) {
    let mut newest: HashMap<String, usize> = HashMap::new();
    for (i, submission) in submissions.iter().enumerate() {
        let best = newest.entry(submission.student.clone()).or_insert(i);
        if submission.is_newer_than(&submissions[*best]) {
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

impl Submission {
    /// Time of submission: from `students.csv`, from its name, or from the newest of its files.
    pub fn submitted(&self) -> Option<Timestamp> {
        self.stated_time().or_else(|| Timestamp::try_from(self.modified).ok())
    }

    /// Time of submission from `students.csv` or from its name.
    pub fn stated_time(&self) -> Option<Timestamp> {
        self.time.as_ref().and_then(Time::moment)
    }

    fn is_newer_than(&self, other: &Self) -> bool {
        let by_time = self.time.partial_cmp(&other.time).unwrap_or(std::cmp::Ordering::Equal);
        by_time.then(self.modified.cmp(&other.modified)).then(self.name.cmp(&other.name)).is_gt()
    }
}

#[cfg(test)]
mod tests {
    use super::Counts;

    #[cfg(target_os = "linux")]
    #[test]
    fn names_that_no_table_can_show_stay_different_students() {
        use std::os::unix::ffi::OsStrExt;
        let room = tempfile::tempdir().unwrap();
        let names = ["Anna", "anna", "Jörg Müller", "new\nline"].map(str::as_bytes);
        for name in names.into_iter().chain([&b"bin\xfe"[..], b"bin\xff"]) {
            std::fs::create_dir(room.path().join(std::ffi::OsStr::from_bytes(name))).unwrap();
        }
        let class = super::class(room.path(), Counts::Newest).unwrap();
        let names: Vec<_> = class.submissions.iter().map(|found| found.name.as_str()).collect();
        assert_eq!(names, ["Anna", "Jörg Müller", "anna", r"bin\xfe", r"bin\xff", r"new\nline"]);
        assert!(class.submissions.iter().all(|found| found.newer.is_none()));
        assert_eq!(
            class.remarks,
            ["Anna, anna: counted as different students; if they are one, students.csv must say so"]
        );
    }
}
