//! Studies of the engine.

mod experiment;
mod merge;
mod own;
mod report;
mod stability;
mod sweep;

use std::path::{Path, PathBuf};

use clap::{Args, Subcommand, ValueEnum};
use fem_model::simulation::Simulation;
use fem_scene::Scene;
use fem_study::study::{Finished, Run, Shard, Trouble, carry_out, pack};
use indicatif::{ProgressBar, ProgressStyle};

use crate::build;
use crate::course::Course;
use crate::end::End;

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Study {
    /// Error against run time of every method, with tables, pictures and a page
    Report(report::Arguments),
    /// Stiff and extreme cases: the outcome with each integrator beside the expected one
    Stability(stability::Arguments),
    /// Experiments of theses beside their figures
    Experiment(experiment::Arguments),
    /// A study of one's own: scenes, variations and what is expected of them, as a file
    #[command(name = "study")]
    Own(own::Arguments),
    /// Joins the shards of a study into its tables, pictures and page
    Merge(merge::Arguments),
}

impl Study {
    /// Runs the subcommand.
    pub fn run(&self, course: &Course) -> Result<(), End> {
        self.run_or_merge(course, &[])
    }

    /// Runs the subcommand, or joins the rows of its shards in these folders.
    fn run_or_merge(&self, course: &Course, merged: &[PathBuf]) -> Result<(), End> {
        match self {
            Self::Report(arguments) => report::run(course, arguments, merged),
            Self::Stability(arguments) => stability::run(course, arguments, merged),
            Self::Experiment(arguments) => experiment::run(course, arguments, merged),
            Self::Own(arguments) => own::run(course, arguments, merged),
            Self::Merge(arguments) => merge::run(course, arguments),
        }
    }
}

/// A system that distributes the shards of a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
pub enum Platform {
    /// Job arrays of Slurm
    Slurm,
}

/// Options for more than one machine.
#[derive(Clone, Copy, Debug, Args)]
pub struct Distribution {
    /// Run the K-th of N shards alone. A killed one goes on where it was; `merge` joins them
    #[arg(long, value_name = "K/N")]
    pub shard: Option<Shard>,
    /// Instead of the study, write scripts that run it on a cluster into the folder of --out
    #[arg(long, value_name = "PLATFORM", conflicts_with = "shard")]
    pub pack: Option<Platform>,
}

/// Runs a study, or joins its shards, and prints its end.
fn end_of(
    course: &Course,
    study: &impl fem_study::study::Study,
    out: &Path,
    distribution: Distribution,
    merged: &[PathBuf],
) -> Result<(), End> {
    end_told_by(&progress_bar(), course, study, out, distribution, merged)
}

/// The same with a bar that cases tell of their steps too.
fn end_told_by(
    bar: &ProgressBar,
    course: &Course,
    study: &impl fem_study::study::Study,
    out: &Path,
    Distribution { shard, pack }: Distribution,
    merged: &[PathBuf],
) -> Result<(), End> {
    let unwritable = |error| End::unusable(format!("--out {}: cannot be written: {error}", out.display()));
    if out.exists() && !out.is_dir() {
        return Err(End::unusable(format!("--out {}: is a file; give the name of a folder", out.display())));
    }
    if pack == Some(Platform::Slurm) {
        pack::slurm(&study.arguments(), out).map_err(unwritable)?;
        say!("{}", out.join("submit.sh").display());
        return Ok(());
    }
    let run = Run {
        out,
        shard: shard.unwrap_or(Shard::WHOLE),
        merged,
        sources: &course.data(),
        tell: &|done, all, what| show(bar, done, all, what),
        remark: &|line| bar.suspend(|| eprintln!("{line}")),
    };
    let finished = carry_out(study, &run);
    bar.finish_and_clear();
    let Finished { lines, failed } = finished.map_err(|trouble| match trouble {
        Trouble::Unusable(message) => End::unusable(message),
        Trouble::Incomplete(message) => End::Stopped(message),
    })?;
    for line in lines {
        say!("{line}");
    }
    failed.map_or(Ok(()), |message| Err(End::Stopped(message)))
}

/// The simulation of a scene, by either pipeline.
fn simulation(course: &Course, scene: &Scene) -> Result<Box<dyn Simulation>, String> {
    build::build(course, scene).map(|ready| ready.simulation).map_err(|end| end.message())
}

fn show(bar: &ProgressBar, done: usize, all: usize, what: &str) {
    bar.set_length(all as u64);
    bar.set_position(done as u64);
    bar.set_message(what.to_owned());
}

/// The bar is hidden if stderr is no terminal.
fn progress_bar() -> ProgressBar {
    let style =
        ProgressStyle::with_template("{bar:30} {pos:>4} of {len}  {elapsed}  {wide_msg}").expect("a valid template");
    ProgressBar::new(1).with_style(style)
}
