//! A run as a series of `.vtu` files with a `.pvd` that lists them, for ParaView.

use std::fs;
use std::num::NonZeroUsize;
use std::path::{Path, PathBuf};

use super::fields::export_fields;
use fem_mesh::write::write_pvd;
use fem_mesh::{MeshError, Problem};
use fem_model::simulation::Simulation;

/// Files of a run in a folder: `NAME_000000.vtu` of the first state, one after every so many steps and after the last one, and
/// `NAME.pvd` with the time of each. NAME is that of the simulation, and files are numbered by the steps since its start.
#[derive(Debug)]
pub struct Series {
    folder: PathBuf,
    every: NonZeroUsize,
    /// Step of the last file.
    last: Option<usize>,
    written: Vec<(f64, String)>,
}

impl Series {
    /// Creates the folder if it does not exist. A file is written after every `every` steps.
    pub fn new(folder: &Path, every: NonZeroUsize) -> Result<Self, MeshError> {
        let unwritable = |error: std::io::Error| Problem::Unwritable { reason: error.to_string() };
        fs::create_dir_all(folder).map_err(|error| MeshError::in_file(folder, unwritable(error)))?;
        Ok(Self { folder: folder.to_owned(), every, last: None, written: Vec::new() })
    }

    /// Writes the state if its step is one of the series. Call it with the first state and after every step.
    pub fn add(&mut self, simulation: &dyn Simulation) -> Result<(), MeshError> {
        let is_one = self.last.is_none() || simulation.steps().is_multiple_of(self.every.get());
        if is_one { self.write(simulation) } else { Ok(()) }
    }

    fn write(&mut self, simulation: &dyn Simulation) -> Result<(), MeshError> {
        let step = simulation.steps();
        let file = format!("{}_{step:06}.vtu", simulation.name());
        export_fields(&self.folder.join(&file), simulation)?;
        self.written.push((simulation.time(), file));
        self.last = Some(step);
        Ok(())
    }

    /// Writes the `.pvd` list of the files so far, and returns its path.
    pub fn write_list(&self, simulation: &dyn Simulation) -> Result<PathBuf, MeshError> {
        let path = self.folder.join(format!("{}.pvd", simulation.name()));
        write_pvd(&path, &self.written)?;
        Ok(path)
    }

    /// Writes the last state unless it is there, and the list. Returns its path.
    pub fn finish(&mut self, simulation: &dyn Simulation) -> Result<PathBuf, MeshError> {
        if self.last != Some(simulation.steps()) {
            self.write(simulation)?;
        }
        self.write_list(simulation)
    }
}
