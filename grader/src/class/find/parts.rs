//! Submissions that a platform gives as single files, one for each function: they are copied into a folder each.

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use grader::submission::{MAX_FILE_BYTES, NAMES};

use super::names::{Author, Name};

/// A file with one function.
pub struct Part {
    pub author: Author,
    pub is_late: bool,
    function: &'static str,
    attempt: u64,
    path: PathBuf,
}

impl Part {
    /// The part in a file of a platform; `None` if it holds none of the 22 functions.
    pub fn of(name: &Name, path: &Path) -> Option<Self> {
        name.file.strip_suffix(".rs")?;
        let function = NAMES.into_iter().find(|function| *function == name.stem())?;
        let (author, is_late) = (name.author.clone(), name.is_late);
        Some(Self { author, is_late, function, attempt: name.attempt, path: path.to_owned() })
    }
}

/// Copies the parts of each author into `room/NAME/src`; of several files of a function the last attempt. Returns the folders.
pub fn gather(parts: Vec<Part>, room: &Path) -> io::Result<Vec<(Author, bool, PathBuf)>> {
    let mut authors: BTreeMap<String, Vec<Part>> = BTreeMap::new();
    for part in parts {
        authors.entry(part.author.student()).or_default().push(part);
    }
    let mut folders = Vec::new();
    for (student, mut parts) in authors {
        let folder = room.join(super::shown(student.as_ref()).replace(['/', '\\'], "_"));
        fs::create_dir_all(folder.join("src"))?;
        parts.sort_by_key(|part| part.attempt);
        let is_late = parts.iter().any(|part| part.is_late);
        for part in &parts {
            let metadata = fs::symlink_metadata(&part.path)?;
            if metadata.is_file() && metadata.len() <= MAX_FILE_BYTES {
                let copy = folder.join("src").join(format!("{}.rs", part.function));
                fs::copy(&part.path, &copy)?;
                // The time of the newest file is the submission's, where there is no other.
                fs::File::options().append(true).open(&copy)?.set_modified(metadata.modified()?)?;
            }
        }
        folders.push((parts[0].author.clone(), is_late, folder));
    }
    Ok(folders)
}
