//! Probes: position, velocity and force of some nodes over time.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use nalgebra::DVector;

use super::write_text;
use crate::simulation::Simulation;
use fem_mesh::MeshError;

/// A table `time,x,y,z,vx,vy,vz,fx,fy,fz` with a row for the first state and for each step, in s, m, m/s and N.
#[derive(Clone, Debug)]
pub struct Probe {
    file: PathBuf,
    nodes: Vec<usize>,
    text: String,
}

impl Probe {
    /// A probe of the nodes, of which there is at least one.
    pub fn new(file: &Path, nodes: Vec<usize>) -> Self {
        Self { file: file.to_owned(), nodes, text: "time,x,y,z,vx,vy,vz,fx,fy,fz\n".to_owned() }
    }

    /// Adds a row: the mean position and velocity of the nodes, and the sum of the [forces](Simulation::nodal_forces) on them; NaN
    /// for a pipeline that does not compute these.
    pub fn add(&mut self, simulation: &dyn Simulation) {
        let (q, v) = (simulation.positions(), simulation.velocities());
        let f = simulation.nodal_forces().unwrap_or_else(|| DVector::from_element(q.len(), f64::NAN));
        let sum = |list: &[f64], i: usize| self.nodes.iter().map(|node| list[3 * node + i]).sum::<f64>();
        let mean = |list: &[f64], i: usize| sum(list, i) / self.nodes.len() as f64;
        // Writing to a string cannot fail.
        let _ = write!(self.text, "{:.9e}", simulation.time());
        for i in 0..9 {
            let value = match i / 3 {
                0 => mean(q.as_slice(), i % 3),
                1 => mean(v.as_slice(), i % 3),
                _ => sum(f.as_slice(), i % 3),
            };
            let _ = write!(self.text, ",{value:.16e}");
        }
        self.text.push('\n');
    }

    /// Writes the rows so far.
    pub fn write(&self) -> Result<(), MeshError> {
        write_text(&self.file, &self.text)
    }
}
