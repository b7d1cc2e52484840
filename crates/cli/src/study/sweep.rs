//! `report --sweep KEY=VALUE,VALUE`: a scene with its own method for each combination of values, as a table and a page.

use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use fem_mesh::write::save_bytes;
use fem_scene::output::write_state;
use fem_scene::simulate::{self, quantile};
use fem_scene::{Override, Scene, load_with};
use fem_study::sweep::{self, SweptRun};

use crate::build::{self, Ready};
use crate::course::Course;
use crate::end::End;

/// A key of a scene and its values.
#[derive(Clone, Debug)]
pub struct Sweep {
    key: String,
    values: Vec<Override>,
}

impl FromStr for Sweep {
    type Err = String;

    /// Reads `KEY=VALUE,VALUE`. Commas within brackets belong to a value.
    fn from_str(text: &str) -> Result<Self, String> {
        let (key, list) = text.split_once('=').ok_or("give KEY=VALUE,VALUE, such as material.young=1e4,1e5")?;
        let mut depth = 0;
        let values = list.split(|c: char| {
            depth += i32::from(c == '[') - i32::from(c == ']');
            c == ',' && depth == 0
        });
        let values = values.map(|value| format!("{key}={}", value.trim()).parse()).collect::<Result<_, _>>()?;
        Ok(Self { key: key.to_owned(), values })
    }
}

/// The files of a sweep, and how its runs ended.
pub struct Swept {
    pub files: [PathBuf; 2],
    pub runs: usize,
    pub failed: usize,
}

/// Runs every combination of values, writes `sweep.csv`, `sweep.html` and the states at the ends, and tells how the runs ended. Failed
/// runs are rows as well.
///
/// All scenes are read before the first run, so that an error ends the sweep at once.
pub fn run(
    course: &Course,
    scenes: &[String],
    sweeps: &[Sweep],
    out: &Path,
    tell: &dyn Fn(usize, usize, &str),
) -> Result<Swept, End> {
    let states = out.join("states");
    std::fs::create_dir_all(&states).map_err(|error| {
        End::unusable(format!("--out {}: {error}; name a folder that can be created", states.display()))
    })?;
    let mut runs: Vec<(Scene, Vec<Override>)> = Vec::new();
    for name in scenes {
        for values in combinations(sweeps) {
            runs.push((load_with(name, &course.data(), &values).map_err(End::unusable)?, values));
        }
    }
    let mut results = Vec::new();
    for (number, (scene, values)) in runs.iter().enumerate() {
        let names: Vec<String> = values.iter().map(Override::to_string).collect();
        tell(number, runs.len(), &format!("{} {}", scene.name, names.join(" ")));
        let state = states.join(format!("{}-{:04}.json", scene.name, number + 1));
        let values = names.iter().map(|name| value_of(name).to_owned()).collect();
        results.push(result(course, scene, values, &state)?);
    }
    let keys: Vec<&str> = sweeps.iter().map(|sweep| &*sweep.key).collect();
    let table = sweep::csv(&keys, &results).map_err(|error| End::Stopped(error.to_string()))?;
    let files = [out.join("sweep.csv"), out.join("sweep.html")];
    for (file, text) in files.iter().zip([table, sweep::html_page(&keys, &results)]) {
        save_bytes(file, text.as_bytes()).map_err(End::unusable)?;
    }
    let failed = results.iter().filter(|run| !run.is_done()).count();
    Ok(Swept { files, runs: results.len(), failed })
}

/// Every choice of one value of each key, the last key fastest.
fn combinations(sweeps: &[Sweep]) -> Vec<Vec<Override>> {
    sweeps.iter().fold(vec![Vec::new()], |combinations, sweep| {
        let with =
            |combination: &Vec<Override>, value: &Override| [&combination[..], std::slice::from_ref(value)].concat();
        combinations.iter().flat_map(|one| sweep.values.iter().map(move |value| with(one, value))).collect()
    })
}

/// Runs a scene to its end or its failure, and writes its state.
fn result(course: &Course, scene: &Scene, values: Vec<String>, state: &Path) -> Result<SweptRun, End> {
    let Ready { mut simulation, steps, .. } = build::build(course, scene)?;
    let run = simulate::run(&mut *simulation, steps, |_| Ok::<_, End>(ControlFlow::Continue(())))?;
    write_state(state, scene, &*simulation).map_err(End::unusable)?;
    let status = match (&run.failure, simulation.counters().unconverged_steps) {
        (Some(failure), _) => format!("failed: {failure}"),
        (None, 0) => "done".to_owned(),
        (None, unconverged) => format!("{unconverged} steps not converged"),
    };
    let (energies, (least, _)) = (simulation.energies(), simulation.min_J());
    let (shape, q) = (simulation.shape(), simulation.positions());
    let moved = |(node, rest): (usize, &nalgebra::Vector3<f64>)| (q.fixed_rows::<3>(3 * node) - rest).norm();
    Ok(SweptRun {
        scene: scene.name.clone(),
        values,
        status,
        steps: simulation.steps(),
        time: simulation.time(),
        median_step_seconds: quantile(&run.step_seconds, 0.5),
        newton_iterations: simulation.counters().newton_iterations,
        energies: [energies.kinetic, energies.potential],
        min_J: least,
        largest_displacement: shape.mesh.vertices().iter().enumerate().map(moved).fold(0.0, f64::max),
        state: state.file_name().unwrap_or_default().to_string_lossy().into_owned(),
    })
}

/// The value of `KEY=VALUE`.
fn value_of(text: &str) -> &str {
    text.split_once('=').map_or(text, |(_, value)| value)
}
