//! The smallest number of substeps at which an explicit method is stable; and the thesis' square of 10 × 10 cells, with too few substeps and
//! with enough: its figures 5.7 and 5.8.

use std::path::Path;

use fem_chart::grid;
use fem_engine::simulator::Simulator;
use fem_mesh::{Mesh, Pattern, rectangle_mesh};
use fem_model::Integrator;
use fem_model::simulation::{Diagnostics, Simulation};

use super::object::{LAME, OBJECTS, disturb, meshed, picture, simulator};
use crate::experiments::drawing::{Triangle, drawn, elements};
use crate::study::{Figure, Mark, Part, Problem, Result, Table};

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
pub fn run(data: &Path, quick: bool) -> Result<Part> {
    let (mut rows, mut wrong, mut implicit, mut judged) = (Vec::new(), Vec::new(), 0, 0);
    let objects = if quick { &OBJECTS[4..] } else { &OBJECTS[..] };
    for name in objects {
        let mesh = meshed(&picture(data, name)?, EDGE, 5)?.mesh;
        for lame in [0.1 * LAME, LAME, 10.0 * LAME] {
            let undamped = limit(&mesh, lame, 0.0)?;
            // The limit without damping is 2/ω, and ξ = β ω/2.
            for (words, beta, ratio) in [("none", 0.0, 0.0), ("stiffness", RATIO * undamped, RATIO)] {
                let limit = limit(&mesh, lame, beta)?;
                let substeps = (1.0 / FRAMES / limit).ceil().max(1.0) as usize;
                let lives = |substeps, frames| lives(&mesh, (lame, beta), EXPLICIT, (substeps, frames));
                // So near to the limit the growth may take longer than the run; one substep has none less.
                let grows = grows(2.0 / undamped, ratio, substeps - 1);
                let less = if grows { Some(lives(substeps - 1, LONG_RUN)?) } else { None };
                let lives = lives(substeps, RUN)?;
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
            implicit += usize::from(!lives(&mesh, (lame, 0.0), Integrator::ImplicitEuler, (1, RUN))?);
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
    let head = "object | >triangles | >λ = μ (Pa) | damping | >stable dt (ms) | >N | N substeps | N − 1 substeps";
    with_square(Part::new(text).marks(marks).tables([Table::new("flat-stability", head, rows)]))
}

/// The method whose limit is found.
const EXPLICIT: Integrator = Integrator::SemiImplicitEuler;

/// The time step with so many substeps in a frame, s.
fn substep(substeps: usize) -> f64 {
    1.0 / FRAMES / substeps as f64
}

/// The longest stable time step with a damping of β, s.
fn limit(mesh: &Mesh<2, 3>, lame: f64, beta: f64) -> Result<f64> {
    let simulation = simulator(mesh, (lame, beta), (EXPLICIT, substep(1)))?;
    Ok(simulation.critical_time_step().ok_or("the body has no stiffness")?)
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

/// Returns true if a disturbed body of λ = μ, Pa, and damping β, s, stays near its undeformed shape for a number of frames with so many substeps.
fn lives(
    mesh: &Mesh<2, 3>,
    moduli: (f64, f64),
    integrator: Integrator,
    (substeps, frames): (usize, usize),
) -> Result<bool> {
    let mut simulation = simulator(mesh, moduli, (integrator, substep(substeps)))?;
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

/// The thesis' damping, Pa s, and β, s.
const DAMPING: f64 = 250.0;
const BETA: f64 = DAMPING / LAME;
/// Substeps of the thesis: unstable and stable at 60 frames a second.
const THEIRS: [usize; 2] = [10, 40];
/// Size of the first displacements, m.
const FIRST: f64 = 0.02;
/// Frames of a run, and the displacement at which one that is drawn has exploded, m.
const SHOWN_RUN: usize = 60;
const SHOWN_EXPLODED: f64 = 0.15;

/// A run with one of two dampings.
struct Run {
    damping: &'static str,
    substeps: usize,
    lives: bool,
    is_as_predicted: bool,
}

fn word(lives: bool) -> &'static str {
    if lives { "live" } else { "explode" }
}

/// Adds the numbers of substeps of the square and its pictures to a part.
fn with_square(part: Part) -> Result<Part> {
    let square = rectangle_mesh([1.0, 1.0], 10, Pattern::Alternating)?;
    let mesh = Mesh::new(square.vertices.iter().map(|x| x.xy()).collect(), square.elements);
    let least = |beta: f64| Ok::<_, Problem>((1.0 / FRAMES / limit(&mesh, LAME, beta)?).ceil() as usize);
    let (undamped, damped) = (least(0.0)?, least(BETA)?);
    let mut runs = Vec::new();
    for (name, beta, least, counts) in [
        ("none", 0.0, undamped, &[undamped - 1, undamped][..]),
        ("the thesis'", BETA, damped, &[THEIRS[0], damped - 1, damped, THEIRS[1]]),
    ] {
        for &substeps in counts {
            let lives = lives(&mesh, (LAME, beta), EXPLICIT, (substeps, SHOWN_RUN))?;
            runs.push(Run { damping: name, substeps, lives, is_as_predicted: lives == (substeps >= least) });
        }
    }
    let told = |of: &Run| format!("{} {}", of.substeps, word(of.lives));
    let marks = [Mark::new(
        format!("square of 10 × 10 cells: N − 1 substeps explode and N live, N = {undamped} without damping and {damped} with the thesis'"),
        runs.iter().map(told).collect::<Vec<_>>().join(", "),
        runs.iter().all(|of| of.is_as_predicted),
    )
    .beside("10 explode, 40 live")];
    let table = Table::of(
        "flat-stability-square",
        &runs,
        &[
            ("damping", &|of| of.damping.to_owned()),
            (">substeps", &|of| of.substeps.to_string()),
            ("", &|of| word(of.lives).to_owned()),
        ],
    );
    let frame = [[-0.35, -0.35, 0.0], [1.35, 1.35, 0.0]];
    let picture = |of: &Run| {
        let (seconds, triangles) = end(&mesh, of.substeps)?;
        drawn(&format!("{} substeps, {seconds:.3} s", of.substeps), &triangles, frame)
    };
    let pictures = runs[2..].iter().map(picture).collect::<Result<Vec<_>>>()?;
    let caption = format!(
        "The square with a disturbance of {FIRST} m at the start, λ = μ = {LAME} Pa and the thesis' damping of {DAMPING} Pa s: after a second, or where it has moved by \
         {SHOWN_EXPLODED} m."
    );
    let picture = grid("a square with few and with many substeps", 2, &pictures);
    Ok(part.marks(marks).tables([table]).figures([Figure::new("flat-stability-square", picture, caption)]))
}

/// Runs the square until it has exploded, or to the last frame: the time, s, and its triangles.
fn end(mesh: &Mesh<2, 3>, substeps: usize) -> Result<(f64, Vec<Triangle>)> {
    let mut simulation = simulator(mesh, (LAME, BETA), (EXPLICIT, substep(substeps)))?;
    disturb(&mut simulation, FIRST);
    // The check of the energy would end the run before the growth shows in a picture.
    simulation.accept_gain(true);
    for _ in 0..SHOWN_RUN * substeps {
        let is_small = |entry: &f64| entry.abs() < SHOWN_EXPLODED;
        if simulation.step().is_err() || !simulation.state().u.as_flattened().iter().all(is_small) {
            break;
        }
    }
    Ok((simulation.time(), elements(&simulation)))
}
