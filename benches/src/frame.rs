//! The largest flat body that each method advances by a sixtieth of a second within a frame's budget of time, on one thread.

use std::path::Path;
use std::str::FromStr;

use fem_scene::Override;
use fem_study::machine::Machine;

use crate::cli::{FrameArguments, RunArguments};
use crate::end::End;
use crate::run::{self, Measurement};

/// Duration of a frame at 60 frames a second, s.
const FRAME: f64 = 1.0 / 60.0;
/// Part of the critical time step that explicit methods take; it shrinks where the moving body is stiffer than the undeformed one.
const PART_OF_CRITICAL: f64 = 0.8;
/// Cells per metre with which the search begins, and those with which it ends whatever the budget.
const CELLS: [usize; 2] = [2, 1024];
const LAWS: [&str; 2] = ["corotated", "stable_neo_hookean"];
const METHODS: [&str; 5] = ["semi_implicit_euler", "verlet", "rk4", "linearly_implicit_euler", "implicit_euler"];

/// A body and the time of its frames.
struct Frame {
    cells: usize,
    substeps: usize,
    run: Measurement,
}

impl Frame {
    /// Median time of a frame, s.
    fn seconds(&self) -> f64 {
        self.run.wall_per_step_median
    }
}

/// Searches the largest body for each method and law, and prints a table.
pub fn run(arguments: &FrameArguments) -> Result<(), End> {
    println!("{}\n", Machine::this(Path::new(".")).line());
    println!(
        "A sheet of 2 × 1 m (λ = μ = 45 kPa, 1000 kg/m³) that bends under its weight: the most triangles whose frame of 1/60 s takes at most {} ms on one thread.\n",
        arguments.budget
    );
    println!("| method | law | steps per frame | triangles | nodes | ms per frame |\n|---|---|---:|---:|---:|---:|");
    for method in METHODS {
        for law in LAWS {
            let (frame, problem) = largest(arguments, method, law)?;
            // A motion that a method cannot compute with a step of a frame is a finding.
            let finer = problem.map_or(String::new(), |problem| format!("; finer: {problem}"));
            let cells = match frame {
                Some(frame) => cells_of(&frame) + &finer,
                None => format!("– | fewer than {} | – | over the budget{finer}", 4 * CELLS[0] * CELLS[0]),
            };
            println!("| `{method}` | `{law}` | {cells} |");
        }
    }
    Ok(())
}

fn cells_of(frame: &Frame) -> String {
    let Measurement { elements, nodes, .. } = &frame.run;
    format!("{} | {elements} | {nodes} | {:.1}", frame.substeps, 1e3 * frame.seconds())
}

/// The finest mesh whose frame is within the budget, `None` if the coarsest is not; and why finer ones fail, if they do.
fn largest(arguments: &FrameArguments, method: &str, law: &str) -> Result<(Option<Frame>, Option<String>), End> {
    let [mut cells, most] = CELLS;
    let (mut within, mut beyond, mut problem) = (None, None, None);
    loop {
        match measured(arguments, method, law, cells) {
            Ok(frame) if 1e3 * frame.seconds() <= arguments.budget => within = Some(frame),
            Ok(_) => (beyond, problem) = (Some(cells), None),
            Err(End::Wrong(message)) => {
                let said = message.rsplit("error: ").next().unwrap_or_default();
                (beyond, problem) = (Some(cells), Some(said.to_owned()));
            }
            Err(end) => return Err(end),
        }
        let finest = within.as_ref().map_or(0, |frame| frame.cells);
        cells = match beyond {
            None if finest == most => return Ok((within, None)),
            None => (2 * finest).min(most),
            Some(beyond) if finest == 0 || (beyond - finest) * 50 <= finest || beyond - finest == 1 => {
                return Ok((within, problem));
            }
            Some(beyond) => finest.midpoint(beyond),
        };
    }
}

/// The median frame of one mesh, in a process of its own.
fn measured(arguments: &FrameArguments, method: &str, law: &str, cells: usize) -> Result<Frame, End> {
    let scene = scene(arguments, method, law, cells)?;
    let substeps = substeps(&scene)?;
    let mut timed = RunArguments { steps: Some(arguments.frames), ..scene };
    timed.overrides.push(key(&format!("time.substeps={substeps}"))?);
    let run = run::apart(&timed, 1)?;
    if run.unconverged_steps > 0 {
        let unconverged = run.unconverged_steps;
        return Err(End::wrong(format!(
            "{method}, {law}, {cells} cells per metre: {unconverged} steps have not converged"
        )));
    }
    Ok(Frame { cells, substeps, run })
}

fn scene(arguments: &FrameArguments, method: &str, law: &str, cells: usize) -> Result<RunArguments, End> {
    let keys = [
        format!("mesh.rectangle.cells_per_unit={cells}"),
        format!("material.model={law}"),
        format!("time.integrator={method}"),
    ];
    let mut overrides = keys.iter().map(|text| key(text)).collect::<Result<Vec<Override>, End>>()?;
    overrides.extend(arguments.overrides.iter().cloned());
    Ok(RunArguments {
        scene: concat!(env!("CARGO_MANIFEST_DIR"), "/frame.toml").to_owned(),
        steps: None,
        cells: None,
        solver: None,
        overrides,
        data: arguments.data.clone(),
    })
}

fn key(text: &str) -> Result<Override, End> {
    Override::from_str(text).map_err(|error| End::unusable(format!("{text}: {error}")))
}

/// Number of steps in a frame: one of an implicit method, as many as stability needs of an explicit one.
fn substeps(scene: &RunArguments) -> Result<usize, End> {
    let data = &scene.data;
    let scene = scene.scene().map_err(End::unusable)?;
    let body = fem_scene::body(&scene, data).map_err(End::unusable)?;
    let simulation = fem_engine::simulator::build(body, &scene.method()).map_err(End::unusable)?;
    Ok(simulation.critical_time_step().map_or(1, |critical| (FRAME / (PART_OF_CRITICAL * critical)).ceil() as usize))
}
