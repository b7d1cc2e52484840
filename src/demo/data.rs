//! The folder of scenes and meshes.

use std::path::{Path, PathBuf};

/// The folder `data`: in the current folder, in the repository that this program was built in, or beside the program.
pub fn folder() -> PathBuf {
    let has_scenes = |folder: &PathBuf| folder.join("scenes").is_dir();
    let built_in = Path::new(env!("CARGO_MANIFEST_DIR")).join("data");
    let program = std::env::current_exe().unwrap_or_default();
    let beside = program.parent().unwrap_or(Path::new("")).join("data");
    [PathBuf::from("data"), built_in.clone(), beside].into_iter().find(has_scenes).unwrap_or(built_in)
}

/// The pictures that bodies can be made from, sorted by name.
#[cfg(feature = "viewer")]
pub fn pictures() -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder().join("pictures")).into_iter().flatten().flatten();
    let is_picture = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "png");
    let mut pictures: Vec<PathBuf> = entries.map(|entry| entry.path()).filter(is_picture).collect();
    pictures.sort();
    pictures
}
