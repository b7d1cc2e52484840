//! The study of one scene: references, runs, times, Pareto front.

mod levels;
mod meshes;

use std::collections::HashMap;

use super::Settings;
use crate::runs::costs::Costs;
use crate::runs::measure::{RunResult, Timing, TimingPlan, first, quartiles};
use crate::runs::pareto::{Contender, standings};
use crate::runs::plan::{self, Extent, Ladder, PlannedRun};
use crate::runs::row::{Row, Times};
use crate::study::Result;
use fem_model::Integrator;
use fem_output::quantile;
use fem_reference::space::nested::RichardsonEstimate;
use fem_scene::Scene;
use meshes::StudyMeshes;
use serde::{Deserialize, Serialize};

/// The results of one scene.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub struct SceneStudy {
    /// Name of the scene.
    pub name: String,
    /// Description in the scene file.
    pub about: String,
    /// Simulated time, s; 0 for a static scene.
    pub horizon: f64,
    /// Nodes and elements of the scene's own mesh.
    pub size: (usize, usize),
    /// Highest natural frequency, 1/s.
    pub fastest: f64,
    /// Rows of all runs.
    pub rows: Vec<Row>,
    /// Samples of each row: time, s, and change of the total energy, J.
    pub histories: Vec<Vec<(f64, f64)>>,
    /// References: file, self-checks of displacements and velocities, force evaluations.
    pub references: Vec<(String, (f64, f64), usize)>,
    /// Larger of kinetic and potential energy at the end, J.
    pub energy_scale: f64,
    /// Errors in space.
    pub richardson: Option<RichardsonEstimate>,
    /// Costs of the parts of a step.
    pub costs: Option<Costs>,
    /// Runs that were left out, with the reasons.
    pub left_out: Vec<(String, String)>,
}

/// Largest processor time of a run, s. The runs of the short study are short, and a test compares all of them with a table.
fn most_seconds(is_quick: bool) -> f64 {
    if is_quick { 60.0 } else { 4.0 }
}

/// Largest wall-clock time of a run, relative to that.
const WALL_CLOCK_FACTOR: f64 = 8.0;

/// The question that the runs answer.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Question {
    /// Which method for which error?
    Choice,
    /// Which order of convergence does each integrator have?
    Order,
}

/// Studies a scene.
pub fn study(settings: &Settings, scene: &Scene, question: Question) -> Result<SceneStudy> {
    super::make_folders(&settings.out)?;
    let base = plan::base(scene, settings.is_quick);
    let own_steps = base.time.steps.unwrap_or(50);
    let is_short = settings.is_quick && question == Question::Choice;
    let steps = if is_short { own_steps.min(10) } else { own_steps };
    let mut study = SceneStudy { name: scene.name.clone(), about: scene.about.clone(), ..SceneStudy::default() };
    let is_static = base.time.integrator == Integrator::Static;
    study.horizon = if is_static { 0.0 } else { base.time.dt() * steps as f64 };
    (settings.tell)(0, 1, &format!("{}: reference", study.name));
    let mut bodies = StudyMeshes { settings, scene: &base, known: HashMap::new() };
    bodies.add(&base, (!is_static).then_some(study.horizon), &mut study)?;
    let extent = Extent { is_quick: settings.is_quick, horizon: study.horizon, steps, fastest: study.fastest };
    let ladders = match question {
        Question::Order => plan::orders(&base, extent),
        Question::Choice if is_static => {
            plan::equilibrium(&base, base.statics.as_ref().map_or(1, |statics| statics.load_steps))
        }
        Question::Choice => plan::dynamic(&base, extent),
    };
    if question == Question::Choice {
        study.richardson = bodies.nested(&base, &mut study)?;
    }
    let done = first_runs(settings, &mut bodies, ladders, &mut study)?;
    take_times(settings, &done, &mut study);
    stand(&mut study.rows);
    Ok(study)
}

/// Times all completed runs. Failed runs keep the times of their first run.
fn take_times(settings: &Settings, done: &[(PlannedRun, RunResult)], study: &mut SceneStudy) {
    let patience = TimingPlan::new(settings.is_quick);
    let ended = |place: &usize| done[*place].1.failure.is_none();
    let places: Vec<usize> = (0..done.len()).filter(ended).collect();
    let runs: Vec<_> = places.iter().map(|&place| (&done[place].0, &done[place].1.timing)).collect();
    let (all, mut told) = (patience.calls(runs.len()), 0);
    let what = format!("{}: timing {} runs in turn", study.name, runs.len());
    let clocks = patience.time(settings.factory, &runs, || {
        told += 1;
        (settings.tell)(told, all, &what);
    });
    for (row, (_, outcome)) in study.rows.iter_mut().zip(done) {
        row.times = times(std::slice::from_ref(&outcome.timing));
    }
    for (place, clocks) in places.into_iter().zip(clocks) {
        study.rows[place].times = times(&clocks);
    }
}

/// Makes all runs once, with samples.
fn first_runs(
    settings: &Settings,
    bodies: &mut StudyMeshes,
    ladders: Vec<Ladder>,
    study: &mut SceneStudy,
) -> Result<Vec<(PlannedRun, RunResult)>> {
    let (all, mut count) = (ladders.iter().map(Vec::len).sum(), 0);
    let mut done = Vec::new();
    for ladder in ladders {
        let mut before: Option<(f64, usize)> = None;
        for run in ladder {
            count += 1;
            (settings.tell)(count, all, &format!("{}: {}, dt = {:.1e} s", study.name, run.method, run.scene.time.dt()));
            let what = format!("{}, {} steps", run.method, run.steps);
            let expected = before.map(|(seconds, steps)| seconds * run.steps as f64 / steps as f64);
            if let Some(expected) = expected.filter(|&seconds| seconds > most_seconds(settings.is_quick)) {
                study.left_out.push((what, format!("would take {expected:.0} s")));
                continue;
            }
            match first(settings.factory, &run, WALL_CLOCK_FACTOR * most_seconds(settings.is_quick)) {
                Ok(outcome) => {
                    before = Some((outcome.spent, outcome.timing.steps.len()));
                    bodies.add_row(&run, &outcome, study)?;
                    done.push((run, outcome));
                }
                Err(refusal) => {
                    before = refusal.spent.or(before);
                    study.left_out.push((what, refusal.reason));
                }
            }
        }
    }
    Ok(done)
}

fn times(clocks: &[Timing]) -> Times {
    let totals: Vec<f64> = clocks.iter().map(|clock| clock.total()).collect();
    let setups: Vec<f64> = clocks.iter().map(|clock| 1e3 * clock.setup).collect();
    let steps: Vec<f64> = clocks.iter().flat_map(|clock| clock.steps.iter().map(|step| 1e3 * step)).collect();
    Times {
        setup_ms: quantile(&setups, 0.5),
        step_ms: [0.5, 0.95, 0.99].map(|part| quantile(&steps, part)),
        total_s: quartiles(&totals),
        processor_s: quantile(&clocks.iter().filter_map(|clock| clock.processor).collect::<Vec<_>>(), 0.5),
        repetitions: clocks.len(),
    }
}

/// The error of the Pareto front: in time, or against the closed form.
pub fn competing_error(row: &Row) -> Option<f64> {
    row.errors.time_l2.or(row.errors.analytic).filter(|error| error.is_finite())
}

/// Sets the standings. Runs on the same mesh are compared.
fn stand(rows: &mut [Row]) {
    let mut meshes: Vec<String> = rows.iter().map(|row| row.config.mesh_hash.clone()).collect();
    meshes.sort();
    meshes.dedup();
    for mesh in meshes {
        let contender = |(place, row): (usize, &Row)| {
            let time = (row.times.total_s[0]?, row.times.total_s[2]?);
            let competes = row.config.mesh_hash == mesh && row.is_done();
            let error = competing_error(row).filter(|_| competes)?;
            Some((place, Contender { error, time }))
        };
        let (places, contenders): (Vec<usize>, Vec<Contender>) = rows.iter().enumerate().filter_map(contender).unzip();
        for (place, standing) in places.into_iter().zip(standings(&contenders)) {
            rows[place].standing = standing.name().to_owned();
        }
    }
}
