//! The peer in C++ with Eigen, `a3`: it reads the scene from options, prints its times and writes its answer.

use std::path::{Path, PathBuf};
use std::process::Command;

use fem_model::{Axis, Law};
use fem_scene::Scene;
use fem_scene::tables::DragVertex;

use crate::end::End;
use crate::race::Time;
use crate::run::output_of;

/// Newton iterations and unbalanced momentum (kg m/s) of an answer to compare with.
const CONVERGED: [&str; 4] = ["--newton", "200", "--tol", "1e-10"];

/// The program and the options of a scene.
pub struct Eigen {
    program: PathBuf,
    options: Vec<String>,
}

impl Eigen {
    /// Refuses scenes that the program does not support.
    pub fn new(program: &Path, scene: &Scene, data: &Path, steps: usize) -> Result<Self, End> {
        let refuse = || End::unusable(format!("{}: a3 does not support this scene", scene.name));
        let mut options = body(scene, data).ok_or_else(refuse)?;
        options.extend(loads(scene).ok_or_else(refuse)?);
        options.extend(pair("--dt", scene.time.dt()));
        options.extend(["--steps".to_owned(), steps.to_string()]);
        Ok(Self { program: program.to_owned(), options })
    }

    /// Seconds per step: by the wall in one run, by its main thread's processor time in another.
    pub fn time(&self, is_expert: bool, threads: usize) -> Result<Time, End> {
        let mode: &[&str] = if is_expert { &["--mode", "expert", "--proj", "auto"] } else { &["--mode", "naive"] };
        let by = |clock: &str| {
            let mut command = self.command();
            command.args(mode).args(["--threads", &threads.to_string(), "--clock", clock]);
            seconds_per_step(&output_of(&mut command)?)
        };
        Ok(Time { wall: by("wall")?, cpu: by("cpu")? })
    }

    /// Converged positions of all nodes at the end, m.
    pub fn converged(&self) -> Result<Vec<f64>, End> {
        let name = format!("fem-bench-{}.txt", std::process::id());
        let path = std::env::temp_dir().join(name);
        let run = output_of(
            self.command().args(["--mode", "expert", "--proj", "auto"]).args(CONVERGED).arg("--out").arg(&path),
        );
        let text = run.and_then(|_| std::fs::read_to_string(&path).map_err(End::wrong));
        if path.exists() {
            std::fs::remove_file(&path).map_err(End::wrong)?;
        }
        let numbers: Result<Vec<f64>, _> = text?.lines().map(str::parse).collect();
        numbers.map_err(|error| End::wrong(format!("a3 wrote an invalid number: {error}")))
    }

    /// Waiting threads must not use the processor.
    fn command(&self) -> Command {
        let mut command = Command::new(&self.program);
        command.env("OMP_WAIT_POLICY", "passive").args(&self.options);
        command
    }
}

fn pair(name: &str, value: f64) -> [String; 2] {
    [name.to_owned(), format!("{value:?}")]
}

/// Mesh and material. The program reads E and ν, from which it computes C = μ/2 and D = λ/2.
fn body(scene: &Scene, data: &Path) -> Option<Vec<String>> {
    let node = data.join(scene.mesh.file.as_ref()?);
    let is_whole = scene.mesh.scale == 1.0 && scene.mesh.refine == 0 && scene.mass.lumped != Some(true);
    let Law::NeoHookean(law) = scene.material.value().law else { return None };
    if !is_whole {
        return None;
    }
    let [C, D] = law.moduli();
    let (mu, lambda) = (2.0 * C, 2.0 * D);
    let young = mu * (3.0 * lambda + 2.0 * mu) / (lambda + mu);
    let poisson = lambda / (2.0 * (lambda + mu));
    let path = |path: &Path| path.to_string_lossy().into_owned();
    let mut options = vec!["--node".to_owned(), path(&node), "--ele".to_owned(), path(&node.with_extension("ele"))];
    for (name, value) in [("--ym", young), ("--nu", poisson), ("--rho", scene.material.density)] {
        options.extend(pair(name, value));
    }
    Some(options)
}

/// Gravity along y, fixed feet, and a drag along x at the highest vertex.
fn loads(scene: &Scene) -> Option<Vec<String>> {
    let gravity = scene.gravity.as_ref().map_or([0.0; 3], |gravity| gravity.acceleration);
    let feet = scene.fixed.as_ref()?.plane.as_ref()?;
    let drag = scene.drag.as_ref()?;
    let is_known = gravity[0] == 0.0
        && gravity[2] == 0.0
        && feet.axis == Axis::Y
        && drag.direction == [1.0, 0.0, 0.0]
        && drag.vertex == DragVertex::Highest;
    let pairs = [
        ("--gravity", gravity[1]),
        ("--pintol", feet.below),
        ("--k", drag.stiffness),
        ("--amp", drag.amplitude),
        ("--freq", drag.frequency),
    ];
    is_known.then(|| pairs.into_iter().flat_map(|(name, value)| pair(name, value)).collect())
}

/// The number after `s/step mean`.
fn seconds_per_step(printed: &str) -> Result<f64, End> {
    let mut words = printed.split_whitespace().skip_while(|word| *word != "mean");
    let seconds = words.nth(1).and_then(|word| word.parse().ok());
    seconds.ok_or_else(|| End::wrong(format!("a3 printed no time per step: {printed}")))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_time_per_step_is_found_in_what_is_printed() {
        let printed = "# arma: 3 nodes\nmode naive steps 2: s/step mean 0.012500 median 0.012000  assembly 0.1\n";
        assert_eq!(seconds_per_step(printed).unwrap(), 0.0125);
        assert!(seconds_per_step("nothing").is_err());
    }
}
