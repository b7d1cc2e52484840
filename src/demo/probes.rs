//! `--probe`: which nodes a run watches.

use std::path::PathBuf;
use std::str::FromStr;

use fem_scene::highest_node;
use fem_scene::output::Probe;
use fem_scene::simulation::Simulation;

use super::end::End;

/// `NODE=FILE.csv`.
#[derive(Clone, Debug)]
pub struct ProbeArgument {
    place: String,
    pub file: PathBuf,
}

impl FromStr for ProbeArgument {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        match text.split_once('=') {
            Some((place, file)) if !place.is_empty() && !file.is_empty() => {
                Ok(Self { place: place.to_owned(), file: PathBuf::from(file) })
            }
            _ => Err("give NODE=FILE.csv, such as 7=tip.csv or highest=top.csv".to_owned()),
        }
    }
}

impl ProbeArgument {
    /// The probe of its node.
    pub fn probe(&self, simulation: &dyn Simulation) -> Result<Probe, End> {
        Ok(Probe::new(&self.file, vec![self.node(simulation)?]))
    }

    fn node(&self, simulation: &dyn Simulation) -> Result<usize, End> {
        let shape = simulation.shape();
        let nodes = shape.mesh.vertices.len();
        if self.place == "highest" {
            return Ok(highest_node(&shape.mesh));
        }
        let place = &self.place;
        match place.parse() {
            Ok(node) if node < nodes => Ok(node),
            Ok(_) => Err(End::unusable(format!(
                "--probe {place}={}: the mesh has {nodes} nodes; give a node from 0 to {}",
                self.file.display(),
                nodes - 1
            ))),
            Err(_) => Err(End::unusable(format!(
                "--probe {place}={}: there is no node `{place}`; give the index of a node, or highest",
                self.file.display()
            ))),
        }
    }
}
