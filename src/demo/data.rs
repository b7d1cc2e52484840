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
