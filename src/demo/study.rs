//! Studies of the engine.

mod report;
mod stability;

use clap::Subcommand;

use super::end::End;

/// The subcommands.
#[derive(Debug, Subcommand)]
pub enum Study {
    /// Error against run time: which method for which error, with tables, pictures and a page
    Report(report::Arguments),
    /// Stiff and extreme cases: what each integrator does with them, beside what it must
    Stability(stability::Arguments),
}

impl Study {
    /// Runs the subcommand.
    pub fn run(&self) -> Result<(), End> {
        match self {
            Self::Report(arguments) => report::run(arguments),
            Self::Stability(arguments) => stability::run(arguments),
        }
    }
}
