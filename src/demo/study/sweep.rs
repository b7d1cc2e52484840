//! `report --sweep KEY=VALUE,VALUE`: a scene with its own method for each combination of values, as a table.

use std::fmt::Write as _;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};
use std::str::FromStr;

use fem_mesh::write::save;
use fem_scene::output::write_state;
use fem_scene::simulate::{self, quantile};
use fem_scene::{Override, Scene, load_with};

use crate::demo::build::{self, Ready};
use crate::demo::data;
use crate::demo::end::End;

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

/// Columns after the scene and the keys.
const RESULTS: &str =
    "status,steps,time,median_step_seconds,newton_iterations,kinetic,potential,total,min_J,largest_displacement,state";

/// Runs every combination of values, writes `sweep.csv` and the states at the ends, and returns the path of the table.
///
/// All scenes are read before the first run, so that an error ends the sweep at once.
pub fn run(scenes: &[String], sweeps: &[Sweep], out: &Path, tell: &dyn Fn(usize, usize, &str)) -> Result<PathBuf, End> {
    let states = out.join("states");
    std::fs::create_dir_all(&states).map_err(|error| {
        End::unusable(format!("--out {}: {error}; name a folder that can be created", states.display()))
    })?;
    let mut runs: Vec<(Scene, Vec<Override>)> = Vec::new();
    for name in scenes {
        for values in combinations(sweeps) {
            runs.push((load_with(name, &data::folder(), &values).map_err(End::unusable)?, values));
        }
    }
    let keys: String = sweeps.iter().map(|sweep| format!("{},", cell(&sweep.key))).collect();
    let mut table = format!("scene,{keys}{RESULTS}\n");
    for (number, (scene, values)) in runs.iter().enumerate() {
        let names: Vec<String> = values.iter().map(Override::to_string).collect();
        tell(number, runs.len(), &format!("{} {}", scene.name, names.join(" ")));
        let state = states.join(format!("{}-{:04}.json", scene.name, number + 1));
        let values: String = names.iter().map(|name| format!("{},", cell(value_of(name)))).collect();
        // Writing to a string cannot fail.
        let _ = writeln!(table, "{},{values}{}", cell(&scene.name), row(scene, &state)?);
    }
    let file = out.join("sweep.csv");
    save(&file, |out| out.write_all(table.as_bytes())).map_err(End::unusable)?;
    Ok(file)
}

/// Every choice of one value of each key, the last key fastest.
fn combinations(sweeps: &[Sweep]) -> Vec<Vec<Override>> {
    sweeps.iter().fold(vec![Vec::new()], |combinations, sweep| {
        let with =
            |combination: &Vec<Override>, value: &Override| [&combination[..], std::slice::from_ref(value)].concat();
        combinations.iter().flat_map(|one| sweep.values.iter().map(move |value| with(one, value))).collect()
    })
}

/// Runs a scene to its end or its failure, writes its state, and returns the results.
fn row(scene: &Scene, state: &Path) -> Result<String, End> {
    let Ready { mut simulation, steps, .. } = build::build(scene)?;
    let run = simulate::run(&mut *simulation, steps, |_| Ok::<_, End>(ControlFlow::Continue(())))?;
    write_state(state, scene, &*simulation).map_err(End::unusable)?;
    let status = match (&run.failure, simulation.counters().unconverged_steps) {
        (Some(failure), _) => format!("failed: {failure}"),
        (None, 0) => "done".to_owned(),
        (None, unconverged) => format!("{unconverged} steps not converged"),
    };
    let median = quantile(&run.step_seconds, 0.5).map_or(String::new(), |seconds| format!("{seconds:.6e}"));
    let (energies, (least, _)) = (simulation.energies(), simulation.min_J());
    let (shape, q) = (simulation.shape(), simulation.positions());
    let moved = |(node, rest): (usize, &nalgebra::Vector3<f64>)| (q.fixed_rows::<3>(3 * node) - rest).norm();
    let largest = shape.mesh.vertices.iter().enumerate().map(moved).fold(0.0, f64::max);
    let name = state.file_name().unwrap_or_default().to_string_lossy().into_owned();
    Ok(format!(
        "{},{},{:.9e},{median},{},{:.9e},{:.9e},{:.9e},{least:.9e},{largest:.9e},{}",
        cell(&status),
        simulation.steps(),
        simulation.time(),
        simulation.counters().newton_iterations,
        energies.kinetic,
        energies.potential,
        energies.total(),
        cell(&name),
    ))
}

/// The value of `KEY=VALUE`.
fn value_of(text: &str) -> &str {
    text.split_once('=').map_or(text, |(_, value)| value)
}

/// A cell of a table of comma-separated values.
fn cell(text: &str) -> String {
    match text.contains([',', '"', '\n']) {
        true => format!("\"{}\"", text.replace('"', "\"\"")),
        false => text.to_owned(),
    }
}
