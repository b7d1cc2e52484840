//! The subcommand `report`: error against run time.

use std::path::PathBuf;

use clap::Args;
use fem_scene::Scene;
use fem_study::linear::{self, LinearSolvers};
use fem_study::report::ErrorStudy;
use fem_study::studies::Settings;

use super::Distribution;
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
    #[command(flatten)]
    pub distribution: Distribution,
}

/// Studies the scenes, writes the report, and prints the fastest method for each error.
pub fn run(course: &Course, arguments: &Arguments, merged: &[PathBuf]) -> Result<(), End> {
    let Arguments { scenes: names, out, quick, sweep, linear, distribution } = arguments;
    if !sweep.is_empty() {
        return super::sweep::run(course, names, sweep, out.clone(), *distribution, merged);
    }
    let data = course.data();
    let scenes = names.iter().map(|name| fem_scene::load(name, &data).map_err(End::unusable));
    let scenes: Vec<Scene> = scenes.collect::<Result<_, _>>()?;
    if *linear {
        let body = |scene: Scene| {
            let body = build::body(course, &scene)?;
            linear::check(&scene, &body).map_err(End::unusable)?;
            Ok((scene, body))
        };
        let systems = scenes.into_iter().map(body).collect::<Result<_, End>>()?;
        let study = LinearSolvers { systems, quick: *quick, names };
        return super::end_of(course, &study, out, *distribution, merged);
    }
    let bar = super::progress_bar();
    let tell = |done: usize, all: usize, what: &str| super::show(&bar, done, all, what);
    let factory = |scene: &Scene| super::simulation(course, scene);
    let settings = Settings { data, out: out.clone(), is_quick: *quick, factory: &factory, tell: &tell };
    let study = ErrorStudy { settings, scenes, names };
    super::end_told_by(&bar, course, &study, out, *distribution, merged)
}
