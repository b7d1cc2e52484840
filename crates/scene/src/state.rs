//! State files: what a program needs to look at a state, and what a run needs to go on from it.

use std::io::{self, Write};
use std::path::{Path, PathBuf};

use serde::Deserialize;
use thiserror::Error;

use crate::Scene;
use crate::identity::Identity;
use fem_mesh::MeshError;
use fem_mesh::write::save;
use fem_model::simulation::{Checkpoint, History, Simulation};

/// Largest number of steps of a state: more take longer than any computer lasts, and counters go on from it.
const MOST_STEPS: usize = 1 << 53;

/// A state file as it is read.
#[derive(Deserialize)]
#[serde(deny_unknown_fields)]
struct StateFile {
    time: f64,
    q: Vec<f64>,
    qdot: Vec<f64>,
    steps: usize,
    displacements: Vec<f64>,
    scene: Identity,
    history: History,
}

/// A state file from which a run cannot go on.
#[derive(Debug, Error)]
#[allow(missing_docs)] // the messages are the documentation of the fields
pub enum ResumeError {
    /// It cannot be read.
    #[error("{}: cannot be read: {error}; check the path and that you may read it", file.display())]
    Unreadable { file: PathBuf, error: io::Error },
    /// It is no state file, or one of an earlier version.
    #[error("{}: {error}; give a file that --state or --checkpoint of this version has written", file.display())]
    Malformed { file: PathBuf, error: serde_json::Error },
    /// It belongs to another scene.
    #[error("{}: is a state of another scene: {difference}; resume with the scene and the options of the first run", file.display())]
    OtherScene { file: PathBuf, difference: String },
    /// Its numbers do not fit the simulation.
    #[error("{}: {problem}; give a file that --state or --checkpoint of this scene has written", file.display())]
    Unfit { file: PathBuf, problem: String },
}

/// Writes `{"time", "q", "qdot"}` of all nodes with 17 significant digits, enough for an exact round trip, and what [`resume`] needs.
pub fn write_state(path: &Path, scene: &Scene, simulation: &dyn Simulation) -> Result<(), MeshError> {
    let Checkpoint { time, steps, positions, velocities, displacements, history } = simulation.checkpoint();
    let json = |error: serde_json::Error| io::Error::other(error);
    save(path, &mut |out| {
        write!(out, "{{\n\"time\": {time:.16e}")?;
        for (name, list) in [("q", &positions), ("qdot", &velocities), ("displacements", &displacements)] {
            write!(out, ",\n\"{name}\": [")?;
            write_list(out, list)?;
            write!(out, "]")?;
        }
        write!(out, ",\n\"steps\": {steps},\n\"scene\": ")?;
        serde_json::to_writer(&mut *out, &Identity::of(scene, simulation)).map_err(json)?;
        write!(out, ",\n\"history\": ")?;
        serde_json::to_writer(&mut *out, &history).map_err(json)?;
        out.write_all(b"\n}\n")
    })
}

/// Numbers with 17 significant digits.
pub(crate) fn write_list(out: &mut dyn Write, list: &[f64]) -> io::Result<()> {
    for (number, value) in list.iter().enumerate() {
        let comma = if number == 0 { "" } else { ", " };
        write!(out, "{comma}{value:.16e}")?;
    }
    Ok(())
}

/// Continues from a state that [`write_state`] has written for the same scene, so that the run goes on as if it had not been
/// interrupted. After an error the simulation is in its initial state.
pub fn resume(path: &Path, scene: &Scene, simulation: &mut dyn Simulation) -> Result<(), ResumeError> {
    let file = || path.to_owned();
    let text = std::fs::read_to_string(path).map_err(|error| ResumeError::Unreadable { file: file(), error })?;
    let read: Result<StateFile, _> = serde_json::from_str(&text);
    let state = read.map_err(|error| ResumeError::Malformed { file: file(), error })?;
    if let Some(difference) = state.scene.difference(&Identity::of(scene, simulation)) {
        return Err(ResumeError::OtherScene { file: file(), difference });
    }
    let StateFile { time, q, qdot, steps, displacements, history, .. } = state;
    if steps > MOST_STEPS {
        let problem = format!("its `steps` is {steps}, and {MOST_STEPS} is the most");
        return Err(ResumeError::Unfit { file: file(), problem });
    }
    let checkpoint = Checkpoint { time, steps, positions: q, velocities: qdot, displacements, history };
    simulation.restore(&checkpoint).map_err(|problem| ResumeError::Unfit { file: file(), problem })
}
