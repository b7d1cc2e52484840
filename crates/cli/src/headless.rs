//! A run without a window.

use std::ops::ControlFlow;

use fem_mesh::write::Frame;
use fem_model::simulation::Simulation;
use fem_output::{EnergyRow, Probe, Series};
use fem_scene::Scene;
use indicatif::{ProgressBar, ProgressStyle};

use crate::build::Ready;
use crate::checkpoints::Checkpoints;
use crate::cli::RunArguments;
use crate::end::End;
use crate::pictures::Pictures;
use crate::results::{self, Finished};
use crate::signals::Signals;

/// Frames of an animated export in a second of simulated time.
const EXPORTED_FRAMES_PER_SECOND: f64 = 30.0;

/// Runs all steps, shows progress on a terminal, and writes the files that the options name, also after a failure or a signal.
pub fn run(ready: Ready, scene: &Scene, arguments: &RunArguments) -> Result<(), End> {
    let Ready { mut simulation, seconds_setup, steps, up, expected_tip } = ready;
    let mut pictures = Pictures::new(arguments, &up);
    let mut log = Log::new(arguments, &*simulation)?;
    let mut checkpoints = Checkpoints::new(arguments, scene);
    let signals = Signals::catch()?;
    let bar = progress_bar(steps);
    let watch = signals.watch(&bar);

    pictures.record(&*simulation)?;
    log.add(&*simulation)?;
    let run = fem_output::run(&mut *simulation, steps, |simulation| {
        bar.inc(1);
        log.add(simulation)?;
        pictures.record(simulation)?;
        if let Some(checkpoints) = checkpoints.as_mut().filter(|checkpoints| checkpoints.is_due()) {
            checkpoints.write(simulation);
            log.write(arguments, simulation)?;
        }
        Ok(if signals.received().is_some() { ControlFlow::Break(()) } else { ControlFlow::Continue(()) })
    })?;
    drop(watch);
    bar.finish_and_clear();

    // After a failure the last checkpoint is kept, so that a run with shorter steps can continue from it.
    if let Some(checkpoints) = checkpoints.as_mut().filter(|_| run.failure.is_none()) {
        checkpoints.write(&*simulation);
    }
    pictures.screenshot(&*simulation)?;
    log.finish(arguments, &*simulation)?;
    let Log { energies, frames, .. } = log;
    let signal = signals.received().filter(|_| run.interrupted);
    results::finish(
        &Finished { simulation: &*simulation, scene, run, signal, seconds_setup, energies, frames, expected_tip },
        arguments,
    )
}

/// The progress bar; hidden if stderr is not a terminal.
pub fn progress_bar(steps: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} step {pos} of {len}, {eta} left").expect("a valid template");
    ProgressBar::new(steps as u64).with_style(style)
}

/// Energies, frames, probes and files of the steps, as far as the options ask for them.
struct Log {
    /// Time of the first state, s.
    start: f64,
    probes: Vec<Probe>,
    wants_energies: bool,
    wants_frames: bool,
    energies: Vec<EnergyRow>,
    frames: Vec<Frame>,
    series: Option<Series>,
}

impl Log {
    fn new(arguments: &RunArguments, simulation: &dyn Simulation) -> Result<Self, End> {
        let is_animated = |path: &std::path::PathBuf| path.extension().is_some_and(|extension| extension == "glb");
        let series = arguments.vtu_series.as_ref().map(|folder| Series::new(folder, arguments.every));
        Ok(Self {
            start: simulation.time(),
            probes: arguments.probe.iter().map(|probe| probe.probe(simulation)).collect::<Result<_, _>>()?,
            wants_energies: arguments.energies.is_some(),
            wants_frames: arguments.export.as_ref().is_some_and(is_animated),
            energies: Vec::new(),
            frames: Vec::new(),
            series: series.transpose().map_err(End::unusable)?,
        })
    }

    fn add(&mut self, simulation: &dyn Simulation) -> Result<(), End> {
        let time = simulation.time();
        if self.wants_energies {
            self.energies.push(EnergyRow::of(simulation));
        }
        self.probes.iter_mut().for_each(|probe| probe.add(simulation));
        if self.wants_frames && (time - self.start) * EXPORTED_FRAMES_PER_SECOND >= self.frames.len() as f64 - 1e-6 {
            self.frames.push(Frame { time, positions: simulation.display_positions() });
        }
        self.series.as_mut().map_or(Ok(()), |series| series.add(simulation)).map_err(End::unusable)
    }

    /// Writes the tables so far and the list of the series so far.
    fn write(&self, arguments: &RunArguments, simulation: &dyn Simulation) -> Result<(), End> {
        self.probes.iter().try_for_each(Probe::write).map_err(End::unusable)?;
        if let Some(path) = &arguments.energies {
            fem_output::write_energies(path, &self.energies).map_err(End::unusable)?;
        }
        self.series.as_ref().map_or(Ok(()), |series| series.write_list(simulation).map(drop)).map_err(End::unusable)
    }

    /// Writes the tables, the last state of the series and its list, and prints the path of the list.
    fn finish(&mut self, arguments: &RunArguments, simulation: &dyn Simulation) -> Result<(), End> {
        self.write(arguments, simulation)?;
        let listed = self.series.as_mut().map(|series| series.finish(simulation)).transpose().map_err(End::unusable)?;
        if let Some(path) = listed {
            say!("{}: the series, for ParaView", path.display());
        }
        Ok(())
    }
}
