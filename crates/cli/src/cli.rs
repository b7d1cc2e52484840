//! Command line arguments as types.

use std::num::NonZeroUsize;
use std::path::PathBuf;
use std::time::Duration;

use clap::{Args, Parser, Subcommand};
use fem_model::Integrator;
use fem_output::ElementField;
use fem_scene::Override;

use crate::mesh::MeshAction;
use crate::probes::ProbeArgument;
use crate::study::Study;

/// Deformable solids by the finite element method: shows a scene in a window, or runs it without one.
#[derive(Debug, Parser)]
#[command(name = "finite-elements-3d", version, args_conflicts_with_subcommands = true, after_help = EXIT_CODES)]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Option<Command>,
    #[command(flatten)]
    pub run: RunArguments,
}

const EXIT_CODES: &str = "\
Keys in the window: S skinned or simulation mesh, C colours, T picture, F contact forces, N next integrator, space pause, R reset;
drag the body to pull it.

Ctrl-C ends a run after its step, or closes the window, and writes what the options ask for; a second one ends it at once.

Exit codes: 0 done, 1 the simulation failed, 2 unusable arguments or scene, 130 ended by Ctrl-C, 143 by SIGTERM.";

#[derive(Debug, Subcommand)]
pub enum Command {
    /// Lists the scenes, one line each, with the parts that each builds
    List,
    /// Reads, checks, measures and converts meshes
    Mesh {
        #[command(subcommand)]
        action: MeshAction,
    },
    #[command(flatten)]
    Study(Study),
}

#[derive(Debug, Args)]
pub struct RunArguments {
    /// Name of a scene (see `list`) or path of a .toml file
    #[arg(default_value = "bunny", value_name = "SCENE")]
    pub scene: String,
    /// Run without a window
    #[arg(long)]
    pub headless: bool,
    /// End after N steps
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = positive_steps)]
    pub steps: Option<usize>,
    /// Time step in seconds
    #[arg(long, value_name = "S", allow_negative_numbers = true, value_parser = positive_seconds)]
    pub dt: Option<f64>,
    /// Time integration method
    #[arg(long, value_name = "NAME", value_parser = integrator)]
    pub integrator: Option<Integrator>,
    /// Override a key of the scene, such as material.young=1e5 or traction.0.pressure=5; repeatable
    #[arg(long, value_name = "TABLE.KEY=VALUE")]
    pub set: Vec<Override>,
    /// Write time, positions and velocities at the end, and what --resume needs
    #[arg(long, value_name = "FILE.json")]
    pub state: Option<PathBuf>,
    /// Go on from a file of --state or --checkpoint as if the run had not been interrupted
    #[arg(long, value_name = "FILE.json")]
    pub resume: Option<PathBuf>,
    /// Write the state now and then, so that a run which is killed can go on; opens no window
    #[arg(long, value_name = "FILE.json")]
    pub checkpoint: Option<PathBuf>,
    /// Minutes between checkpoints
    #[arg(long, value_name = "MINUTES", default_value = "10", requires = "checkpoint", value_parser = minutes)]
    pub checkpoint_every: Duration,
    /// Write position, velocity and force of a node in every step; NAME is `highest` or a set of the mesh; repeatable
    #[arg(long, value_name = "NODE|NAME=FILE.csv")]
    pub probe: Vec<ProbeArgument>,
    /// Write counts and times
    #[arg(long, value_name = "FILE.json")]
    pub stats: Option<PathBuf>,
    /// Write the energies of every step
    #[arg(long, value_name = "FILE.csv")]
    pub energies: Option<PathBuf>,
    /// Write the final mesh: .obj (display), .vtu (ParaView), .glb (animated, Blender)
    #[arg(long, value_name = "FILE")]
    pub export: Option<PathBuf>,
    /// Write the mesh with its fields at every step and a .pvd that lists them (ParaView); opens no window
    #[arg(long, value_name = "DIR")]
    pub vtu_series: Option<PathBuf>,
    /// Write every Nth step of the series only
    #[arg(long, value_name = "N", default_value = "1", requires = "vtu_series")]
    pub every: NonZeroUsize,
    /// Take a picture at the end
    #[arg(long, value_name = "FILE.png")]
    pub screenshot: Option<PathBuf>,
    /// Take 30 pictures a second of simulated time
    #[arg(long, value_name = "DIR")]
    pub record: Option<PathBuf>,
    /// Colour the elements in the window and in pictures: stress (von Mises), pressure, stress_error (estimated), displacement,
    /// plastic_strain or quality
    #[arg(long, value_name = "FIELD")]
    pub color: Option<ElementField>,
    /// Print the parts that the scene builds and those that it leaves out, and why, then exit
    #[arg(long)]
    pub explain: bool,
}

fn positive_steps(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(0) | Err(_) => Err("give a whole number of steps, 1 or more".to_owned()),
        Ok(steps) => Ok(steps),
    }
}

fn positive_seconds(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(seconds) if seconds > 0.0 && seconds.is_finite() => Ok(seconds),
        _ => Err("give a positive number of seconds, such as 0.01".to_owned()),
    }
}

fn minutes(text: &str) -> Result<Duration, String> {
    let seconds = text.parse::<f64>().ok().map(|minutes| 60.0 * minutes).filter(|seconds| *seconds >= 0.0);
    let duration = seconds.and_then(|seconds| Duration::try_from_secs_f64(seconds).ok());
    duration.ok_or_else(|| "give a number of minutes, 0 or more, such as 0.5; 0 writes after every step".to_owned())
}

fn integrator(text: &str) -> Result<Integrator, String> {
    let names = || Integrator::ALL.map(Integrator::name).join(", ");
    Integrator::from_name(text).ok_or_else(|| format!("give one of {}", names()))
}
