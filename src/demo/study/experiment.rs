//! The subcommand `experiment`: the experiments of theses, beside their figures.

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::{Args, Subcommand};
use fem_study::experiments::{flat, write};

use crate::demo::data;
use crate::demo::end::End;
use crate::demo::progress;

#[derive(Debug, Args)]
pub struct Arguments {
    #[command(subcommand)]
    experiment: Experiment,
}

#[derive(Debug, Subcommand)]
enum Experiment {
    /// Two-dimensional deformation: substeps, time, stiffness, triangles, plastic flow and contact of bodies from pictures
    Flat(Flat),
}

#[derive(Debug, Args)]
struct Flat {
    /// One part; all of them without it
    #[arg(value_parser = PossibleValuesParser::new(flat::names()))]
    part: Option<String>,
    /// Folder for flat.html, a .csv of each table and an .svg of each picture
    #[arg(long, value_name = "DIR", default_value = "experiment-flat")]
    out: PathBuf,
    /// Fewer and coarser bodies; times are not judged
    #[arg(long)]
    quick: bool,
}

/// Runs the experiment and writes its files. A mark that does not hold is an error.
pub fn run(arguments: &Arguments) -> Result<(), End> {
    let Experiment::Flat(Flat { part, out, quick }) = &arguments.experiment;
    if out.exists() && !out.is_dir() {
        return Err(End::unusable(format!("--out {}: is a file; give the name of a folder", out.display())));
    }
    let unwritable = |error| End::unusable(format!("--out {}: cannot be written: {error}", out.display()));
    // Before the experiment, which takes a minute.
    std::fs::create_dir_all(out).map_err(unwritable)?;
    let part = part.as_deref();
    let found = progress::during("running the experiment", || flat::run(part, &data::folder(), *quick));
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
    say!("{}", out.join("flat.html").display());
    match experiment.parts.iter().flat_map(|part| &part.marks).filter(|mark| mark.holds == Some(false)).count() {
        0 => Ok(()),
        failed => Err(End::Stopped(format!("{failed} marks do not hold"))),
    }
}
