//! Writes the students' repository from this one: the same layout, the functions of the assignment empty, and no solution of them
//! anywhere.
//!
//! All files are collected in memory and searched for solutions before the first one is written.

mod collect;
mod leak;
mod lock;
mod manifest;
mod stub;

use std::collections::BTreeMap;
use std::fs;
use std::io;
use std::path::{Path, PathBuf};

use crate::new_folder::{self, FolderError};
use crate::rubric::Rubric;
pub use leak::{Leak, leaks};
pub use stub::{stub, unmarked};

/// Files by their path from the root of the students' repository.
pub type Files = BTreeMap<PathBuf, Vec<u8>>;

/// Reasons for which no handout is written.
#[derive(Debug, thiserror::Error)]
pub enum HandoutError {
    #[error("{}: {error}", .path.display())]
    Io { path: PathBuf, error: io::Error },
    #[error(transparent)]
    Folder(#[from] FolderError),
    #[error("{}: lies inside this repository, where it would be built as a part of it; name a folder outside", .0.display())]
    Inside(PathBuf),
    #[error("{}: {problem}", .path.display())]
    Unusable { path: PathBuf, problem: String },
    #[error("the handout would give solutions away:\n{}", .0.iter().map(Leak::to_string).collect::<Vec<_>>().join("\n"))]
    Leaks(Vec<Leak>),
}

impl HandoutError {
    fn io(path: &Path) -> impl FnOnce(io::Error) -> Self {
        move |error| Self::Io { path: path.to_owned(), error }
    }

    fn unusable(path: impl Into<PathBuf>, problem: impl ToString) -> Self {
        Self::Unusable { path: path.into(), problem: problem.to_string() }
    }
}

/// The repository that students receive for the assignment of a rubric.
pub fn files(root: &Path, rubric: &Rubric) -> Result<Files, HandoutError> {
    collect::collect(root, rubric)
}

/// Adds what an instructor has given beside the handout: a file or a folder, under its absolute path.
pub fn add_given(path: &Path, files: &mut Files) -> Result<(), HandoutError> {
    let path = std::path::absolute(path).map_err(HandoutError::io(path))?;
    collect::add(Path::new(""), &path, files)
}

/// Writes the students' repository of the repository `root` for the assignment of a rubric into the new or empty folder `to`.
pub fn write(root: &Path, rubric: &Rubric, to: &Path) -> Result<(), HandoutError> {
    check_place(root, to)?;
    let files = collect::collect(root, rubric)?;
    let found = leaks(root, rubric, &files)?;
    if !found.is_empty() {
        return Err(HandoutError::Leaks(found));
    }
    new_folder::create(to, |to| {
        for (path, bytes) in &files {
            let path = to.join(path);
            let folder = path.parent().unwrap_or(to);
            fs::create_dir_all(folder).map_err(HandoutError::io(folder))?;
            fs::write(&path, bytes).map_err(HandoutError::io(&path))?;
        }
        lock::settle(to)
    })
}

/// Refuses folders that are not empty, and folders inside the repository other than in its build products.
fn check_place(root: &Path, to: &Path) -> Result<(), HandoutError> {
    new_folder::check(to)?;
    let root = root.canonicalize().map_err(HandoutError::io(root))?;
    let absolute = std::path::absolute(to).map_err(HandoutError::io(to))?;
    let there = absolute.ancestors().find_map(|folder| folder.canonicalize().ok());
    match there {
        Some(there) if there.starts_with(&root) && !there.starts_with(root.join("target")) => {
            Err(HandoutError::Inside(to.to_owned()))
        }
        _ => Ok(()),
    }
}

#[cfg(test)]
mod tests;
