//! The subcommand `report`: error against run time.

use std::path::PathBuf;

use clap::Args;
use fem_model::simulation::Simulation;
use fem_scene::Scene;
use fem_study::experiments::write;
use fem_study::linear;
use fem_study::machine::Machine;
use fem_study::report::{Report, first_files, report};
use fem_study::studies::Settings;
use indicatif::{ProgressBar, ProgressStyle};

use super::sweep::Sweep;
use crate::build;
use crate::course::Course;
use crate::end::End;

#[derive(Debug, Args)]
pub struct Arguments {
    /// Scenes to study, by name or by path
    #[arg(value_name = "SCENE", default_values = ["arma", "beam"])]
    pub scenes: Vec<String>,
    /// Folder for report.html, runs.csv, runs.json, states and pictures
    #[arg(long, value_name = "DIR", default_value = "report")]
    pub out: PathBuf,
    /// Small meshes and few steps: under a minute
    #[arg(long)]
    pub quick: bool,
    /// Instead of the report, run each scene as it is for every value of a key, and write sweep.csv and sweep.html; repeatable
    #[arg(long, value_name = "KEY=VALUE,VALUE", conflicts_with = "quick")]
    pub sweep: Vec<Sweep>,
    /// Instead of the report, compare the convergence of the linear solvers, iteration by iteration, and write linear.html
    #[arg(long, conflicts_with = "sweep")]
    pub linear: bool,
}

/// Studies the scenes, writes the report, and prints the fastest method for each error.
pub fn run(course: &Course, arguments: &Arguments) -> Result<(), End> {
    let (folder, data) = (&arguments.out, course.data());
    if folder.exists() && !folder.is_dir() {
        return Err(End::unusable(format!("--out {}: is a file; give the name of a folder", folder.display())));
    }
    if !arguments.sweep.is_empty() {
        return sweep(course, arguments);
    }
    let scenes = arguments.scenes.iter().map(|name| fem_scene::load(name, &data).map_err(End::unusable));
    let scenes: Vec<Scene> = scenes.collect::<Result<_, _>>()?;
    if arguments.linear {
        return linear(course, &scenes, arguments);
    }
    let bar = progress_bar();
    let tell = |done: usize, all: usize, what: &str| show(&bar, done, all, what);
    let factory = |scene: &Scene| -> Result<Box<dyn Simulation>, String> {
        build::build(course, scene).map(|ready| ready.simulation).map_err(|end| end.message())
    };
    let settings = Settings { data, out: folder.clone(), is_quick: arguments.quick, factory: &factory, tell: &tell };
    let found = report(&settings, &scenes).map_err(End::Stopped)?;
    bar.finish_and_clear();
    print(&found);
    for file in first_files(folder) {
        say!("{}", file.display());
    }
    Ok(())
}

/// Compares the linear solvers on the systems of the scenes. A bound that does not hold is an error.
fn linear(course: &Course, scenes: &[Scene], arguments: &Arguments) -> Result<(), End> {
    let body = |scene: &Scene| build::body(course, scene).map_err(|end| end.message());
    let machine = Machine::this(&course.data());
    let found = linear::study(scenes, arguments.quick, body, machine).map_err(End::unusable)?;
    let unwritable = |error| End::unusable(format!("--out {}: cannot be written: {error}", arguments.out.display()));
    write(&found, &arguments.out).map_err(unwritable)?;
    for mark in found.parts.iter().flat_map(|part| &part.marks) {
        let holds = if mark.holds == Some(true) { "holds" } else { "DOES NOT HOLD" };
        say!("{holds}: {}: {}", mark.statement, mark.ours);
    }
    say!("{}", arguments.out.join("linear.html").display());
    match found.parts.iter().all(fem_study::experiments::Part::passes) {
        true => Ok(()),
        false => Err(End::Stopped("a bound does not hold".to_owned())),
    }
}

/// Runs each scene for every combination of values.
fn sweep(course: &Course, arguments: &Arguments) -> Result<(), End> {
    let bar = progress_bar();
    let tell = |done: usize, all: usize, what: &str| show(&bar, done, all, what);
    let swept = super::sweep::run(course, &arguments.scenes, &arguments.sweep, &arguments.out, &tell)?;
    bar.finish_and_clear();
    for file in swept.files {
        say!("{}", file.display());
    }
    match swept.failed {
        0 => Ok(()),
        failed => Err(End::Stopped(format!(
            "{failed} of {} runs failed or did not converge; the column `status` of sweep.csv tells why",
            swept.runs
        ))),
    }
}

fn show(bar: &ProgressBar, done: usize, all: usize, what: &str) {
    bar.set_length(all as u64);
    bar.set_position(done as u64);
    bar.set_message(what.to_owned());
}

fn print(found: &Report) {
    for (study, answer) in found.scenes.iter().zip(found.answers()) {
        say!("{}: {answer}", study.name);
    }
    let rows = found.rows();
    let done = rows.iter().filter(|row| row.is_done()).count();
    say!("{} runs; {} of them failed, as the tables show", rows.len(), rows.len() - done);
}

/// The bar is hidden if stderr is no terminal.
fn progress_bar() -> ProgressBar {
    let style =
        ProgressStyle::with_template("{bar:30} {pos:>4} of {len}  {elapsed}  {wide_msg}").expect("a valid template");
    ProgressBar::new(1).with_style(style)
}
