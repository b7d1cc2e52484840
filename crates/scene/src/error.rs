//! The error of scene files.

use std::path::{Path, PathBuf};

use thiserror::Error;

use fem_mesh::MeshError;

/// A problem with a scene, in one message with file, line, field and remedy.
#[derive(Clone, Debug, Error, PartialEq)]
#[allow(missing_docs)] // the messages are the documentation of the fields
pub enum SceneError {
    /// No scene has this name.
    #[error("there is no scene `{name}`; {known}, or the path of a .toml file")]
    Unknown { name: String, known: String },
    /// The file cannot be read.
    #[error("{}: cannot be read: {reason}; check the path and that you may read it", file.display())]
    Unreadable { file: PathBuf, reason: String },
    /// A line of the file has a problem.
    #[error("{}, line {line}: {problem}", file.display())]
    Line { file: PathBuf, line: usize, problem: String },
    /// A key that is overridden has a problem.
    #[error("--set {option}: {problem}")]
    Override { option: String, problem: String },
    /// A mesh of the scene has a problem.
    #[error("{}, line {line}: {}", file.display(), of_field(field, error))]
    Mesh { file: PathBuf, line: usize, field: &'static str, error: MeshError },
}

impl SceneError {
    /// The problem and its remedy without the place in a file or an option, for a user who has changed a number in a window.
    pub fn problem(&self) -> String {
        match self {
            Self::Line { problem, .. } | Self::Override { problem, .. } => problem.clone(),
            Self::Mesh { error, .. } => error.to_string(),
            Self::Unknown { .. } | Self::Unreadable { .. } => self.to_string(),
        }
    }
}

/// The problem of a mesh at a field, which also names the file, unless the mesh is made by the field alone.
pub(crate) fn of_field(field: &str, error: &MeshError) -> String {
    match field.strip_prefix("mesh.") {
        Some(key) if error.file == Path::new(key) => format!("{field}: {}", error.problem),
        _ => format!("{field}: {error}"),
    }
}
