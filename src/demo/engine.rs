//! What only the fast engine does: its scenes, and studies of it.

pub mod report;

use clap::Subcommand;
use fem_engine::scene::{Body, Scene};
use fem_engine::simulation::Simulation;

use super::end::End;

/// Studies of the engine.
#[derive(Debug, Subcommand)]
pub enum Study {
    /// Error against run time: which method for which error, with tables, pictures and a page
    Report(report::Arguments),
}

impl Study {
    /// Runs it.
    pub fn run(&self) -> Result<(), End> {
        match self {
            Self::Report(arguments) => report::run(arguments),
        }
    }
}

/// The engine's simulation of a scene.
pub fn build(scene: &Scene, body: Body) -> Result<Box<dyn Simulation>, End> {
    fem_engine::engine::build(scene, body).map_err(End::unusable)
}
