//! Single beside double precision over time.

use std::path::Path;

use fem_chart::{Axis, Chart, Dot, Guide, Series};
use fem_model::simulation::Simulation;

use super::setting::{DT, DURATION, LAWS, Setting, difference, displacements};
use super::torus::{Torus, sizes};
use crate::experiments::{Figure, Mark, Part, Table};

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
pub fn run(_: &Path, quick: bool) -> Result<Part, String> {
    let duration = if quick { 1.0 } else { DURATION };
    let main = Torus::of_size(if quick { 182 } else { 2000 })?;
    let mut runs = LAWS.iter().map(|law| compared(law, &main, duration)).collect::<Result<Vec<_>, _>>()?;
    for wanted in if quick { Vec::new() } else { sizes() } {
        if wanted != 2000 {
            runs.push(compared("linear", &Torus::of_size(wanted)?, duration)?);
        }
    }
    let marks = runs.iter().map(mark).collect();
    let row = |run: &Run, sample: &[f64; 3]| {
        let [time, difference, moved] = *sample;
        let first = [run.law.to_owned(), run.elements.to_string(), format!("{time:.3}")];
        first.into_iter().chain([difference, moved].map(|x| format!("{x:.3e}"))).collect()
    };
    let rows = runs.iter().flat_map(|run| run.samples.iter().map(move |sample| row(run, sample))).collect();
    Ok(Part {
        name: "precision",
        title: "Single and double precision",
        text: format!(
            "The same torus, load and steps in single and in double precision. The difference is the largest distance between two positions of a node, over the \
             diameter of the body, 2.92 m. Displacements are stored, not positions, so that digits are not lost to the size of the body. The thesis announces \
             this comparison and does not show it. In single precision {}.",
            if runs.iter().all(|run| run.unconverged == 0) {
                "every step has converged"
            } else {
                "some steps have not converged"
            }
        ),
        marks,
        tables: vec![Table {
            name: "rtfem-precision".to_owned(),
            head: vec![
                "law",
                ">elements",
                ">time (s)",
                ">difference over diameter",
                ">largest displacement over diameter",
            ],
            rows,
        }],
        figures: vec![Figure {
            name: "rtfem-precision".to_owned(),
            picture: chart(&runs[..LAWS.len()]).draw(),
            caption: "Largest difference between single and double precision, over the diameter.".to_owned(),
        }],
    })
}

/// One run in both precisions, step by step.
fn compared(law: &'static str, torus: &Torus, duration: f64) -> Result<Run, String> {
    let [mut double, mut single] = {
        let build = |precision| Setting { precision, ..Setting::of_law(law) }.torus(&torus.mesh);
        [build("f64")?, build("f32")?]
    };
    let count = (duration / DT).ceil() as usize;
    let mut samples = Vec::new();
    for step in 1..=count {
        for simulation in [&mut double, &mut single] {
            simulation.step().map_err(|failure| failure.to_string())?;
        }
        if step % EVERY == 0 || step == count {
            let (a, b) = (displacements(&*double), displacements(&*single));
            let still = vec![nalgebra::Vector3::zeros(); a.len()];
            samples.push([double.time(), difference(&a, &b), difference(&a, &still)]);
        }
    }
    Ok(Run { law, elements: torus.mesh.elements.len(), samples, unconverged: unconverged(&*single) })
}

fn unconverged(simulation: &dyn Simulation) -> usize {
    simulation.counters().unconverged_steps
}

fn mark(run: &Run) -> Mark {
    let [time, difference, _] = run.samples.last().copied().unwrap_or([f64::NAN; 3]);
    let statement = format!(
        "{}, {} elements: after {time:.1} s f32 and f64 agree within {LARGEST:e} of the body's size",
        run.law, run.elements
    );
    Mark::new(statement, format!("{difference:.1e}"), difference <= LARGEST)
}

fn chart(runs: &[Run]) -> Chart {
    let mut chart =
        Chart::new("single beside double precision", Axis::linear("time (s)"), Axis::log("difference over diameter"));
    chart.series = runs
        .iter()
        .enumerate()
        .map(|(number, run)| Series {
            name: run.law.to_owned(),
            colour: number,
            is_joined: true,
            dots: run.samples.iter().map(|sample| Dot { x: sample[0], y: sample[1], ..Dot::default() }).collect(),
            ..Series::default()
        })
        .collect();
    chart.guides.push(Guide::Horizontal(LARGEST, format!("{LARGEST:e}")));
    chart
}
