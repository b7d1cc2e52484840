//! The arguments, as types.

use std::path::PathBuf;

use clap::{Args, Parser, Subcommand, ValueEnum};
use fem_model::{Preconditioner, SolverKind, Volumetric};
use fem_scene::tables::SolverTable;
use fem_scene::{Override, Scene};

/// Times the engine: beside its peers, part by part, by size, by solver and by frames.
#[derive(Debug, Parser)]
#[command(version, after_help = "Exit codes: 0 done, 1 answers disagree or a run failed, 2 unusable arguments.")]
pub struct Arguments {
    #[command(subcommand)]
    pub command: Command,
    /// Put what the command prints into this page, under the line that names the command
    #[arg(long, value_name = "FILE", global = true)]
    pub book: Option<PathBuf>,
}

/// The arguments without `--book` and its file.
pub fn without_book(arguments: impl Iterator<Item = String>) -> Vec<String> {
    let (mut kept, mut is_file) = (Vec::new(), false);
    for argument in arguments {
        if !std::mem::replace(&mut is_file, argument == "--book") && !is_file && !argument.starts_with("--book=") {
            kept.push(argument);
        }
    }
    kept
}

#[derive(Debug, Subcommand)]
pub enum Command {
    /// The course's pipeline on its own scenes
    Course(CourseArguments),
    /// The engine and its peers in turn, on the same scenes: a table of times per step, and whether answers agree
    Peers(PeersArguments),
    /// The costs of the parts of a step
    Parts(RunArguments),
    /// A box from 1 000 to 60 000 nodes and more: time per step, its exponent, memory
    Scaling(ScalingArguments),
    /// The beam with each linear solver
    Solvers(SizesArguments),
    /// Bodies of increasing size on the graphics device and on the processor, and the size from which the device is faster
    Gpu(SizesArguments),
    /// The largest flat body that each method advances by 1/60 s within a frame, on one thread
    Frame(FrameArguments),
    /// Runs a scene once and prints its times as JSON
    Run(RunArguments),
    /// Solves a published solid and prints value, unknowns and time as JSON; benches/peers/statics/compare.py runs it beside other programs
    Statics(StaticsArguments),
}

#[derive(Debug, Args)]
pub struct PeersArguments {
    /// The program `a3`, in C++ with Eigen
    #[arg(long, value_name = "PROGRAM")]
    pub eigen: Option<PathBuf>,
    /// The program `fenris_peer`, in Rust with fenris
    #[arg(long, value_name = "PROGRAM")]
    pub fenris: Option<PathBuf>,
    /// Number of runs of each
    #[arg(long, value_name = "N", default_value_t = 5, value_parser = positive)]
    pub rounds: usize,
    /// Steps of each run instead of the scene's
    #[arg(long, value_name = "N", value_parser = positive)]
    pub steps: Option<usize>,
    /// Cells per metre of the beam
    #[arg(long, value_name = "N,N", value_delimiter = ',', default_values_t = [6, 10, 16], value_parser = positive)]
    pub cells: Vec<usize>,
    /// Folder of meshes and scenes
    #[arg(long, value_name = "DIR", default_value = "data")]
    pub data: PathBuf,
    /// Write the table as JSON
    #[arg(long, value_name = "FILE")]
    pub json: Option<PathBuf>,
}

#[derive(Debug, Args)]
pub struct CourseArguments {
    /// Steps of each run
    #[arg(long, value_name = "N", default_value_t = 200, value_parser = positive)]
    pub steps: usize,
    /// Folder of meshes and scenes
    #[arg(long, value_name = "DIR", default_value = "data")]
    pub data: PathBuf,
}

#[derive(Debug, Args)]
pub struct SizesArguments {
    /// Cells per metre of the beam; the default depends on the command
    #[arg(long, value_name = "N,N", value_delimiter = ',', value_parser = positive)]
    pub cells: Vec<usize>,
    /// Steps of each run
    #[arg(long, value_name = "N", default_value_t = 20, value_parser = positive)]
    pub steps: usize,
    /// Number of runs of each
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = positive)]
    pub rounds: usize,
    /// Folder of meshes and scenes
    #[arg(long, value_name = "DIR", default_value = "data")]
    pub data: PathBuf,
}

#[derive(Debug, Args)]
pub struct ScalingArguments {
    #[command(flatten)]
    pub sizes: SizesArguments,
    /// Scene of a box; `cantilever` with `--steps 1` and 13,20,29 cells per metre is an equilibrium of up to 209 700 nodes
    #[arg(long, value_name = "NAME", default_value = "beam")]
    pub scene: String,
    /// Linear solver instead of the scene's
    #[arg(long, value_name = "NAME")]
    pub solver: Option<SolverName>,
}

#[derive(Debug, Args)]
pub struct FrameArguments {
    /// Longest time of a frame, ms
    #[arg(long, value_name = "MS", default_value_t = 16.0, value_parser = duration)]
    pub budget: f64,
    /// Frames of each run, whose median counts
    #[arg(long, value_name = "N", default_value_t = 30, value_parser = positive)]
    pub frames: usize,
    /// Value of a key of benches/frame.toml; repeatable
    #[arg(long = "set", value_name = "TABLE.KEY=VALUE")]
    pub overrides: Vec<Override>,
    /// Folder of meshes and scenes
    #[arg(long, value_name = "DIR", default_value = "data")]
    pub data: PathBuf,
}

/// A scene with overrides.
#[derive(Clone, Debug, Args)]
pub struct RunArguments {
    /// Name of a scene or path of a .toml file
    pub scene: String,
    /// Steps instead of the scene's
    #[arg(long, value_name = "N", value_parser = positive)]
    pub steps: Option<usize>,
    /// Cells per metre of a box
    #[arg(long, value_name = "N", value_parser = positive)]
    pub cells: Option<usize>,
    /// Linear solver instead of the scene's
    #[arg(long, value_name = "NAME")]
    pub solver: Option<SolverName>,
    /// Value of a key instead of the scene's; repeatable
    #[arg(long = "set", value_name = "TABLE.KEY=VALUE")]
    pub overrides: Vec<Override>,
    /// Folder of meshes and scenes
    #[arg(long, value_name = "DIR", default_value = "data")]
    pub data: PathBuf,
}

/// An equilibrium on a structured mesh of tetrahedra.
#[derive(Debug, Args)]
pub struct StaticsArguments {
    pub case: StaticsCase,
    /// Cells along the three edges of the box that is mapped to the body
    #[arg(long, value_name = "N,N,N", value_delimiter = ',', value_parser = positive, required = true)]
    pub cells: Vec<usize>,
    /// Order of the elements, 1 or 2
    #[arg(long, value_name = "N", default_value_t = 2)]
    pub order: usize,
    /// Evaluation of the energy of the volume
    #[arg(long, value_name = "NAME")]
    pub volumetric: Option<VolumetricName>,
    /// Linear solver instead of the one that the engine chooses
    #[arg(long, value_name = "NAME")]
    pub solver: Option<SolverName>,
    /// Equal parts of the load
    #[arg(long, value_name = "N", default_value_t = 1, value_parser = positive)]
    pub load_steps: usize,
    /// Number of solutions, of which the fastest counts
    #[arg(long, value_name = "N", default_value_t = 3, value_parser = positive)]
    pub rounds: usize,
}

/// A solid of `statics`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum StaticsCase {
    /// NAFEMS LE10: stress of a thick elliptic plate under pressure
    Le10,
    /// The twisted beam of MacNeal and Harder: displacement of its end along the end's long side
    Twisted,
    /// A quarter of a nearly incompressible block under a pressure on the middle of its top: displacement of the top's centre
    Block,
}

/// A value of `material.volumetric`.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum VolumetricName {
    Standard,
    Averaged,
    Mixed,
}

impl From<VolumetricName> for Volumetric {
    fn from(name: VolumetricName) -> Self {
        match name {
            VolumetricName::Standard => Self::Standard,
            VolumetricName::Averaged => Self::Averaged,
            VolumetricName::Mixed => Self::Mixed,
        }
    }
}

/// A linear solver with its preconditioner.
#[derive(Clone, Copy, Debug, PartialEq, Eq, ValueEnum)]
#[value(rename_all = "snake_case")]
pub enum SolverName {
    Cholesky,
    BlockJacobi,
    Multigrid,
    Ssor,
}

impl SolverName {
    /// The table `[solver]` of a scene.
    pub fn table(self) -> SolverTable {
        let (kind, preconditioner) = match self {
            Self::Cholesky => (SolverKind::Cholesky, None),
            Self::BlockJacobi => (SolverKind::Pcg, Some(Preconditioner::BlockJacobi)),
            Self::Multigrid => (SolverKind::Pcg, Some(Preconditioner::Multigrid)),
            Self::Ssor => (SolverKind::Pcg, Some(Preconditioner::Ssor)),
        };
        SolverTable { kind, tolerance: None, preconditioner, precision: None }
    }

    /// The name on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Self::Cholesky => "cholesky",
            Self::BlockJacobi => "block_jacobi",
            Self::Multigrid => "multigrid",
            Self::Ssor => "ssor",
        }
    }
}

impl RunArguments {
    /// The scene with the overrides.
    pub fn scene(&self) -> Result<Scene, String> {
        let mut scene =
            fem_scene::load_with(&self.scene, &self.data, &self.overrides).map_err(|error| error.to_string())?;
        scene.time.steps = self.steps.or(scene.time.steps);
        if let Some(solver) = self.solver {
            scene.solver = Some(solver.table());
        }
        match (self.cells, &mut scene.mesh.cuboid) {
            (None, _) => {}
            (Some(cells), Some(cuboid)) => cuboid.cells_per_unit = cells,
            (Some(_), None) => return Err(format!("--cells: {} is no box; leave it out", self.scene)),
        }
        Ok(scene)
    }
}

/// Positive numbers.
fn duration(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(number) if number.is_finite() && number > 0.0 => Ok(number),
        _ => Err("give a positive number of milliseconds".to_owned()),
    }
}

/// Whole numbers from 1 on.
fn positive(text: &str) -> Result<usize, String> {
    match text.parse() {
        Ok(0) | Err(_) => Err("give a whole number, 1 or more".to_owned()),
        Ok(number) => Ok(number),
    }
}
