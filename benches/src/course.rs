//! The course's pipeline on its own scenes.

use std::path::Path;

use fem_scene::Override;
use fem_study::machine::{self, Machine};

use crate::cli::{CourseArguments, RunArguments};
use crate::end::End;
use crate::run;

/// Scenes with the keys that are replaced.
const RUNS: [(&str, &[&str]); 3] = [
    ("arma", &["drag.in_stiffness=true"]),
    ("arma", &["drag.in_stiffness=true", "time.integrator=linearly_implicit_euler"]),
    ("bunny", &[]),
];

/// Runs each scene and prints a table.
pub fn run(arguments: &CourseArguments) -> Result<(), End> {
    println!("{}\n", Machine::this(Path::new(".")).line());
    println!("| scene | nodes | integrator | steps | ms per step (median) |\n|---|---:|---|---:|---:|");
    for (name, keys) in RUNS {
        let overrides: Result<Vec<Override>, String> = keys.iter().map(|key| key.parse()).collect();
        let scene = RunArguments {
            scene: name.to_owned(),
            steps: Some(arguments.steps),
            cells: None,
            solver: None,
            overrides: overrides.map_err(End::wrong)?,
            data: arguments.data.clone(),
        };
        let integrator = scene.scene().map_err(End::unusable)?.time.integrator.name();
        let found = run::apart(&scene, machine::threads())?;
        let milliseconds = 1e3 * found.wall_per_step_median;
        println!("| `{name}` | {} | `{integrator}` | {} | {milliseconds:.3} |", found.nodes, found.steps);
    }
    Ok(())
}
