//! What only the fast engine does: its scenes, and studies of it.

pub mod report;
pub mod stability;

use clap::Subcommand;
use fem_scene::simulation::Simulation;
use fem_scene::{Body, Scene};

use super::end::End;

/// Studies of the engine.
#[derive(Debug, Subcommand)]
pub enum Study {
    /// Error against run time: which method for which error, with tables, pictures and a page
    Report(report::Arguments),
    /// Stiff and extreme cases: what each integrator does with them, beside what it must
    Stability(stability::Arguments),
}

impl Study {
    /// Runs it.
    pub fn run(&self) -> Result<(), End> {
        match self {
            Self::Report(arguments) => report::run(arguments),
            Self::Stability(arguments) => stability::run(arguments),
        }
    }
}

/// The engine's simulation of a scene.
pub fn build(scene: &Scene, body: Body) -> Result<Box<dyn Simulation>, End> {
    fem_engine::simulator::build(scene, body).map_err(End::unusable)
}
