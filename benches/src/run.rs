//! One run of a scene, in this process or in one of its own.

use std::process::Command;
use std::time::Instant;

use fem_model::simulation::Simulation;
use fem_output::Stats;
use fem_scene::tables::Pipeline;
use finite_elements_3d::assignment_setup::AssignmentSetup;
use nix::time::{ClockId, clock_gettime};
use serde::{Deserialize, Serialize};

use crate::cli::RunArguments;
use crate::end::End;
use crate::race::{Contestant, Time};

/// Number of steps if neither the scene nor the arguments give one.
const DEFAULT_STEPS: usize = 100;

/// The measurement of a run. Times are means over its steps, s, unless they are medians.
#[derive(Clone, Debug, Deserialize, Serialize)]
pub struct Measurement {
    pub nodes: usize,
    pub elements: usize,
    pub steps: usize,
    pub seconds_setup: f64,
    /// Wall-clock time.
    pub wall_per_step: f64,
    /// Median of the wall-clock times.
    pub wall_per_step_median: f64,
    /// Processor time of all threads.
    pub cpu_per_step: f64,
    pub newton_per_step: f64,
    pub unconverged_steps: usize,
    pub peak_memory_bytes: Option<usize>,
    /// Positions of all nodes at the end, m.
    pub positions: Vec<f64>,
}

/// Runs a scene and prints its [`Measurement`].
pub fn print(arguments: &RunArguments) -> Result<(), End> {
    let run = here(arguments)?;
    println!("{}", serde_json::to_string(&run).map_err(End::wrong)?);
    Ok(())
}

fn here(arguments: &RunArguments) -> Result<Measurement, End> {
    let scene = arguments.scene().map_err(End::unusable)?;
    let steps = scene.time.steps.unwrap_or(DEFAULT_STEPS);
    let start = Instant::now();
    let body = fem_scene::body(&scene, &arguments.data).map_err(End::unusable)?;
    let mut simulation: Box<dyn Simulation> = match scene.pipeline {
        Pipeline::Course => Box::new(AssignmentSetup::new(&scene, body).map_err(End::unusable)?),
        Pipeline::Engine => fem_engine::simulator::build(body, &scene.method()).map_err(End::unusable)?,
    };
    let seconds_setup = start.elapsed().as_secs_f64();

    let (wall, cpu) = (Instant::now(), processor_seconds()?);
    let Ok(run) = fem_output::run(&mut *simulation, steps, |_| {
        Ok::<_, std::convert::Infallible>(std::ops::ControlFlow::Continue(()))
    });
    let (wall, cpu) = (wall.elapsed().as_secs_f64(), processor_seconds()? - cpu);
    let stats = Stats::of(&*simulation, &run, seconds_setup);
    if let Some(failure) = run.failure {
        return Err(End::wrong(format!("{}: {failure}", scene.name)));
    }
    let counters = simulation.counters();
    Ok(Measurement {
        nodes: stats.nodes,
        elements: stats.elements,
        steps,
        seconds_setup,
        wall_per_step: wall / steps as f64,
        wall_per_step_median: stats.seconds_per_step_median.unwrap_or(f64::NAN),
        cpu_per_step: cpu / steps as f64,
        newton_per_step: counters.newton_iterations as f64 / steps as f64,
        unconverged_steps: counters.unconverged_steps,
        peak_memory_bytes: stats.peak_memory_bytes,
        positions: simulation.positions().as_slice().to_vec(),
    })
}

/// Processor time of this process so far, s.
pub fn processor_seconds() -> Result<f64, End> {
    let time = clock_gettime(ClockId::CLOCK_PROCESS_CPUTIME_ID).map_err(End::wrong)?;
    Ok(time.tv_sec() as f64 + 1e-9 * time.tv_nsec() as f64)
}

/// Runs a scene in a process of its own with a number of threads.
pub fn apart(arguments: &RunArguments, threads: usize) -> Result<Measurement, End> {
    let program = std::env::current_exe().map_err(End::unusable)?;
    let mut command = Command::new(program);
    command.env("RAYON_NUM_THREADS", threads.to_string()).arg("run").arg(&arguments.scene);
    command.arg("--data").arg(&arguments.data);
    for (name, number) in [("--steps", arguments.steps), ("--cells", arguments.cells)] {
        if let Some(number) = number {
            command.arg(name).arg(number.to_string());
        }
    }
    if let Some(solver) = arguments.solver {
        command.args(["--solver", solver.name()]);
    }
    for change in &arguments.overrides {
        command.arg("--set").arg(change.to_string());
    }
    let printed = output_of(&mut command)?;
    serde_json::from_str(&printed).map_err(|error| End::wrong(format!("a run printed no valid JSON: {error}")))
}

/// A scene as a contestant, each time in a process of its own.
pub fn timed(arguments: &RunArguments, threads: usize) -> Contestant<'_> {
    Box::new(move || apart(arguments, threads).map(|run| Time { wall: run.wall_per_step, cpu: run.cpu_per_step }))
}

/// The output of a program; a failure includes its messages.
pub fn output_of(command: &mut Command) -> Result<String, End> {
    let program = command.get_program().to_string_lossy().into_owned();
    let output = command.output().map_err(|error| End::unusable(format!("{program}: {error}; give its path")))?;
    if !output.status.success() {
        let complaint = String::from_utf8_lossy(&output.stderr);
        return Err(End::wrong(format!("{program} ended with {}: {}", output.status, complaint.trim())));
    }
    String::from_utf8(output.stdout).map_err(|error| End::wrong(format!("{program}: {error}")))
}
