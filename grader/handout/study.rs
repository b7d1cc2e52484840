//! Studies of the engine, which is not in this repository.

use clap::Subcommand;

use super::end::End;

/// The subcommands: none.
#[derive(Debug, Subcommand)]
pub enum Study {}

impl Study {
    /// Never called, because there is no subcommand.
    pub fn run(&self) -> Result<(), End> {
        match *self {}
    }
}
