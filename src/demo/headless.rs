//! A run without a window.

use fem_mesh::write::Frame;
use fem_scene::output::Series;
use fem_scene::simulate;
use fem_scene::simulation::{Energies, Simulation};
use indicatif::{ProgressBar, ProgressStyle};

use super::build::Ready;
use super::cli::RunArguments;
use super::end::End;
use super::pictures::Pictures;
use super::results::{self, Finished};

/// Frames of an animated export in a second of simulated time.
const EXPORTED_FRAMES_PER_SECOND: f64 = 30.0;

/// Runs all steps, shows progress on a terminal, and writes the files that the options name, also after a failure.
pub fn run(ready: Ready, arguments: &RunArguments) -> Result<(), End> {
    let Ready { mut simulation, seconds_setup, steps, up, expected_tip } = ready;
    let mut pictures = Pictures::new(arguments, &up);
    let mut log = Log::new(arguments)?;
    let bar = progress_bar(steps);

    pictures.record(&*simulation)?;
    log.add(&*simulation)?;
    let run = simulate::run(&mut *simulation, steps, |simulation| {
        bar.inc(1);
        log.add(simulation)?;
        pictures.record(simulation)
    })?;
    bar.finish_and_clear();

    pictures.screenshot(&*simulation)?;
    log.finish(&*simulation)?;
    let Log { energies, frames, .. } = log;
    results::finish(
        &Finished { simulation: &*simulation, run, seconds_setup, energies, frames, expected_tip },
        arguments,
    )
}

/// The progress bar; hidden if stderr is not a terminal.
fn progress_bar(steps: usize) -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} step {pos} of {len}, {eta} left").expect("a valid template");
    ProgressBar::new(steps as u64).with_style(style)
}

/// Energies, frames and files of the steps, as far as the options ask for them.
struct Log {
    wants_energies: bool,
    wants_frames: bool,
    energies: Vec<(f64, Energies)>,
    frames: Vec<Frame>,
    series: Option<Series>,
}

impl Log {
    fn new(arguments: &RunArguments) -> Result<Self, End> {
        let is_animated = |path: &std::path::PathBuf| path.extension().is_some_and(|extension| extension == "glb");
        let series = arguments.vtu_series.as_ref().map(|folder| Series::new(folder, arguments.every));
        Ok(Self {
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
            self.energies.push((time, simulation.energies()));
        }
        if self.wants_frames && time * EXPORTED_FRAMES_PER_SECOND >= self.frames.len() as f64 - 1e-6 {
            self.frames.push(Frame { time, positions: simulation.display_positions() });
        }
        self.series.as_mut().map_or(Ok(()), |series| series.add(simulation)).map_err(End::unusable)
    }

    /// Writes the `.pvd` of the series, if an option asks for it.
    fn finish(&mut self, simulation: &dyn Simulation) -> Result<(), End> {
        let listed = self.series.as_mut().map(|series| series.finish(simulation)).transpose().map_err(End::unusable)?;
        if let Some(path) = listed {
            say!("{}: the series, for ParaView", path.display());
        }
        Ok(())
    }
}
