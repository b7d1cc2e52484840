//! Time of a frame of 40 explicit substeps.

use std::path::Path;
use std::time::Instant;

use fem_chart::{Axis, Chart, Dot, Guide, Series};
use fem_model::Integrator;
use fem_model::simulation::Simulation;

use super::object::{LAME, disturb, meshed, picture, simulator};
use crate::study::{Mark, Part, Result, Table};

/// Substeps of a frame, and their time in the thesis, ms.
const SUBSTEPS: usize = 40;
const THEIRS: f64 = 58.8;
/// Number of triangles whose frame is judged; the thesis does not give its own.
const JUDGED: f64 = 1000.0;
/// Edges of the donut, m, for a height of 1 m: 250 to 16 000 triangles.
const EDGES: [f64; 4] = [0.0775, 0.0388, 0.0194, 0.0097];
/// Frames that are timed.
const FRAMES: usize = 30;

/// Times frames of the donut on one thread.
pub fn run(data: &Path, quick: bool) -> Result<Part> {
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build()?;
    one.install(|| timed(data, quick))
}

fn timed(data: &Path, quick: bool) -> Result<Part> {
    let picture = picture(data, "donut")?;
    let (mut rows, mut dots) = (Vec::new(), Vec::new());
    let mut judged = f64::INFINITY;
    for edge in &EDGES[..if quick { 2 } else { EDGES.len() }] {
        let mesh = meshed(&picture, *edge, 5)?;
        let mut simulation = simulator(&mesh.mesh, (LAME, 0.0), (Integrator::SemiImplicitEuler, 1e-5))?;
        disturb(&mut simulation, 1e-6);
        let mut frames = Vec::new();
        for _ in 0..if quick { 3 } else { FRAMES } {
            let start = Instant::now();
            for _ in 0..SUBSTEPS {
                simulation.step()?;
            }
            frames.push(1e3 * start.elapsed().as_secs_f64());
        }
        frames.sort_by(f64::total_cmp);
        let (triangles, median) = (mesh.mesh.elements.len() as f64, frames[frames.len() / 2]);
        if (triangles / JUDGED - 1.0).abs() < 0.1 {
            judged = median;
        }
        rows.push(vec![
            format!("{triangles}"),
            format!("{median:.3}"),
            format!("{:.2}", 1e3 * median / SUBSTEPS as f64),
            format!("{:.0}", 1e6 * median / SUBSTEPS as f64 / triangles),
        ]);
        let title = format!("{triangles} triangles\n{median:.3} ms a frame");
        dots.push(Dot::new(triangles, median, title));
    }
    let mut chart =
        Chart::new("time of a frame of 40 substeps", Axis::log("triangles"), Axis::log("time of a frame (ms)"));
    chart.series = vec![Series::joined("", (0, 0), dots)];
    chart.guides = vec![
        Guide::Horizontal(THEIRS, "the thesis, 58.8 ms".to_owned()),
        Guide::Horizontal(0.1 * THEIRS, "a tenth of it".to_owned()),
    ];
    let statement = format!("a frame of {SUBSTEPS} substeps of about {JUDGED} triangles under a tenth of {THEIRS} ms");
    let mark = Mark::new(statement, format!("{judged:.2} ms"), judged < 0.1 * THEIRS).beside("58.8 ms").unless(quick);
    let text = format!(
        "The donut in corotated elasticity by semi-implicit Euler with lumped mass, {SUBSTEPS} substeps a frame, on one thread. The thesis gives 1.47 ms \
         a substep and 17 frames a second, without the number of its triangles."
    );
    let head = ">triangles | >ms a frame | >µs a substep | >ns a substep and triangle";
    let part = Part::new(text).marks([mark]).tables([Table::new("flat-speed", head, rows)]);
    Ok(part.chart("flat-speed", &chart, "Median of the frames, on one thread."))
}
