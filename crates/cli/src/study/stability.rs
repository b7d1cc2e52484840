//! The subcommand `stability`: stiff and extreme cases.

use std::path::PathBuf;

use clap::Args;
use fem_study::stability::{CaseRow, study, write};
use indicatif::{ProgressBar, ProgressStyle};

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
}

/// Runs all cases and writes the tables. An unexpected outcome is an error.
pub fn run(course: &Course, arguments: &Arguments) -> Result<(), End> {
    let folder = &arguments.out;
    if folder.exists() && !folder.is_dir() {
        return Err(End::unusable(format!("--out {}: is a file; give the name of a folder", folder.display())));
    }
    let bar = progress_bar();
    let progress = |row: &CaseRow, count: usize| {
        bar.set_length(count as u64);
        bar.inc(1);
        if !row.pass {
            let CaseRow { family, case, parameters, integrator, material, expected, outcome, note, .. } = row;
            let told = format!(
                "{family}: {case} ({parameters}), {integrator}, {material}: {outcome}, expected: {expected}; {note}"
            );
            bar.suspend(|| eprintln!("{told}"));
        }
    };
    let table = study(arguments.quick, &course.data(), &progress);
    bar.finish_and_clear();
    let unwritable =
        |error: std::io::Error| End::unusable(format!("--out {}: cannot be written: {error}", folder.display()));
    write(&table, folder).map_err(unwritable)?;
    let counts = table.counts;
    say!(
        "{} of {} cases as expected ({} of them from random states with {} seeds; {} more runs in maps), {:.0} s",
        counts.pass,
        counts.rows,
        counts.seeded_rows,
        counts.seeds,
        counts.map_cells,
        table.seconds
    );
    say!("{}", folder.join("stability.html").display());
    if table.passes() {
        Ok(())
    } else {
        Err(End::Stopped(format!("{} cases have an unexpected outcome", counts.rows - counts.pass)))
    }
}

/// The bar is hidden if stderr is no terminal.
fn progress_bar() -> ProgressBar {
    let style = ProgressStyle::with_template("{bar:40} case {pos} of {len}, {eta} left").expect("a valid template");
    ProgressBar::new(0).with_style(style)
}
