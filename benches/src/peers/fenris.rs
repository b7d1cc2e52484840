//! The peer in Rust with fenris: one beam, with the cells per metre and the number of steps as arguments.

use std::path::{Path, PathBuf};
use std::process::Command;

use fem_model::{Axis, Law};
use fem_scene::Scene;
use serde::Deserialize;

use crate::end::End;
use crate::race::Time;
use crate::run::output_of;

/// The program and its beam.
pub struct Fenris {
    program: PathBuf,
    cells: usize,
    steps: usize,
}

/// The used part of the program's output.
#[derive(Debug, Deserialize)]
struct Printed {
    tip_centre_x: [f64; 3],
    tip_corner_x: [f64; 3],
    wall_per_step: f64,
    cpu_per_step: f64,
}

impl Fenris {
    /// Refuses all scenes but the beam of the program.
    pub fn new(program: &Path, scene: &Scene, cells: usize, steps: usize) -> Result<Self, End> {
        if !is_its_beam(scene) {
            return Err(End::unusable(format!("{}: not the beam that fenris_peer is written for", scene.name)));
        }
        Ok(Self { program: program.to_owned(), cells, steps })
    }

    /// Seconds per step, and where the centre and the corner of the tip are at the end, m.
    pub fn time(&self) -> Result<(Time, Vec<f64>), End> {
        let mut command = Command::new(&self.program);
        command.arg("C").arg(self.cells.to_string()).arg(self.steps.to_string());
        let printed: Printed = serde_json::from_str(&output_of(&mut command)?)
            .map_err(|error| End::wrong(format!("fenris_peer printed no answer: {error}")))?;
        let time = Time { wall: printed.wall_per_step, cpu: printed.cpu_per_step };
        Ok((time, [printed.tip_centre_x, printed.tip_corner_x].concat()))
    }
}

/// The beam, the material, the weight and the time step of the program's case C.
fn is_its_beam(scene: &Scene) -> bool {
    let box_size = scene.mesh.cuboid.as_ref().map(|cuboid| cuboid.size);
    let clamp = scene.fixed.as_ref().and_then(|fixed| fixed.plane.as_ref());
    box_size == Some([4.0, 1.0, 1.0])
        && matches!(scene.material.value().law, Law::NeoHookean(law) if law.moduli() == [2e5, 1e6])
        && scene.material.density == 1000.0
        && scene.gravity.as_ref().is_some_and(|gravity| gravity.acceleration == [0.0, 0.0, -9.81])
        && clamp.is_some_and(|plane| plane.axis == Axis::X && plane.below < 1e-6)
        && scene.drag.is_none()
        && scene.time.dt() == 0.01
}

/// The nodes in the middle and at the upper corner of the face where x is largest.
pub fn tip_nodes(cells: usize) -> [usize; 2] {
    let node = |j: usize, k: usize| 4 * cells + (4 * cells + 1) * (j + (cells + 1) * k);
    [node(cells / 2, cells / 2), node(cells, cells)]
}
