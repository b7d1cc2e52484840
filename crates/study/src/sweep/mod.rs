//! Scenes with several values of their keys: a table of runs, each with its own method, that a flag of the program or a file describes.

mod file;
mod page;

use std::fs;
use std::io;
use std::ops::ControlFlow;
use std::path::{Path, PathBuf};

use fem_mesh::write::save_bytes;
use fem_model::BodyMesh;
use fem_model::simulation::Simulation;
use fem_output::{Run, quantile};
use fem_scene::Scene;
use fem_scene::write_state;
use nalgebra::{DVector, Vector3};
use serde::{Deserialize, Serialize};

pub use file::read;

use crate::runs::measure::Factory;
use crate::study::{Case, Finished, Found, Study};
use fem_reference::space::{closed_forms, norms};

/// A scene with the values of the keys of a study.
#[derive(Clone, Debug)]
pub struct SweptScene {
    /// The name of the case; empty if its values are enough.
    pub case: String,
    /// The scene.
    pub scene: Scene,
    /// The value of each key, as it was written.
    pub values: Vec<String>,
    /// The scene whose end is the reference.
    pub reference: Option<Scene>,
    /// What the measured quantity must be; `None` if it is not judged.
    pub expected: Option<f64>,
}

/// A quantity and how it is judged.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Measure {
    /// The name of a result.
    pub quantity: String,
    /// Largest error: relative to what is expected, or absolute if that is zero.
    pub tolerance: f64,
}

/// The study of such scenes.
pub struct Sweep<'a> {
    /// Name of its files, without ending.
    pub name: String,
    /// Title of the page.
    pub title: String,
    /// The first paragraph of the page.
    pub about: String,
    /// The keys whose values differ.
    pub keys: Vec<String>,
    /// The scenes, in the order of the rows.
    pub scenes: Vec<SweptScene>,
    /// The quantity of the study; `None` if rows are not judged.
    pub measure: Option<Measure>,
    /// The arguments of the program that name the study.
    pub arguments: Vec<String>,
    /// Folder of the results.
    pub out: PathBuf,
    /// Builds simulations of both pipelines.
    pub factory: &'a Factory<'a>,
}

/// A run.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct SweptRun {
    /// Name of the scene.
    pub scene: String,
    /// The name of the case; empty if its values are enough.
    pub case: String,
    /// The value of each key, as it was written.
    pub values: Vec<String>,
    /// `done`, or the reason why the result is not to be trusted.
    pub status: String,
    /// Number of steps.
    pub steps: usize,
    /// Time at their end, s.
    pub time: f64,
    /// Median wall time of a step, s; `None` without steps.
    pub median_step_seconds: Option<f64>,
    /// Iterations of Newton's method.
    pub newton_iterations: usize,
    /// Kinetic and potential energy, J.
    pub energies: [Option<f64>; 2],
    /// Minimum of det F.
    pub min_J: Option<f64>,
    /// Largest displacement of a node, m.
    pub largest_displacement: Option<f64>,
    /// Distance from the scene's closed form, relative; `None` without one.
    pub closed_form: Option<f64>,
    /// Root mean square distance from the end of the reference over the body's length.
    pub distance: Option<f64>,
    /// What the quantity of the study must be.
    pub expected: Option<f64>,
    /// True if it is so; `None` if it is not judged.
    pub holds: Option<bool>,
    /// File name of the state at the end.
    pub state: String,
}

/// A result: its name in tables and files, and its value.
type Quantity = (&'static str, fn(&SweptRun) -> Option<f64>);

/// The results of a run that a study can judge.
pub const QUANTITIES: [Quantity; 10] = [
    ("steps", |run| Some(run.steps as f64)),
    ("time", |run| Some(run.time)),
    ("median_step_seconds", |run| run.median_step_seconds),
    ("newton_iterations", |run| Some(run.newton_iterations as f64)),
    ("kinetic", |run| run.energies[0]),
    ("potential", |run| run.energies[1]),
    ("total", SweptRun::total),
    ("min_J", |run| run.min_J),
    ("largest_displacement", |run| run.largest_displacement),
    ("closed_form", |run| run.closed_form),
];

/// The quantity that is a distance from a reference run.
pub const DISTANCE: Quantity = ("distance", |run| run.distance);

fn quantity(name: &str) -> Option<fn(&SweptRun) -> Option<f64>> {
    QUANTITIES.iter().chain([&DISTANCE]).find(|(known, _)| *known == name).map(|(_, value)| *value)
}

impl SweptRun {
    /// Returns true if the run reached its end and converged.
    pub fn is_done(&self) -> bool {
        self.status == "done"
    }

    /// Kinetic and potential energy, J.
    pub fn total(&self) -> Option<f64> {
        Some(self.energies[0]? + self.energies[1]?)
    }
}

impl Study for Sweep<'_> {
    type Row = SweptRun;

    fn arguments(&self) -> Vec<String> {
        self.arguments.clone()
    }

    fn cases(&self) -> Vec<Case<'_, SweptRun>> {
        let case = |(number, swept): (usize, &'_ SweptScene)| {
            let values: Vec<String> = self.keys.iter().zip(&swept.values).map(|(k, v)| format!("{k}={v}")).collect();
            let name = [swept.scene.name.clone(), swept.case.clone(), values.join(" ")].join(" ");
            (number, name.split_whitespace().collect::<Vec<_>>().join(" "))
        };
        let named = self.scenes.iter().enumerate().map(case);
        named
            .zip(&self.scenes)
            .map(|((number, name), swept)| Case::new(name, move || self.run(number, swept)))
            .collect()
    }

    fn remark(&self, run: &SweptRun) -> Option<String> {
        let name = || format!("{} {} {}", run.scene, run.case, run.values.join(" "));
        (run.holds == Some(false)).then(|| format!("{}: not as expected", name().trim()))
    }

    /// Writes the table and the page.
    fn finish(&self, found: Found<SweptRun>, out: &Path) -> io::Result<Finished> {
        let Found { rows, machine, .. } = found;
        let files = ["csv", "html"].map(|ending| out.join(format!("{}.{ending}", self.name)));
        for (file, text) in files.iter().zip([page::csv(self, &rows)?, page::html_page(self, &rows, &machine)]) {
            save_bytes(file, text.as_bytes()).map_err(io::Error::other)?;
        }
        let lines = files.map(|file| file.display().to_string()).into();
        Ok(Finished { lines, failed: self.failed(&rows) })
    }
}

impl Sweep<'_> {
    /// What is wrong with the rows.
    fn failed(&self, rows: &[SweptRun]) -> Option<String> {
        let ended_early = rows.iter().filter(|run| !run.is_done()).count();
        let wrong = rows.iter().filter(|run| run.is_done() && run.holds == Some(false)).count();
        let (all, name) = (rows.len(), &self.name);
        let early = format!(
            "{ended_early} of {all} runs failed or did not converge; the column `status` of {name}.csv tells why"
        );
        let wrong_rows =
            format!("{wrong} of {all} rows are not as expected; the column `holds` of {name}.csv tells which");
        match (ended_early, wrong) {
            (0, 0) => None,
            (_, 0) => Some(early),
            (0, _) => Some(wrong_rows),
            _ => Some(format!("{early}; {wrong_rows}")),
        }
    }

    /// Runs a scene to its end or its failure, and writes its state.
    fn run(&self, number: usize, swept: &SweptScene) -> SweptRun {
        let scene = &swept.scene;
        let begun = SweptRun {
            scene: scene.name.clone(),
            case: swept.case.clone(),
            values: swept.values.clone(),
            expected: swept.expected,
            holds: swept.expected.map(|_| false),
            ..SweptRun::default()
        };
        let status = |problem: String| SweptRun { status: format!("failed: {problem}"), ..begun.clone() };
        let mut simulation = match (self.factory)(scene) {
            Ok(simulation) => simulation,
            Err(problem) => return status(problem),
        };
        let run = stepped(scene, &mut *simulation);
        let state = format!("{}-{:04}.json", scene.name, number + 1);
        let folder = self.out.join("states");
        let written = fs::create_dir_all(&folder).map_err(|error| format!("{}: {error}", folder.display()));
        let written = written
            .and_then(|()| write_state(&folder.join(&state), scene, &*simulation).map_err(|error| error.to_string()));
        let found = SweptRun { state, ..figures(&begun, scene, &*simulation, &run) };
        match written.and_then(|()| self.distance(swept, &*simulation)) {
            Ok(distance) => self.judged(SweptRun { distance, ..found }),
            Err(problem) => SweptRun { status: format!("failed: {problem}"), ..found },
        }
    }

    /// Distance from the end of the reference, which runs here.
    fn distance(&self, swept: &SweptScene, simulation: &dyn Simulation) -> Result<Option<f64>, String> {
        let Some(scene) = &swept.reference else { return Ok(None) };
        let mut reference = (self.factory)(scene).map_err(|problem| format!("the reference: {problem}"))?;
        if let Some(failure) = stepped(scene, &mut *reference).failure {
            return Err(format!("the reference: {failure}"));
        }
        let mesh: &BodyMesh = &simulation.shape().mesh;
        let [q, exact]: [DVector<f64>; 2] = [simulation.positions(), reference.positions()];
        if q.len() != exact.len() {
            return Err("the reference has another mesh; give `reference` keys of other tables than `mesh`".to_owned());
        }
        Ok(finite(norms::l2(&norms::weights(mesh), q.as_slice(), exact.as_slice()) / norms::length(mesh)))
    }

    fn judged(&self, run: SweptRun) -> SweptRun {
        let (Some(measure), Some(expected)) = (&self.measure, run.expected) else { return run };
        let found = quantity(&measure.quantity).and_then(|value| value(&run));
        let scale = if expected == 0.0 { 1.0 } else { expected.abs() };
        let holds = run.is_done() && found.is_some_and(|found| (found - expected).abs() <= measure.tolerance * scale);
        SweptRun { holds: Some(holds), ..run }
    }
}

/// Every choice of one value of each list, the last list fastest.
pub fn combinations<T: Clone>(lists: &[&[T]]) -> Vec<Vec<T>> {
    lists.iter().fold(vec![Vec::new()], |known, list| {
        let with = |one: &Vec<T>, value: &T| [&one[..], std::slice::from_ref(value)].concat();
        known.iter().flat_map(|one| list.iter().map(move |value| with(one, value))).collect()
    })
}

fn finite(x: f64) -> Option<f64> {
    Some(x).filter(|x| x.is_finite())
}

/// Takes all steps of a scene, up to a failure.
fn stepped(scene: &Scene, simulation: &mut dyn Simulation) -> Run {
    let run =
        fem_output::run(simulation, scene.steps(), |_| Ok::<_, std::convert::Infallible>(ControlFlow::Continue(())));
    run.unwrap_or_default()
}

fn figures(begun: &SweptRun, scene: &Scene, simulation: &dyn Simulation, run: &Run) -> SweptRun {
    let status = match (&run.failure, simulation.counters().unconverged_steps) {
        (Some(failure), _) => format!("failed: {failure}"),
        (None, 0) => simulation.failure_at_end().map_or("done".to_owned(), |failure| format!("failed: {failure}")),
        (None, unconverged) => format!("{unconverged} steps not converged"),
    };
    let (energies, (least, _)) = (simulation.energies(), simulation.min_J());
    let (shape, q) = (simulation.shape(), simulation.positions());
    let moved = |(node, rest): (usize, &Vector3<f64>)| (q.fixed_rows::<3>(3 * node) - rest).norm();
    SweptRun {
        status,
        steps: simulation.steps(),
        time: simulation.time(),
        median_step_seconds: quantile(&run.step_seconds, 0.5),
        newton_iterations: simulation.counters().newton_iterations,
        energies: [energies.kinetic, energies.potential].map(finite),
        min_J: finite(least),
        largest_displacement: finite(shape.mesh.vertices().iter().enumerate().map(moved).fold(0.0, f64::max)),
        closed_form: closed_forms::error(scene, simulation).filter(|_| run.failure.is_none()).and_then(finite),
        ..begun.clone()
    }
}
