//! The subcommand `study`: a study of one's own.

use std::path::PathBuf;

use clap::Args;
use fem_scene::Scene;
use fem_study::sweep;

use super::Distribution;
use crate::course::Course;
use crate::end::End;

#[derive(Debug, Args)]
pub struct Arguments {
    /// The .toml file of the study; docs/book/own-studies.md explains it
    #[arg(value_name = "FILE.toml")]
    pub file: PathBuf,
    /// Folder for the table, the page and the states [default: the name of the file]
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,
    /// Leave out the cases with `quick = false`
    #[arg(long)]
    pub quick: bool,
    #[command(flatten)]
    pub distribution: Distribution,
}

/// Runs the study and writes its files. A row that is not as expected is an error.
pub fn run(course: &Course, arguments: &Arguments, merged: &[PathBuf]) -> Result<(), End> {
    let Arguments { file, out, quick, distribution } = arguments;
    let out = out.clone().unwrap_or_else(|| PathBuf::from(file.file_stem().unwrap_or_default()));
    let factory = |scene: &Scene| super::simulation(course, scene);
    let study = sweep::read(file, &course.data(), *quick, &out, &factory).map_err(End::unusable)?;
    super::end_of(course, &study, &out, *distribution, merged)
}
