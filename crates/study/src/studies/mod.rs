//! Studies: which runs a scene needs, and their rows.

pub(crate) mod scene;
pub(crate) mod space;

use std::path::{Path, PathBuf};

pub use crate::runs::measure::Factory;

/// Settings of a study.
pub struct Settings<'a> {
    /// Folder of meshes and scenes.
    pub data: PathBuf,
    /// Folder of the results; contains a folder `states`.
    pub out: PathBuf,
    /// The short study, of less than a minute.
    pub is_quick: bool,
    /// Builds simulations of both pipelines.
    pub factory: &'a Factory<'a>,
    /// Receives the number of finished parts, the number of all parts, and the name of the next one.
    pub tell: &'a (dyn Fn(usize, usize, &str) + Sync),
}

/// Creates the folders of a study.
pub(crate) fn make_folders(out: &Path) -> Result<(), String> {
    let states = out.join("states");
    std::fs::create_dir_all(&states)
        .map_err(|error| format!("{}: {error}; name a folder that can be created", states.display()))
}
