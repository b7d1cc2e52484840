//! A run of many environments, without a window.

use std::time::{Duration, Instant};

use fem_engine::batch::Batch;
use fem_model::{Body, EnvironmentValues};
use fem_scene::Scene;
use fem_scene::{EnvironmentEnd, write_batch};

use crate::build;
use crate::cli::RunArguments;
use crate::course::Course;
use crate::end::End;
use crate::explain::{MOST_NODES, least_stable, verdict};
use crate::headless::progress_bar;
use crate::signals::Signals;

/// Steps are sent together until they take so long: a run answers to a signal between them.
const TOGETHER: Duration = Duration::from_millis(100);

/// Runs all steps, prints how fast they were, and writes the states. Environments that fail end the run with exit code 1, after that.
pub fn run(course: &Course, scene: &Scene, arguments: &RunArguments) -> Result<(), End> {
    check(arguments)?;
    let body = build::body(course, scene)?;
    let mut batch = Batch::new(body.clone(), &scene.method(), scene.environment_values())
        .map_err(|refusal| End::unusable(scene.refused(refusal)))?;
    warn_of_long_steps(scene, &body)?;
    let steps = scene.steps();
    let signals = Signals::catch()?;
    let (bar, start) = (progress_bar(steps), Instant::now());
    let mut together = 1;
    while batch.steps() < steps && signals.received().is_none() {
        let (now, began) = (together.min(steps - batch.steps()), Instant::now());
        batch.advance(now).map_err(End::Stopped)?;
        bar.inc(now as u64);
        if began.elapsed() < TOGETHER / 2 {
            together *= 2;
        } else if began.elapsed() > TOGETHER * 2 {
            together = (together / 2).max(1);
        }
    }
    let seconds = start.elapsed().as_secs_f64();
    bar.finish_and_clear();
    batch.check_ends().map_err(End::Stopped)?;
    print_speed(scene, &mut batch, seconds)?;
    if let Some(path) = &arguments.state {
        let (time, count) = (batch.time(), batch.count());
        write_batch(path, time, count, |environment| end_of(&mut batch, environment)).map_err(End::unusable)?;
    }
    check_end(scene, &mut batch)?;
    match signals.received().filter(|_| batch.steps() < steps) {
        Some(code) => {
            let message = format!("after step {} of {steps}; a batch cannot go on from here", batch.steps());
            Err(End::Interrupted { code, message })
        }
        None => Ok(()),
    }
}

/// Refuses options that a batch does not support.
fn check(arguments: &RunArguments) -> Result<(), End> {
    let unknown = [
        ("--resume", arguments.resume.is_some()),
        ("--checkpoint", arguments.checkpoint.is_some()),
        ("--probe", !arguments.probe.is_empty()),
        ("--stats", arguments.stats.is_some()),
        ("--energies", arguments.energies.is_some()),
        ("--export", arguments.export.is_some()),
        ("--vtu-series", arguments.vtu_series.is_some()),
        ("--screenshot", arguments.screenshot.is_some()),
        ("--record", arguments.record.is_some()),
        ("--color", arguments.color.is_some()),
    ];
    if let Some((option, _)) = unknown.iter().find(|(_, is_given)| *is_given) {
        let problem = format!("{option}: a scene with [batch] has many bodies, and writes --state alone; leave it out");
        return Err(End::unusable(problem));
    }
    if arguments.headless {
        return Ok(());
    }
    Err(End::unusable("a scene with [batch] has no window; add --headless"))
}

/// Warns of steps that are longer than the critical one: a device finds a motion that grows without bound only when its numbers overflow.
fn warn_of_long_steps(scene: &Scene, body: &Body) -> Result<(), End> {
    if !scene.time.integrator.is_explicit() || body.shape.mesh.vertices().len() > MOST_NODES {
        return Ok(());
    }
    let simulation = least_stable(scene, body)?;
    let dt = simulation.dt() / simulation.substeps() as f64;
    if let Some(critical) = simulation.critical_time_step().filter(|critical| *critical > 0.0 && dt >= *critical) {
        eprintln!("warning: {}", verdict(critical, &*simulation));
    }
    Ok(())
}

/// Prints the speed of a run; none of one in which environments stood still.
fn print_speed(scene: &Scene, batch: &mut Batch, seconds: f64) -> Result<(), End> {
    let (count, steps, place) = (batch.count(), batch.steps(), batch.place());
    let head = format!("{}, {count} environments, {steps} steps, t = {:.6} s, on {place}", scene.name, batch.time());
    if batch.failures().map_err(End::Stopped)?.is_empty() {
        say!("{head}: {:.0} environment-steps per second", (count * steps) as f64 / seconds);
    } else {
        say!("{head}");
    }
    Ok(())
}

fn end_of(batch: &mut Batch, environment: usize) -> EnvironmentEnd {
    let state = batch.state(environment);
    let state = state.map(|state| [state.positions.into_flattened(), state.velocities.into_flattened()]);
    EnvironmentEnd { values: batch.values(environment), state }
}

/// Ends with the first environment that has failed, and with steps that have not converged.
fn check_end(scene: &Scene, batch: &mut Batch) -> Result<(), End> {
    let count = batch.count();
    let failures = batch.failures().map_err(End::Stopped)?;
    if let [first, ..] = failures {
        let (failed, first) = (failures.len(), first.clone());
        let values = words(batch.values(first.environment));
        let message = format!(
            "{failed} of {count} environments failed, the first of them environment {}{values}: {}",
            first.environment, first.failure
        );
        return Err(End::Stopped(message));
    }
    let unconverged = batch.unconverged_steps();
    let method = scene.method();
    if unconverged == 0 || method.accepts_unconverged() {
        return Ok(());
    }
    let table = if method.integrator.is_iterated() { "iterations" } else { "newton" };
    Err(End::Stopped(format!(
        "{unconverged} steps of environments have not converged; use a shorter time step, or accept them with \
         {table}.accept_unconverged = true"
    )))
}

/// The varied quantities of an environment, in brackets.
fn words(values: EnvironmentValues) -> String {
    let words: Vec<String> = values.varied().map(|(key, value)| format!("{key} = {value:.6e}")).collect();
    if words.is_empty() { String::new() } else { format!(" ({})", words.join(", ")) }
}
