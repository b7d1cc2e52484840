//! The command line: arguments as types, without the work of the commands.

use std::path::PathBuf;

use clap::{Parser, Subcommand};

use crate::pack::Platform;

/// Hands out the exercises, checks them, grades submissions and whole classes.
#[derive(Parser)]
#[command(name = "grader", version, max_term_width = 100)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
}

#[derive(Subcommand)]
pub enum Command {
    /// Write the students' repository: every exercise empty, everything else as it is.
    Handout {
        /// A new or empty folder.
        #[arg(value_name = "DIR")]
        to: PathBuf,
        /// The assignment: its functions are empty, the others are given solved.
        #[arg(long, value_name = "FILE")]
        rubric: Option<PathBuf>,
    },
    /// Hold the functions of a repository to the public checks.
    Check(grader::check::Options),
    /// Grade one submission: a folder or archive with src/NAME.rs files.
    Grade {
        /// Folder, .zip or .tar.gz.
        submission: PathBuf,
        #[command(flatten)]
        options: GradeOptions,
        /// Gradescope's submission_metadata.json: whose the submission is and when it came, for the rubric's deadline.
        #[arg(long, value_name = "FILE")]
        metadata: Option<PathBuf>,
        #[command(flatten)]
        again: Again,
        /// Ends as soon as the process with this number does, which must be the one that starts this one.
        #[arg(long, value_name = "PID", hide = true)]
        ends_with: Option<u32>,
    },
    /// Grade every submission in a folder; goes on where it was stopped.
    Class {
        /// A folder with a folder or archive for each submission, or the archive that Canvas, Moodle or Gradescope give for download.
        folder: PathBuf,
        /// A table of the students like students.csv, or a roster of Canvas, Moodle or Gradescope, in place of those among the submissions.
        #[arg(long, value_name = "FILE")]
        roster: Option<PathBuf>,
        #[command(flatten)]
        options: GradeOptions,
        /// Submissions at a time; one for each core unless told.
        #[arg(long, value_name = "N", value_parser = jobs, allow_hyphen_values = true)]
        jobs: Option<usize>,
        /// The K-th of N parts of the class, for several machines; `merge` joins them.
        #[arg(long, value_name = "K/N", value_parser = shard)]
        shard: Option<(usize, usize)>,
        /// Grade these students or submissions again, and leave all others as they are.
        #[arg(long, value_name = "NAME", num_args = 1..)]
        only: Vec<String>,
        /// Grade these functions again, and keep the results of the others.
        #[arg(long, value_name = "NAME", num_args = 1..)]
        function: Vec<String>,
    },
    /// Write what students may see, and nothing else: a folder each.
    Feedback {
        /// A result folder of `class`.
        results: PathBuf,
        /// A new or empty folder.
        #[arg(long, value_name = "DIR")]
        out: PathBuf,
        /// The same in one archive, to upload.
        #[arg(long, value_name = "FILE")]
        zip: Option<PathBuf>,
    },
    /// Compare the submissions of a folder with each other, and write pages to read similar ones side by side.
    Similar {
        /// A folder with a folder or archive for each submission, or the archive that Canvas, Moodle or Gradescope give for download.
        folder: PathBuf,
        /// A table of the students like students.csv, or a roster of Canvas, Moodle or Gradescope, in place of those among the submissions.
        #[arg(long, value_name = "FILE")]
        roster: Option<PathBuf>,
        /// Code that you gave beside the handout, and that is left out too: files or folders.
        #[arg(long, value_name = "PATH", num_args = 1..)]
        given: Vec<PathBuf>,
        /// A new or empty folder.
        #[arg(long, value_name = "DIR")]
        out: PathBuf,
        /// The assignment, whose handout's text is left out.
        #[arg(long, value_name = "FILE")]
        rubric: Option<PathBuf>,
    },
    /// Join the results of shards.
    Merge {
        /// Result folders of `class`.
        #[arg(required = true)]
        folders: Vec<PathBuf>,
        /// Folder for the joined results.
        #[arg(long, value_name = "DIR")]
        out: PathBuf,
    },
    /// Print what the failure of each check costs.
    Weights {
        /// Points and shares, instead of the grader's own.
        #[arg(long, value_name = "FILE")]
        rubric: Option<PathBuf>,
    },
    /// Name the layers of this machine's sandbox; fails where they are not enough to grade.
    Sandbox,
    /// Write the files with which a platform runs the grader.
    Pack {
        platform: Platform,
        /// A new or empty folder.
        #[arg(long, value_name = "DIR")]
        out: PathBuf,
        /// Seed of the random inputs; drawn now unless given.
        #[arg(long, value_name = "N", value_parser = seed, allow_hyphen_values = true)]
        seed: Option<u64>,
        /// The assignment that Gradescope grades; the grader's own rubric unless told.
        #[arg(long, value_name = "FILE")]
        rubric: Option<PathBuf>,
        /// Pack the sources of all dependencies too, so that setting up needs no crates from the network.
        #[arg(long)]
        vendor: bool,
    },
}

/// Options that `class --function` hands to `grade`.
#[derive(clap::Args)]
pub struct Again {
    /// The grade whose other functions are kept.
    #[arg(long, value_name = "FILE", hide = true, requires = "function")]
    pub earlier: Option<PathBuf>,
    /// A function to grade again.
    #[arg(long, value_name = "NAME", hide = true, requires = "earlier")]
    pub function: Vec<String>,
}

#[derive(clap::Args)]
pub struct GradeOptions {
    /// Folder for the results.
    #[arg(long, value_name = "DIR")]
    pub out: PathBuf,
    /// Seed of the random inputs, to repeat a grading. Otherwise one is drawn and written into the results, for a class once.
    #[arg(long, value_name = "N", value_parser = seed, allow_hyphen_values = true)]
    pub seed: Option<u64>,
    /// Points, levels and tolerances, instead of the grader's own.
    #[arg(long, value_name = "FILE")]
    pub rubric: Option<PathBuf>,
    /// Draw errors and run times beside the reference's: each function's, and the whole simulation's at several time steps.
    #[arg(long)]
    pub report: bool,
    /// Grade even where this machine has no sandbox at all: a submission may then do what you may.
    #[arg(long)]
    pub without_sandbox: bool,
}

fn jobs(text: &str) -> Result<usize, String> {
    text.parse().ok().filter(|&jobs| jobs > 0).ok_or_else(|| "give a whole number from 1 on".to_owned())
}

fn seed(text: &str) -> Result<u64, String> {
    text.parse().map_err(|_| format!("give a whole number from 0 to {}", u64::MAX))
}

fn shard(text: &str) -> Result<(usize, usize), String> {
    let parts = text.split_once('/').and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
    match parts {
        Some((k, n)) if 1 <= k && k <= n => Ok((k, n)),
        _ => Err("give two numbers K/N with 1 ≤ K ≤ N, such as 2/8".to_owned()),
    }
}
