//! The error of scene files.

use std::path::{Path, PathBuf};

use thiserror::Error;

use fem_mesh::MeshError;

/// A problem with a scene, in one message with file, line, field and remedy.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SceneError {
    /// No scene has this name.
    #[error("there is no scene `{name}`; {known}, or the path of a .toml file")]
    Unknown {
        /// The requested name.
        name: String,
        /// The names of all scenes.
        known: String,
    },
    /// The file cannot be read.
    #[error("{}: cannot be read: {reason}; check the path and that you may read it", file.display())]
    Unreadable {
        /// The scene file.
        file: PathBuf,
        /// The error of the operating system.
        reason: String,
    },
    /// A line of the file has a problem.
    #[error("{}, line {line}: {problem}", file.display())]
    Line {
        /// The scene file.
        file: PathBuf,
        /// Counted from 1.
        line: usize,
        /// The field, its problem and the remedy.
        problem: String,
    },
    /// A key that is overridden has a problem.
    #[error("--set {option}: {problem}")]
    Override {
        /// The override as it was given.
        option: String,
        /// The field, its problem and the remedy.
        problem: String,
    },
    /// A mesh of the scene has a problem.
    #[error("{}, line {line}: {}", file.display(), of_field(field, error))]
    Mesh {
        /// The scene file.
        file: PathBuf,
        /// Counted from 1.
        line: usize,
        /// The key that names the mesh.
        field: &'static str,
        /// The problem of the mesh.
        error: MeshError,
    },
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
