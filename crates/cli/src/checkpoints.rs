//! `--checkpoint`: the state now and then, so that a run which is killed can go on.

use std::path::Path;
use std::time::{Duration, Instant};

use fem_model::simulation::Simulation;
use fem_scene::Scene;

use crate::cli::RunArguments;

/// The file of checkpoints and when it was written last.
pub struct Checkpoints<'a> {
    file: &'a Path,
    scene: &'a Scene,
    every: Duration,
    last: Instant,
}

impl<'a> Checkpoints<'a> {
    /// The checkpoints that the options ask for; `None` without them.
    pub fn new(arguments: &'a RunArguments, scene: &'a Scene) -> Option<Self> {
        let file = arguments.checkpoint.as_deref()?;
        Some(Self { file, scene, every: arguments.checkpoint_every, last: Instant::now() })
    }

    /// Returns true if the next checkpoint is due.
    pub fn is_due(&self) -> bool {
        self.last.elapsed() >= self.every
    }

    /// Writes one. If that fails, the file of the last one stays, and the run goes on with a warning: it may be long.
    pub fn write(&mut self, simulation: &dyn Simulation) {
        if let Err(error) = fem_scene::write_state(self.file, self.scene, simulation) {
            eprintln!("warning: no checkpoint after step {}: {error}", simulation.steps());
        }
        self.last = Instant::now();
    }
}
