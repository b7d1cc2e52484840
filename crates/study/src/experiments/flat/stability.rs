//! The smallest number of substeps at which an explicit method is stable.

mod square;

use std::path::Path;

use fem_engine::simulator::Simulator;
use fem_mesh::Mesh;
use fem_model::simulation::{Diagnostics, Simulation};

use super::object::{LAME, OBJECTS, disturb, meshed, picture, simulator};
use crate::study::{Mark, Part, Table};

/// Frames in a second, frames of a stable run, and frames after which growth must show.
const FRAMES: f64 = 60.0;
const RUN: usize = 20;
const LONG_RUN: usize = 60;
/// Length of the edges, m, for a height of 1 m.
const EDGE: f64 = 0.1;
/// Damping ratio of the highest vibration in damped runs; it takes about the 22 substeps of the thesis' example in place of 6.
const RATIO: f64 = 1.7;
/// Size of the first displacements, m, and the size that a run of an unstable method passes. Both are far below the smallest triangles: there the
/// motion is linear, while a triangle that turns over limits its own growth.
const DISTURBANCE: f64 = 1e-9;
const EXPLODED: f64 = 1e-6;
/// Growth that shows within a run, e-folds.
const SHOWN: f64 = 15.0;

/// Finds the predicted number for five objects and three stiffnesses, damped and not, and runs it and one substep less.
pub fn run(data: &Path, quick: bool) -> Result<Part, String> {
    let (mut rows, mut wrong, mut implicit, mut judged) = (Vec::new(), Vec::new(), 0, 0);
    let objects = if quick { &OBJECTS[4..] } else { &OBJECTS[..] };
    for name in objects {
        let mesh = meshed(&picture(data, name)?, EDGE, 5)?.mesh;
        for lame in [0.1 * LAME, LAME, 10.0 * LAME] {
            let undamped = limit(&mesh, lame, "")?;
            // The limit without damping is 2/ω, and ξ = β ω/2.
            let damped = format!("[damping]\nbeta = {:e}\n", RATIO * undamped);
            for (words, damping, ratio) in [("none", "", 0.0), ("stiffness", &damped, RATIO)] {
                let limit = limit(&mesh, lame, damping)?;
                let substeps = (1.0 / FRAMES / limit).ceil().max(1.0) as usize;
                let lives = lives(&mesh, lame, damping, "semi_implicit_euler", (substeps, RUN))?;
                // So near to the limit the growth may take longer than the run; one substep has none less.
                let less = if grows(2.0 / undamped, ratio, substeps - 1) {
                    Some(self::lives(&mesh, lame, damping, "semi_implicit_euler", (substeps - 1, LONG_RUN))?)
                } else {
                    None
                };
                judged += usize::from(less.is_some());
                if !lives || less == Some(true) {
                    wrong.push(format!("{name}, λ = μ = {lame} Pa, damping: {words}"));
                }
                let told = |lives: bool| if lives { "lives" } else { "explodes" };
                rows.push(vec![
                    (*name).to_owned(),
                    format!("{}", mesh.elements.len()),
                    format!("{lame:.0}"),
                    words.to_owned(),
                    format!("{:.3}", 1e3 * limit),
                    substeps.to_string(),
                    told(lives).to_owned(),
                    less.map_or("at the limit", told).to_owned(),
                ]);
            }
            implicit += usize::from(!self::lives(&mesh, lame, "", "implicit_euler", (1, RUN))?);
        }
    }
    let runs = rows.len();
    let text = format!(
        "Semi-implicit Euler with lumped mass at {FRAMES} frames a second is stable for dt ≤ (2/ω)(√(1+ξ²) − ξ), with the largest frequency ω and its \
         damping ratio ξ. The damped rows have ξ = {RATIO} there. The thesis finds by trial that 10 substeps explode and 40 do not for λ = μ = 45 000 Pa, and \
         its damping makes it worse. Bodies are 1 m high with edges of {EDGE} m; N is the predicted number of substeps. Every run starts with a disturbance of {DISTURBANCE:e} m and takes {RUN} frames; N − 1 is at the limit where its growth would not show within {LONG_RUN}."
    );
    let statement = format!("in all {runs} rows N substeps live, and in the {judged} not at the limit N − 1 explode");
    let ours = if wrong.is_empty() { "as predicted".to_owned() } else { wrong.join("; ") };
    let marks = [
        Mark::new(statement, ours, wrong.is_empty()).beside("by trial: 10 explode, 40 live"),
        Mark::new("implicit Euler lives with one substep", format!("{implicit} explode"), implicit == 0),
    ];
    let head =
        ["object", ">triangles", ">λ = μ (Pa)", "damping", ">stable dt (ms)", ">N", "N substeps", "N − 1 substeps"];
    square::add(Part::new(text).marks(marks).tables([Table::new("flat-stability", &head, rows)]))
}

/// The table `[time]` of a method with so many substeps in a frame.
fn method(name: &str, substeps: usize) -> String {
    format!("integrator = \"{name}\"\ndt = {:e}", 1.0 / FRAMES / substeps as f64)
}

/// The longest stable time step, s.
fn limit(mesh: &Mesh<2, 3>, lame: f64, damping: &str) -> Result<f64, String> {
    let simulation = simulator(mesh, lame, &method("semi_implicit_euler", 1), damping)?;
    simulation.critical_time_step().ok_or_else(|| "the body has no stiffness".to_owned())
}

/// Returns true if a vibration with this frequency, 1/s, and damping ratio grows visibly within a run: λ² − (2 − z² − 2ξz) λ + 1 − 2ξz
/// = 0, z = ω dt.
fn grows(omega: f64, ratio: f64, substeps: usize) -> bool {
    let z = omega / FRAMES / substeps as f64;
    let (trace, determinant) = (2.0 - z * z - 2.0 * ratio * z, 1.0 - 2.0 * ratio * z);
    let discriminant = 0.25 * trace * trace - determinant;
    let largest = 0.5 * trace.abs() + discriminant.max(0.0).sqrt();
    discriminant > 0.0 && largest.ln() * (LONG_RUN * substeps) as f64 > SHOWN
}

/// Returns true if a disturbed body stays near its undeformed shape for a number of frames with so many substeps.
fn lives(
    mesh: &Mesh<2, 3>,
    lame: f64,
    damping: &str,
    integrator: &str,
    (substeps, frames): (usize, usize),
) -> Result<bool, String> {
    let mut simulation = simulator(mesh, lame, &method(integrator, substeps), damping)?;
    disturb(&mut simulation, DISTURBANCE);
    for _ in 0..frames * substeps {
        if simulation.step().is_err() || !(largest_displacement(&simulation) < EXPLODED) {
            return Ok(false);
        }
    }
    Ok(true)
}

fn largest_displacement(simulation: &Simulator<f64>) -> f64 {
    let entries = simulation.state().u.as_flattened().iter();
    // `max` would ignore a NaN.
    entries.fold(0.0, |largest: f64, entry| if entry.abs() <= largest { largest } else { entry.abs() })
}
