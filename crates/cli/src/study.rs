//! Studies of the engine.

mod experiment;
mod report;
mod stability;
mod sweep;

use clap::Subcommand;

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
}

impl Study {
    /// Runs the subcommand.
    pub fn run(&self, course: &Course) -> Result<(), End> {
        match self {
            Self::Report(arguments) => report::run(course, arguments),
            Self::Stability(arguments) => stability::run(course, arguments),
            Self::Experiment(arguments) => experiment::run(course, arguments),
        }
    }
}
