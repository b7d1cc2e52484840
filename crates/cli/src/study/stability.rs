//! The subcommand `stability`: stiff and extreme cases.

use std::path::PathBuf;

use clap::Args;
use fem_study::stability::Stability;

use super::Distribution;
use crate::course::Course;
use crate::end::End;

#[derive(Debug, Args)]
pub struct Arguments {
    /// Folder for stability.html, .csv, .json and a picture of each map
    #[arg(long, value_name = "DIR", default_value = "stability")]
    pub out: PathBuf,
    /// One or a few cases of each kind: under a minute
    #[arg(long)]
    pub quick: bool,
    #[command(flatten)]
    pub distribution: Distribution,
}

/// Runs all cases and writes the tables. An unexpected outcome is an error.
pub fn run(course: &Course, arguments: &Arguments, merged: &[PathBuf]) -> Result<(), End> {
    let study = Stability { quick: arguments.quick };
    super::end_of(course, &study, &arguments.out, arguments.distribution, merged)
}
