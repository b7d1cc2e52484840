//! The thesis' square of 10 × 10 cells, with too few substeps and with enough: its figures 5.7 and 5.8.

use fem_chart::grid;
use fem_mesh::{Mesh, Pattern, rectangle_mesh};
use fem_model::simulation::Simulation;

use super::{FRAMES, limit, lives, method};
use crate::experiments::drawing::{Triangle, drawn, elements};
use crate::experiments::flat::object::{LAME, disturb, simulator};
use crate::study::{Figure, Mark, Part, Table};

/// The thesis' damping, Pa s.
const DAMPING: f64 = 250.0;
/// Substeps of the thesis: unstable and stable at 60 frames a second.
const THEIRS: [usize; 2] = [10, 40];
/// Size of the first displacements, m.
const DISTURBANCE: f64 = 0.02;
/// Frames of a run, and the displacement at which one that is drawn has exploded, m.
const RUN: usize = 60;
const EXPLODED: f64 = 0.15;

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
pub fn add(part: Part) -> Result<Part, String> {
    let square = rectangle_mesh([1.0, 1.0], 10, Pattern::Alternating).map_err(|error| error.to_string())?;
    let mesh = Mesh::new(square.vertices.iter().map(|x| x.xy()).collect(), square.elements);
    let damping = format!("[damping]\nbeta = {:e}\n", DAMPING / LAME);
    let least = |damping: &str| Ok::<_, String>((1.0 / FRAMES / limit(&mesh, LAME, damping)?).ceil() as usize);
    let (undamped, damped) = (least("")?, least(&damping)?);
    let mut runs = Vec::new();
    for (name, damping, least, counts) in [
        ("none", "", undamped, &[undamped - 1, undamped][..]),
        ("the thesis'", &damping, damped, &[THEIRS[0], damped - 1, damped, THEIRS[1]]),
    ] {
        for &substeps in counts {
            let lives = lives(&mesh, LAME, damping, "semi_implicit_euler", (substeps, RUN))?;
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
        let (seconds, triangles) = end(&mesh, &damping, of.substeps)?;
        drawn(&format!("{} substeps, {seconds:.3} s", of.substeps), &triangles, frame)
    };
    let pictures = runs[2..].iter().map(picture).collect::<Result<Vec<_>, _>>()?;
    let caption = format!(
        "The square with a disturbance of {DISTURBANCE} m at the start, λ = μ = {LAME} Pa and the thesis' damping of {DAMPING} Pa s: after a second, or where it has moved by \
         {EXPLODED} m."
    );
    let picture = grid("a square with few and with many substeps", 2, &pictures);
    Ok(part.marks(marks).tables([table]).figures([Figure {
        name: "flat-stability-square".to_owned(),
        picture,
        caption,
    }]))
}

/// Runs the square until it has exploded, or to the last frame: the time, s, and its triangles.
fn end(mesh: &Mesh<2, 3>, damping: &str, substeps: usize) -> Result<(f64, Vec<Triangle>), String> {
    let mut simulation = simulator(mesh, LAME, &method("semi_implicit_euler", substeps), damping)?;
    disturb(&mut simulation, DISTURBANCE);
    // The check of the energy would end the run before the growth shows in a picture.
    simulation.accept_gain(true);
    for _ in 0..RUN * substeps {
        let is_small = |entry: &f64| entry.abs() < EXPLODED;
        if simulation.step().is_err() || !simulation.state().u.as_flattened().iter().all(is_small) {
            break;
        }
    }
    Ok((simulation.time(), elements(&simulation)))
}
