//! The one error of scene files.

use std::path::PathBuf;

use thiserror::Error;

use fem_mesh::MeshError;

/// Why a scene cannot be used: one message with file, line, field and remedy.
#[derive(Clone, Debug, Error, PartialEq)]
pub enum SceneError {
    /// There is no scene of that name.
    #[error("there is no scene `{name}`; {known}, or the path of a .toml file")]
    Unknown {
        /// What was asked for.
        name: String,
        /// The names that there are.
        known: String,
    },
    /// The file cannot be read.
    #[error("{}: cannot be read: {reason}; check the path and that you may read it", file.display())]
    Unreadable {
        /// The scene file.
        file: PathBuf,
        /// What the system says.
        reason: String,
    },
    /// A line of the file is wrong.
    #[error("{}, line {line}: {problem}", file.display())]
    Line {
        /// The scene file.
        file: PathBuf,
        /// Counted from 1.
        line: usize,
        /// What is wrong with which field, and the remedy.
        problem: String,
    },
    /// A mesh that the scene names is wrong.
    #[error("{}, line {line}: {field}: {error}", file.display())]
    Mesh {
        /// The scene file.
        file: PathBuf,
        /// Counted from 1.
        line: usize,
        /// The key that names the mesh.
        field: &'static str,
        /// What is wrong with it.
        error: MeshError,
    },
}
