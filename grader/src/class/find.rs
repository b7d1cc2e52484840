//! Finds the submissions of a folder and whose they are.
//!
//! `students.csv` decides where it names a submission; see [`students`]. Without it the names and rosters of platforms do; see
//! [`names`] and [`rosters`]. Otherwise the student is the name up to the first `__` or `@`, or all of it, and the rest may be the
//! time; `anna (1)` is a further attempt of `anna`. No other rule is used, because two students taken for one would cost one of them
//! the grade. Of a student's submissions the newest counts: by its time where there is one, else by the number of the attempt, else by
//! the newest modification, else by name; or the best, if the rubric says so.

mod attempts;
mod gradescope;
mod names;
mod owners;
mod parts;
mod rosters;
mod students;

use std::collections::{BTreeMap, HashMap};
use std::ffi::OsStr;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use jiff::Timestamp;
use tempfile::TempDir;

use super::{ClassError, Person, at};
use crate::archive::stem;
use crate::assess::ADJUSTMENTS;
use crate::rubric::Counts;
use names::{Author, Name, are_of_canvas};
use parts::Part;
use rosters::Listed;
use students::{STUDENTS, Time, apply};

/// Folder that macOS adds to archives.
const PACKED_BY_MACOS: &str = "__MACOSX";

/// Contents of a class folder.
pub struct Class {
    /// Submissions; that of a group is listed once for each of its students.
    pub submissions: Vec<Submission>,
    /// The students that `students.csv` or a platform's roster names.
    pub people: Vec<Person>,
    pub remarks: Vec<String>,
    /// Submissions that came as single files, as folders. They are removed with this value.
    pub gathered: Option<TempDir>,
}

/// One submission of one student as it was handed in.
#[derive(Clone)]
pub struct Submission {
    pub name: String,
    pub path: PathBuf,
    pub student: String,
    /// Name of the newer submission of the same student.
    pub newer: Option<String>,
    /// The platform has marked it as late.
    pub is_late: bool,
    author: Author,
    attempt: u64,
    time: Option<Time>,
    modified: SystemTime,
}

/// The submissions of `folder`, by student and name. A `roster` takes the place of all tables in the folder.
pub fn class(folder: &Path, roster: Option<&Path>, counts: Counts) -> Result<Class, ClassError> {
    let folder = &exported(folder).map_err(at(folder))?;
    let mut found = list(folder)?;
    let gathered = found.gather().map_err(at(folder))?;
    let Found { mut submissions, mut remarks, mut rosters, .. } = found;
    unique_names(&mut submissions);
    let mut table = Some(folder.join(STUDENTS)).filter(|path| path.is_file());
    if let Some(path) = roster {
        fs::File::open(path).map_err(|source| ClassError::NoRoster { path: path.to_owned(), source })?;
        let rows = rosters::read(path)?;
        table = rows.is_none().then(|| path.to_owned());
        rosters.retain(|(name, _)| name == gradescope::METADATA);
        rosters.extend(rows.map(|rows| (shown(path.as_os_str()), rows)));
    }
    let mut people = Vec::new();
    if let Some(path) = table {
        let mut given = Vec::new();
        people = apply(&path, &mut submissions, &mut given, &mut remarks)?;
        attempts::join(&given, &people, &mut submissions, &mut remarks);
        remarks.extend(rosters.iter().map(|(name, _)| format!("{name}: left aside, because {STUDENTS} is there")));
    } else if !rosters.is_empty() {
        let rows = rosters.into_iter().flat_map(|(_, rows)| rows).collect();
        people = owners::assign(&rosters::joined(rows), &mut submissions, &mut remarks);
    } else {
        remarks.extend(lookalikes(&submissions));
    }
    if let Some(path) = roster.filter(|_| people.is_empty()) {
        return Err(ClassError::NoStudents(path.to_owned()));
    }
    if counts == Counts::Newest {
        attempts::mark_older(&mut submissions);
    }
    submissions.sort_by(|a, b| (&a.student, &a.name).cmp(&(&b.student, &b.name)));
    Ok(Class { submissions, people, remarks, gathered })
}

/// The folder `assignment_…_export` of Gradescope, if nothing else is in the one into which it was unpacked; or the folder itself.
fn exported(folder: &Path) -> io::Result<PathBuf> {
    let entries = fs::read_dir(folder)?.collect::<io::Result<Vec<_>>>()?;
    let is_visible = |name: &str| !name.starts_with('.') && name != PACKED_BY_MACOS;
    let visible: Vec<_> = entries.iter().filter(|entry| is_visible(&entry.file_name().to_string_lossy())).collect();
    let is_export = |name: &str| name.starts_with("assignment_") && name.ends_with("_export");
    match &visible[..] {
        [one] if is_export(&one.file_name().to_string_lossy()) && one.path().join(gradescope::METADATA).is_file() => {
            Ok(one.path())
        }
        _ => Ok(folder.to_owned()),
    }
}

/// Contents of a folder before anything is known of its students.
struct Found {
    submissions: Vec<Submission>,
    parts: Vec<Part>,
    /// The rosters by their files' names.
    rosters: Vec<(String, Vec<Listed>)>,
    remarks: Vec<String>,
}

fn list(folder: &Path) -> Result<Found, ClassError> {
    let mut paths = Vec::new();
    for entry in fs::read_dir(folder).map_err(at(folder))? {
        let path = entry.map_err(at(folder))?.path();
        let name = shown(path.file_name().unwrap_or_default());
        if name != STUDENTS && name != ADJUSTMENTS {
            paths.push((name, path));
        }
    }
    paths.sort();
    let files = paths.iter().filter(|(name, path)| !name.ends_with(".csv") && path.is_file());
    let is_of_canvas = are_of_canvas(files.map(|(name, _)| name.as_str()));
    let mut found = Found { submissions: Vec::new(), parts: Vec::new(), rosters: Vec::new(), remarks: Vec::new() };
    let is_of_gradescope = folder.join(gradescope::METADATA).is_file();
    for (name, path) in paths {
        if name == gradescope::METADATA {
            let text = fs::read_to_string(&path).map_err(at(&path))?;
            found.rosters.push((name, gradescope::read(&text)));
            continue;
        }
        // A table that a student has handed in is no roster, whatever it says.
        if name.to_lowercase().ends_with(".csv")
            && !names::is_of_a_platform(&name)
            && let Some(rows) = rosters::read(&path)?
        {
            found.rosters.push((name, rows));
            continue;
        }
        let mut read = Name::read(&name, is_of_canvas);
        if is_of_gradescope && name.starts_with("submission_") {
            read.author = Author::Gradescope(name.clone());
        }
        found.add(name, path, read);
    }
    Ok(found)
}

impl Found {
    fn add(&mut self, name: String, path: PathBuf, read: Name) {
        if let Some(part) = Part::of(&read, &path).filter(|_| path.is_file()) {
            self.parts.push(part);
        } else if name.starts_with('.') || name == PACKED_BY_MACOS || !(path.is_dir() || stem(&name).is_some()) {
            let remark = "left aside, it is neither a folder nor a .zip, .tar, .tar.gz or .tgz";
            self.remarks.push(format!("{name}: {remark}"));
        } else if name.contains("_assignsubmission_onlinetext") {
            self.remarks.push(format!("{name}: left aside, it is a text that was typed into Moodle"));
        } else {
            self.submissions.push(Submission::new(name, path, read.author, (read.attempt, read.is_late, read.time)));
        }
    }

    /// Puts the single files of each student together, unless the student has an archive or a folder too.
    fn gather(&mut self) -> io::Result<Option<TempDir>> {
        let has_more = |part: &Part| self.submissions.iter().any(|submission| submission.author == part.author);
        let (beside, parts): (Vec<_>, Vec<_>) = std::mem::take(&mut self.parts).into_iter().partition(has_more);
        let mut authors: Vec<String> = beside.iter().map(|part| part.author.student()).collect();
        authors.dedup();
        let remark =
            |author| format!("{author}: single files are left aside, because an archive or a folder is there too");
        self.remarks.extend(authors.into_iter().map(remark));
        if parts.is_empty() {
            return Ok(None);
        }
        let room = tempfile::tempdir()?;
        for (author, is_late, path) in parts::gather(parts, room.path())? {
            let name = shown(path.file_name().unwrap_or_default());
            self.submissions.push(Submission::new(name, path, author, (0, is_late, None)));
        }
        Ok(Some(room))
    }
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

/// Removes the endings, except where `anna.zip` and `anna` would then have the same name.
fn unique_names(submissions: &mut [Submission]) {
    let mut counts: HashMap<String, usize> = HashMap::new();
    for submission in &*submissions {
        let stem = stem(&submission.name).map_or(submission.name.as_str(), |(stem, _)| stem);
        *counts.entry(stem.to_string()).or_default() += 1;
    }
    for submission in submissions {
        if let Some((stem, _)) = stem(&submission.name)
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

impl Submission {
    fn new(name: String, path: PathBuf, author: Author, stated: (u64, bool, Option<Time>)) -> Self {
        let (attempt, is_late, time) = stated;
        // Grading reports unreadable submissions. Here they must not prevent the grading of others.
        let modified = newest(&path, &mut MOST_LOOKED_AT.clone()).unwrap_or(SystemTime::UNIX_EPOCH);
        Self { student: author.student(), name, path, newer: None, is_late, author, attempt, time, modified }
    }

    /// Time of submission: from `students.csv`, from its name, or from the newest of its files.
    pub fn submitted(&self) -> Option<Timestamp> {
        self.stated_time().or_else(|| Timestamp::try_from(self.modified).ok())
    }

    /// Time of submission from `students.csv` or from its name.
    pub fn stated_time(&self) -> Option<Timestamp> {
        self.time.as_ref().and_then(Time::moment)
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
        let class = super::class(room.path(), None, Counts::Newest).unwrap();
        let names: Vec<_> = class.submissions.iter().map(|found| found.name.as_str()).collect();
        assert_eq!(names, ["Anna", "Jörg Müller", "anna", r"bin\xfe", r"bin\xff", r"new\nline"]);
        assert!(class.submissions.iter().all(|found| found.newer.is_none()));
        assert_eq!(
            class.remarks,
            ["Anna, anna: counted as different students; if they are one, students.csv must say so"]
        );
    }
}
