//! `--probe`: which nodes a run watches.

use std::path::PathBuf;
use std::str::FromStr;

use fem_model::simulation::Simulation;
use fem_model::{BodyMesh, highest_node};
use fem_output::Probe;

use crate::end::End;

/// `NODE|NAME=FILE.csv`.
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
            _ => Err("give NODE|NAME=FILE.csv, such as 7=tip.csv or highest=top.csv".to_owned()),
        }
    }
}

impl ProbeArgument {
    /// The probe of its node, or of the nodes of its set.
    pub fn probe(&self, simulation: &dyn Simulation) -> Result<Probe, End> {
        let shape = simulation.shape();
        let nodes = self
            .nodes(&shape.mesh)
            .map_err(|problem| End::unusable(format!("--probe {}={}: {problem}", self.place, self.file.display())))?;
        Ok(Probe::new(&self.file, nodes))
    }

    fn nodes(&self, mesh: &BodyMesh) -> Result<Vec<usize>, String> {
        if self.place == "highest" {
            return Ok(vec![highest_node(mesh)]);
        }
        let nodes = mesh.vertices().len();
        match (self.place.parse(), mesh.sets().get(&self.place)) {
            (Ok(node), _) if node < nodes => Ok(vec![node]),
            (_, Some(set)) => Ok(mesh.nodes_of_set(set)),
            (Ok(_), None) => Err(format!("the mesh has {nodes} nodes; give a node from 0 to {}", nodes - 1)),
            (Err(_), None) => {
                let sets: String = mesh.sets().keys().map(|name| format!(", or {name}")).collect();
                Err(format!("there is no such node or set; give the index of a node, or highest{sets}"))
            }
        }
    }
}
