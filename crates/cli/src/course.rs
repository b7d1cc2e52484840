//! The course that the program belongs to.

use std::path::{Path, PathBuf};

use fem_model::Body;
use fem_model::simulation::Simulation;
use fem_scene::{Scene, SceneError};

/// Builds the simulation of a scene on its body. Refuses what the course does not have.
pub type Build = fn(&Scene, Body) -> Result<Box<dyn Simulation>, SceneError>;

/// A course: its pipeline, and where its files are.
pub struct Course {
    /// Builds the simulation that the functions of the course run.
    pub build: Build,
    /// The folder with its `src` and `data`.
    pub folder: &'static Path,
    /// Text of its first page, whose table lists the functions in teaching order.
    pub first_page: &'static str,
}

impl Course {
    /// The folder of scenes and meshes: in the current folder, in that of the course, or beside the program.
    pub(crate) fn data(&self) -> PathBuf {
        let has_scenes = |folder: &PathBuf| folder.join("scenes").is_dir();
        let built_in = self.folder.join("data");
        let program = std::env::current_exe().unwrap_or_default();
        let beside = program.parent().unwrap_or(Path::new("")).join("data");
        [PathBuf::from("data"), built_in.clone(), beside].into_iter().find(has_scenes).unwrap_or(built_in)
    }
}
