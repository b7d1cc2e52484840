//! The subcommand `merge`: joins the shards of a study.

use std::path::PathBuf;

use clap::{Args, Parser};
use fem_study::study::arguments;

use super::Study;
use crate::course::Course;
use crate::end::End;

#[derive(Debug, Args)]
pub struct Arguments {
    /// Folders that `--shard` has written, all of them
    #[arg(value_name = "DIR", required = true)]
    pub folders: Vec<PathBuf>,
    /// Folder for the tables, pictures and the page
    #[arg(long, value_name = "DIR", default_value = "merged")]
    pub out: PathBuf,
}

/// The arguments that have made the rows of a shard.
#[derive(Debug, Parser)]
struct Made {
    #[command(subcommand)]
    by: Study,
}

/// Runs the command of the first shard with the rows of all of them.
pub fn run(course: &Course, Arguments { folders, out }: &Arguments) -> Result<(), End> {
    if folders.contains(out) {
        return Err(End::unusable(format!("--out {}: is a shard; give another folder", out.display())));
    }
    let own = arguments(&folders[0]).map_err(End::unusable)?;
    let words = ["finite-elements-3d".into()].into_iter().chain(own.into_iter().map(Into::into));
    let parsed = Made::try_parse_from(words.chain(["--out".into(), out.clone().into_os_string()]));
    let unknown = "holds rows of another program; merge with the one that wrote them";
    let made = parsed.map_err(|_| End::unusable(format!("{}: {unknown}", folders[0].display())))?;
    made.by.run_or_merge(course, folders)
}
