//! Studies: which runs a scene needs, and their rows.

pub mod scene;
pub mod space;

use std::path::{Path, PathBuf};

use crate::runs::measure::Factory;

/// What a study needs.
pub struct Settings<'a> {
    /// Where meshes are.
    pub data: PathBuf,
    /// Where results go; it has a folder `states`.
    pub out: PathBuf,
    /// Whether minutes are too long.
    pub is_quick: bool,
    /// Both pipelines.
    pub factory: &'a Factory<'a>,
    /// Told how many pieces of work are done, of how many, and what comes next.
    pub tell: &'a dyn Fn(usize, usize, &str),
}

/// Where states of a study go.
pub fn make_folders(out: &Path) -> Result<(), String> {
    let states = out.join("states");
    std::fs::create_dir_all(&states)
        .map_err(|error| format!("{}: {error}; name a folder that can be made", states.display()))
}
