//! Probes: position, velocity and force of some nodes over time.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use fem_mesh::MeshError;
use fem_mesh::write::save_bytes;
use fem_model::simulation::Simulation;

/// A table `time,x,y,z,vx,vy,vz,fx,fy,fz` with a row for the first state and for each step, in s, m, m/s and N; in equilibrium with the
/// column `load_factor` as well.
#[derive(Clone, Debug)]
pub struct Probe {
    file: PathBuf,
    nodes: Vec<usize>,
    text: String,
}

impl Probe {
    /// A probe of the nodes, of which there is at least one.
    pub fn new(file: &Path, nodes: Vec<usize>) -> Self {
        Self { file: file.to_owned(), nodes, text: String::new() }
    }

    /// Adds a row: the mean position and velocity of the nodes, and the sum of the [forces](Simulation::nodal_forces) on them,
    /// without numbers if the pipeline does not compute these.
    pub fn add(&mut self, simulation: &dyn Simulation) {
        let (q, v) = (simulation.positions(), simulation.velocities());
        let f = simulation.nodal_forces();
        let load_factor = simulation.load_factor();
        if self.text.is_empty() {
            let last = if load_factor.is_some() { ",load_factor\n" } else { "\n" };
            self.text = format!("time,x,y,z,vx,vy,vz,fx,fy,fz{last}");
        }
        let sum = |list: &[f64], i: usize| self.nodes.iter().map(|node| list[3 * node + i]).sum::<f64>();
        let mean = |list: &[f64], i: usize| sum(list, i) / self.nodes.len() as f64;
        // Writing to a string cannot fail.
        let _ = write!(self.text, "{:.9e}", simulation.time());
        for value in (0..3).map(|i| mean(q.as_slice(), i)).chain((0..3).map(|i| mean(v.as_slice(), i))) {
            let _ = write!(self.text, ",{value:.16e}");
        }
        for i in 0..3 {
            let _ = match &f {
                Some(f) => write!(self.text, ",{:.16e}", sum(f.as_slice(), i)),
                None => write!(self.text, ","),
            };
        }
        if let Some(load_factor) = load_factor {
            let _ = write!(self.text, ",{load_factor:.16e}");
        }
        self.text.push('\n');
    }

    /// Writes the rows so far.
    pub fn write(&self) -> Result<(), MeshError> {
        save_bytes(&self.file, self.text.as_bytes())
    }
}
