//! The subcommand `experiment`: the experiments of theses, beside their figures.

use std::path::{Path, PathBuf};

use clap::builder::PossibleValuesParser;
use clap::{Args, Subcommand};
use fem_study::experiments::{self, flat, rtfem, write};

use crate::course::Course;
use crate::end::End;
use crate::progress;

#[derive(Debug, Args)]
pub struct Arguments {
    #[command(subcommand)]
    experiment: Experiment,
}

#[derive(Debug, Subcommand)]
enum Experiment {
    /// Two-dimensional deformation: substeps, time, stiffness, triangles, plastic flow and contact of bodies from pictures
    Flat(Flat),
    /// Finite elements in real time: a squashed torus, its speed, precision, equilibrium, materials and other bodies
    Rtfem(Rtfem),
}

#[derive(Debug, Args)]
struct Flat {
    /// One part; all of them without it
    #[arg(value_parser = PossibleValuesParser::new(flat::names()))]
    part: Option<String>,
    #[command(flatten)]
    options: Options,
}

#[derive(Debug, Args)]
struct Rtfem {
    /// One part; all of them without it
    #[arg(value_parser = PossibleValuesParser::new(rtfem::names()))]
    part: Option<String>,
    #[command(flatten)]
    options: Options,
}

#[derive(Debug, Args)]
struct Options {
    /// Folder for the page, a .csv of each table and an .svg of each picture [default: experiment-NAME]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Fewer and coarser bodies; times are not judged
    #[arg(long)]
    quick: bool,
}

/// Runs the experiment and writes its files. A mark that does not hold is an error.
pub fn run(course: &Course, arguments: &Arguments) -> Result<(), End> {
    match &arguments.experiment {
        Experiment::Flat(Flat { part, options }) => {
            carry_out(course, "flat", options, |data| flat::run(part.as_deref(), data, options.quick))
        }
        Experiment::Rtfem(Rtfem { part, options }) => {
            carry_out(course, "rtfem", options, |data| rtfem::run(part.as_deref(), data, options.quick))
        }
    }
}

fn carry_out(
    course: &Course,
    name: &str,
    options: &Options,
    experiment: impl Fn(&Path) -> Result<experiments::Experiment, String> + Sync,
) -> Result<(), End> {
    let out = &options.out.clone().unwrap_or_else(|| PathBuf::from(format!("experiment-{name}")));
    if out.exists() && !out.is_dir() {
        return Err(End::unusable(format!("--out {}: is a file; give the name of a folder", out.display())));
    }
    let unwritable = |error| End::unusable(format!("--out {}: cannot be written: {error}", out.display()));
    // Before the experiment, which takes a minute.
    std::fs::create_dir_all(out).map_err(unwritable)?;
    let found = progress::during("running the experiment", || experiment(&course.data()));
    let experiment = found.map_err(End::unusable)?;
    write(&experiment, out).map_err(unwritable)?;
    for part in &experiment.parts {
        for mark in &part.marks {
            let holds = match mark.holds {
                Some(true) => "holds",
                Some(false) => "DOES NOT HOLD",
                None => "not judged",
            };
            let theirs = if mark.theirs.is_empty() { String::new() } else { format!(" (thesis: {})", mark.theirs) };
            let separator = if mark.ours.is_empty() { "" } else { ": " };
            say!("{:9} {holds}: {}{separator}{}{theirs}", part.name, mark.statement, mark.ours);
        }
    }
    say!("{}", out.join(format!("{name}.html")).display());
    match experiment.parts.iter().flat_map(|part| &part.marks).filter(|mark| mark.holds == Some(false)).count() {
        0 => Ok(()),
        failed => Err(End::Stopped(format!("{failed} marks do not hold"))),
    }
}
