//! The output folder: complete grades by key, an index, and logs of failures.
//!
//! A complete folder of grades is renamed to its key. The index is written to a temporary file and renamed.

use std::fs::{self, File};
use std::io::{self, Read, Write};
use std::path::{Path, PathBuf};
use std::thread::sleep;
use std::time::Duration;

use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use super::folders::FOLDERS;
use super::{ClassError, Entry, Identity, Outcome, Person, Report, Shard, Summary, at};
use crate::grade::{FORMAT_VERSION, Grade, MOST_BYTES};

const INDEX: &str = "class.json";
const PARTIAL: &str = ".partial-";

/// An output folder that no other run works in, as long as this value lives.
pub struct Store {
    pub out: PathBuf,
    _lock: File,
}

/// Contents of `class.json`, which `merge` reads.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Index {
    pub format_version: u32,
    pub identity: Identity,
    pub shard: Option<Shard>,
    pub remarks: Vec<String>,
    #[serde(default)]
    pub people: Vec<Person>,
    #[serde(default)]
    pub title: String,
    #[serde(default)]
    pub max_score: f64,
    #[serde(default)]
    pub release: Option<String>,
    pub submissions: Vec<IndexRow>,
}

/// One submission of `class.json`.
#[derive(Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct IndexRow {
    pub submission: String,
    pub student: String,
    pub state: IndexState,
}

/// State of a submission in `class.json`.
#[derive(Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum IndexState {
    /// Folder of the grade, relative to the index.
    Graded(PathBuf),
    /// No grade; the reason.
    NotGraded(String),
    Waiting,
    /// The newer or better one that counts.
    Older(String),
    /// The student's score without a submission.
    NoSubmission(Option<f64>),
}

impl Store {
    /// Makes the folder if needed, locks it, and removes the unfinished files of a killed run.
    pub fn open(out: &Path) -> Result<Self, ClassError> {
        for folder in FOLDERS {
            let folder = out.join(folder);
            fs::create_dir_all(&folder).map_err(at(&folder))?;
        }
        let path = out.join(".lock");
        let lock = File::options().create(true).truncate(false).write(true).open(&path).map_err(at(&path))?;
        match lock.try_lock() {
            Ok(()) => {}
            Err(fs::TryLockError::WouldBlock) => return Err(ClassError::Locked(out.display().to_string())),
            Err(fs::TryLockError::Error(source)) => return Err(ClassError::File { path, source }),
        }
        let store = Self { out: out.to_path_buf(), _lock: lock };
        store.clear_partial()?;
        Ok(store)
    }

    fn clear_partial(&self) -> Result<(), ClassError> {
        let grades = self.out.join("grades");
        for entry in fs::read_dir(&grades).map_err(at(&grades))? {
            let path = entry.map_err(at(&grades))?.path();
            if path.file_name().is_some_and(|name| name.to_string_lossy().starts_with(PARTIAL)) {
                remove_while_written(&path).map_err(at(&path))?;
            }
        }
        Ok(())
    }

    /// A new empty folder for a grader to write into. Its name contains the number of this process, so that a grader of a killed
    /// run cannot write into it.
    pub fn begin(&self, key: &str) -> io::Result<PathBuf> {
        let path = self.out.join("grades").join(format!("{PARTIAL}{}-{key}", std::process::id()));
        fs::create_dir(&path)?;
        Ok(path)
    }

    /// Moves a complete folder to its place, and removes the log of an earlier failure.
    pub fn finish(&self, partial: &Path, name: &str, key: &str) -> io::Result<()> {
        let place = self.out.join(folder(key));
        if place.exists() {
            // The folder existed but could not be read, so the submission was graded again.
            fs::remove_dir_all(&place)?;
        }
        fs::rename(partial, place)?;
        self.point(name, key)?;
        remove_if_there(&log(&self.out, name))
    }

    /// Keeps the log of a grader that failed, and removes its folder.
    pub fn fail(&self, partial: &Path, name: &str) -> io::Result<()> {
        fs::rename(partial.join("log.txt"), log(&self.out, name))?;
        fs::remove_dir_all(partial)
    }

    /// The grade of an earlier run; `None` if it is missing or cannot be read.
    pub fn find(&self, key: &str) -> Option<Grade> {
        read_grade(&self.out.join(folder(key))).ok()
    }

    /// The grade of an earlier run, whatever it was graded with, and its key.
    pub fn find_any(&self, name: &str) -> Option<(Grade, String)> {
        let folder = self.out.join("submissions").join(name).canonicalize().ok()?;
        Some((read_grade(&folder).ok()?, folder.file_name()?.to_string_lossy().into_owned()))
    }

    /// Links a submission's name to its reports.
    pub fn point(&self, name: &str, key: &str) -> io::Result<()> {
        let target = Path::new("..").join(folder(key));
        let place = self.out.join("submissions").join(name);
        remove_if_there(&place)?;
        #[cfg(unix)]
        return std::os::unix::fs::symlink(target, place);
        #[cfg(not(unix))]
        return fs::write(place, target.display().to_string());
    }

    /// Writes the index and the report.
    pub fn publish(&self, summary: &Summary, report: Report) -> Result<(), ClassError> {
        let index = serde_json::to_vec_pretty(&Index::of(summary)).map_err(io::Error::from).map_err(at(&self.out))?;
        let path = self.out.join(INDEX);
        replace(&path, &index).map_err(at(&path))?;
        report(summary, &self.out).map_err(ClassError::Report)
    }
}

/// Path of the log of a submission that could not be graded, in the output folder.
pub fn log(out: &Path, name: &str) -> PathBuf {
    out.join("failed").join(format!("{name}.log"))
}

/// Path of the grade of a key, in the output folder.
pub fn folder(key: &str) -> PathBuf {
    Path::new("grades").join(key)
}

/// Path of a student's reports in the output folder. Its name is safe for a folder and unique to the student.
pub fn student_folder(student: &str) -> PathBuf {
    let is_plain = |c: char| c.is_alphanumeric() || matches!(c, '-' | '_' | '.' | '@' | '+' | ' ');
    let mut name: String = student.chars().map(|c| if is_plain(c) { c } else { '_' }).take(80).collect();
    if name != student || name.starts_with('.') || name.trim() != name || name.is_empty() {
        let digest = Sha256::digest(student.as_bytes());
        let digits: String = digest.iter().take(4).map(|byte| format!("{byte:02x}")).collect();
        name = format!("{}-{digits}", name.trim().trim_start_matches('.'));
    }
    Path::new("students").join(name)
}

/// Reads the `grade.json` of a folder.
pub fn read_grade(folder: &Path) -> Result<Grade, String> {
    let mut text = Vec::new();
    let read = File::open(folder.join("grade.json")).and_then(|file| file.take(MOST_BYTES + 1).read_to_end(&mut text));
    read.map_err(|error| format!("grade.json: {error}"))?;
    if text.len() as u64 > MOST_BYTES {
        return Err(format!("grade.json is larger than {MOST_BYTES} bytes, which no grade is"));
    }
    let grade: Grade = serde_json::from_slice(&text).map_err(|error| format!("grade.json: {error}"))?;
    if grade.format_version != FORMAT_VERSION {
        return Err(format!("grade.json has format {}, expected is {FORMAT_VERSION}", grade.format_version));
    }
    if !(grade.score.is_finite() && grade.max_score.is_finite() && 0.0 <= grade.score && grade.score <= grade.max_score)
    {
        return Err(format!("grade.json has the score {} of {}", grade.score, grade.max_score));
    }
    Ok(grade)
}

/// Removes a folder, or a file in its place, that the grader of a killed run may still write.
fn remove_while_written(path: &Path) -> io::Result<()> {
    let mut tries = 20;
    loop {
        let result = if path.is_dir() { fs::remove_dir_all(path) } else { remove_if_there(path) };
        match result {
            Err(error) if error.kind() == io::ErrorKind::DirectoryNotEmpty && tries > 0 => tries -= 1,
            result => return result,
        }
        sleep(Duration::from_millis(50));
    }
}

fn remove_if_there(path: &Path) -> io::Result<()> {
    match fs::remove_file(path) {
        Err(error) if error.kind() != io::ErrorKind::NotFound => Err(error),
        _ => Ok(()),
    }
}

/// Replaces a file atomically: a reader sees either the old file or the new one.
pub fn replace(path: &Path, bytes: &[u8]) -> io::Result<()> {
    let folder = path.parent().unwrap_or(Path::new("."));
    let mut file = tempfile::NamedTempFile::new_in(folder)?;
    file.write_all(bytes)?;
    file.persist(path).map_err(|error| error.error)?;
    Ok(())
}

impl Index {
    /// The index of an output folder.
    pub fn read(out: &Path) -> Result<Self, ClassError> {
        let path = out.join(INDEX);
        let text = fs::read(&path).map_err(|source| ClassError::NoResults { path: path.clone(), source })?;
        let index: Self = serde_json::from_slice(&text)
            .map_err(|error| ClassError::Unreadable { path: path.clone(), message: error.to_string() })?;
        if index.format_version == FORMAT_VERSION {
            return Ok(index);
        }
        let message = format!("has format {}, expected is {FORMAT_VERSION}", index.format_version);
        Err(ClassError::Unreadable { path, message })
    }

    fn of(summary: &Summary) -> Self {
        Self {
            format_version: FORMAT_VERSION,
            identity: summary.identity.clone(),
            shard: summary.shard.map(|(k, n)| Shard { k, n }),
            remarks: summary.remarks.clone(),
            people: summary.people.clone(),
            title: summary.title.clone(),
            max_score: summary.max_score,
            release: summary.release.clone(),
            submissions: summary.entries.iter().map(IndexRow::of).collect(),
        }
    }
}

impl IndexRow {
    fn of(entry: &Entry) -> Self {
        let state = match &entry.outcome {
            Outcome::Graded(_, folder) => IndexState::Graded(folder.clone()),
            Outcome::NotGraded(reason) => IndexState::NotGraded(reason.clone()),
            Outcome::Waiting => IndexState::Waiting,
            Outcome::Older { newer } => IndexState::Older(newer.clone()),
            Outcome::NoSubmission(score) => IndexState::NoSubmission(*score),
        };
        Self { submission: entry.submission.clone(), student: entry.student.clone(), state }
    }
}
