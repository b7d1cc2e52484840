//! Single beside double precision over time.

use std::path::Path;

use fem_chart::{Axis, Chart, Guide, Series};
use fem_model::Precision;
use nalgebra::Vector3;

use super::setting::{DT, DURATION, LAWS, Setting, difference};
use super::torus::{Torus, sizes};
use crate::scenes::displacements;
use crate::study::{Mark, Part, Result, Table};

/// Largest difference at the end, over the diameter of the body.
const LARGEST: f64 = 1e-5;

/// Steps between two comparisons.
const EVERY: usize = 10;

/// The difference of one law on one mesh over time.
struct Run {
    law: &'static str,
    elements: usize,
    /// Time (s), difference over the diameter, largest displacement over the diameter.
    samples: Vec<[f64; 3]>,
    unconverged: usize,
}

/// Runs every law on one mesh, and the linear law on all.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let duration = if quick { 1.0 } else { DURATION };
    let main = Torus::of_size(if quick { 182 } else { 2000 })?;
    let mut runs = LAWS.iter().map(|law| compared(law, &main, duration)).collect::<Result<Vec<_>>>()?;
    for wanted in if quick { Vec::new() } else { sizes() } {
        if wanted != 2000 {
            runs.push(compared("linear", &Torus::of_size(wanted)?, duration)?);
        }
    }
    let marks: Vec<Mark> = runs.iter().map(mark).collect();
    let is_converged = runs.iter().all(|run| run.unconverged == 0);
    let text = format!(
        "The same torus, load and steps in single and in double precision. The difference is the largest distance between two positions of a node, over the \
         diameter of the body, 2.92 m. Displacements are stored, not positions, so that digits are not lost to the size of the body. The thesis announces \
         this comparison and does not show it. In single precision {}.",
        if is_converged { "every step has converged" } else { "some steps have not converged" }
    );
    let rows: Vec<(&Run, [f64; 3])> =
        runs.iter().flat_map(|run| run.samples.iter().map(move |sample| (run, *sample))).collect();
    let table = Table::of(
        "rtfem-precision",
        &rows,
        &[
            ("law", &|(run, _)| run.law.to_owned()),
            (">elements", &|(run, _)| run.elements.to_string()),
            (">time (s)", &|(_, sample)| format!("{:.3}", sample[0])),
            (">difference over diameter", &|(_, sample)| format!("{:.3e}", sample[1])),
            (">largest displacement over diameter", &|(_, sample)| format!("{:.3e}", sample[2])),
        ],
    );
    let caption = "Largest difference between single and double precision, over the diameter.";
    Ok(Part::new(text).marks(marks).tables([table]).chart("rtfem-precision", &chart(&runs[..LAWS.len()]), caption))
}

/// One run in both precisions, step by step.
fn compared(law: &'static str, torus: &Torus, duration: f64) -> Result<Run> {
    let build = |precision| Setting { precision, ..Setting::of_law(law) }.torus(&torus.mesh);
    let (mut double, mut single) = (build(Precision::F64)?, build(Precision::F32)?);
    let still = vec![Vector3::zeros(); torus.mesh.vertices.len()];
    let count = (duration / DT).ceil() as usize;
    let mut samples = Vec::new();
    for step in 1..=count {
        for simulation in [&mut double, &mut single] {
            simulation.step()?;
        }
        if step % EVERY == 0 || step == count {
            let (a, b) = (displacements(&*double), displacements(&*single));
            samples.push([double.time(), difference(&a, &b), difference(&a, &still)]);
        }
    }
    Ok(Run { law, elements: torus.mesh.elements.len(), samples, unconverged: single.counters().unconverged_steps })
}

fn mark(run: &Run) -> Mark {
    let [time, difference, _] = run.samples.last().copied().unwrap_or([f64::NAN; 3]);
    let statement = format!(
        "{}, {} elements: after {time:.1} s f32 and f64 agree within {LARGEST:e} of the body's size",
        run.law, run.elements
    );
    Mark::at_most(statement, difference, LARGEST)
}

fn chart(runs: &[Run]) -> Chart {
    let mut chart =
        Chart::new("single beside double precision", Axis::linear("time (s)"), Axis::log("difference over diameter"));
    chart.series = runs
        .iter()
        .enumerate()
        .map(|(number, run)| Series::line(run.law, number, run.samples.iter().map(|sample| (sample[0], sample[1]))))
        .collect();
    chart.guides.push(Guide::Horizontal(LARGEST, format!("{LARGEST:e}")));
    chart
}
