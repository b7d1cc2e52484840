//! The subcommand `experiment`: experiments of theses and published cases, beside their figures.

use std::path::PathBuf;

use clap::builder::PossibleValuesParser;
use clap::{Args, Subcommand};
use fem_study::experiments::{Experiments, benchmarks, flat, rtfem};

use super::Distribution;
use crate::course::Course;
use crate::end::End;

#[derive(Debug, Args)]
pub struct Arguments {
    #[command(subcommand)]
    experiment: Experiment,
}

#[derive(Debug, Subcommand)]
enum Experiment {
    /// Two-dimensional deformation: substeps, time, stiffness, triangles, plastic flow and contact of bodies from pictures
    Flat(Flat),
    /// Finite elements in real time: a squashed torus, its speed, precision, equilibrium, materials and other bodies
    Rtfem(Rtfem),
    /// Published benchmarks: NAFEMS, MacNeal and Harder, Cook, Turek and Hron, the elastica, Lee, Lamé, Hertz
    Benchmarks(Benchmarks),
}

#[derive(Debug, Args)]
struct Benchmarks {
    /// One case; all of them without it
    #[arg(value_parser = PossibleValuesParser::new(benchmarks::BENCHMARKS.parts()))]
    part: Option<String>,
    #[command(flatten)]
    options: Options,
}

#[derive(Debug, Args)]
struct Flat {
    /// One part; all of them without it
    #[arg(value_parser = PossibleValuesParser::new(flat::THESIS.parts()))]
    part: Option<String>,
    #[command(flatten)]
    options: Options,
}

#[derive(Debug, Args)]
struct Rtfem {
    /// One part; all of them without it
    #[arg(value_parser = PossibleValuesParser::new(rtfem::THESIS.parts()))]
    part: Option<String>,
    #[command(flatten)]
    options: Options,
}

#[derive(Debug, Args)]
struct Options {
    /// Folder for the page, a .csv of each table and an .svg of each picture [default: experiment-NAME]
    #[arg(long, value_name = "DIR")]
    out: Option<PathBuf>,
    /// Fewer and coarser bodies; times are not judged
    #[arg(long)]
    quick: bool,
    #[command(flatten)]
    distribution: Distribution,
}

/// Runs the experiment and writes its files. A mark that does not hold is an error.
pub fn run(course: &Course, arguments: &Arguments, merged: &[PathBuf]) -> Result<(), End> {
    let (of, part, options) = match &arguments.experiment {
        Experiment::Flat(Flat { part, options }) => (&flat::THESIS, part, options),
        Experiment::Rtfem(Rtfem { part, options }) => (&rtfem::THESIS, part, options),
        Experiment::Benchmarks(Benchmarks { part, options }) => (&benchmarks::BENCHMARKS, part, options),
    };
    let out = options.out.clone().unwrap_or_else(|| PathBuf::from(format!("experiment-{}", of.name)));
    let study = Experiments { of, part: part.as_deref(), data: &course.data(), quick: options.quick };
    super::end_of(course, &study, &out, options.distribution, merged)
}
