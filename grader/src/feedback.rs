//! Feedback for students: their reports without the instructor's, in a folder for each student, or in one archive.

use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

use jiff::Timestamp;
use thiserror::Error;
use zip::write::SimpleFileOptions;

use crate::class::{self, ClassError};
use crate::new_folder::{self, FolderError};

/// The files that a student may read.
pub const FILES: [&str; 4] = ["report.html", "report.md", "results.json", "junit.xml"];

/// Reasons for which there is no feedback.
#[derive(Debug, Error)]
pub enum FeedbackError {
    #[error(transparent)]
    Class(#[from] ClassError),
    #[error(transparent)]
    Folder(#[from] FolderError),
    #[error("{path}: {error}", path = .0.display(), error = .1)]
    Io(PathBuf, io::Error),
    #[error("the rubric releases the reports at {0}; call again then, or change `release` in it and run `class`")]
    TooEarly(String),
}

fn at(path: &Path) -> impl FnOnce(io::Error) -> FeedbackError {
    move |error| FeedbackError::Io(path.to_owned(), error)
}

/// Writes a folder for each graded student of the `results` into the new or empty folder `to`, and the same into an archive, if one is
/// named. Returns their number.
///
/// # Errors
/// Results that cannot be read, places that cannot be written, and a time before the rubric's `release`.
pub fn write(results: &Path, to: &Path, archive: Option<&Path>, now: Timestamp) -> Result<usize, FeedbackError> {
    let (folders, release) = class::handed_back(results)?;
    if let Some(release) = release
        && release.parse().is_ok_and(|release: Timestamp| now < release)
    {
        return Err(FeedbackError::TooEarly(release));
    }
    new_folder::create(to, |to| {
        for folder in &folders {
            let own = to.join(folder.file_name().unwrap_or_default());
            fs::create_dir_all(&own).map_err(at(&own))?;
            for name in FILES {
                fs::copy(folder.join(name), own.join(name)).map_err(at(&folder.join(name)))?;
            }
        }
        Ok::<(), FeedbackError>(())
    })?;
    if let Some(archive) = archive {
        pack(&folders, archive).map_err(at(archive))?;
    }
    Ok(folders.len())
}

/// Writes the archive to a temporary file and renames it.
fn pack(folders: &[PathBuf], archive: &Path) -> io::Result<()> {
    let beside = archive.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let file = tempfile::NamedTempFile::new_in(beside)?;
    let mut writer = zip::ZipWriter::new(file);
    for folder in folders {
        let own = folder.file_name().unwrap_or_default().to_string_lossy();
        for name in FILES {
            writer.start_file(format!("{own}/{name}"), SimpleFileOptions::default().unix_permissions(0o644))?;
            io::copy(&mut File::open(folder.join(name))?, &mut writer)?;
        }
    }
    let mut file = writer.finish()?;
    file.flush()?;
    file.persist(archive).map_err(|error| error.error)?;
    Ok(())
}
