//! Studies of the engine.

mod experiment;
mod report;
mod stability;
mod sweep;

use clap::Subcommand;

use super::end::End;

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
    pub fn run(&self) -> Result<(), End> {
        match self {
            Self::Report(arguments) => report::run(arguments),
            Self::Stability(arguments) => stability::run(arguments),
            Self::Experiment(arguments) => experiment::run(arguments),
        }
    }
}
