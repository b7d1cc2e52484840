//! The end of the motion beside the equilibrium, and the equilibrium beside that of a finer mesh.

use std::path::Path;

use fem_chart::{Axis, Chart, Dot, Guide, Series};
use fem_mesh::volumes;

use super::setting::{BETA, DT, DURATION, LAWS, Setting, difference, equilibrium, squash};
use super::torus::{Torus, sizes};
use crate::scenes::{displacements, step};
use crate::study::{Mark, Part, Result, Table};

/// Distance from equilibrium, over the diameter, at which a motion has ended, and the time (s) at which it must have.
const ENDED: f64 = 1e-8;
const LONGEST: f64 = 120.0;

/// Largest relative deviation of the remainder at 15 s from its closed form.
const REMAINDER: f64 = 0.02;

/// Largest error of the flexibility of the largest torus.
const FLEXIBILITY: f64 = 0.05;

/// The motion and the equilibrium of one size.
struct Found {
    torus: Torus,
    /// Distance from equilibrium over the diameter at 15 s and at the end, and that of the undeformed body.
    remainder: f64,
    last: f64,
    whole: f64,
    /// Time of the end, s.
    time: f64,
    /// Approach of the loaded sides by the three laws, m, and the load of a side, N.
    squashes: Vec<f64>,
    load: f64,
}

/// Runs every size until its motion has ended.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let chosen = if quick { vec![182] } else { sizes() };
    let found = chosen.into_iter().map(|wanted| ended(Torus::of_size(wanted)?)).collect::<Result<Vec<_>>>()?;
    let finest = found.iter().map(|of| of.torus.edge).fold(f64::INFINITY, f64::min);
    let finer = if quick { 2.0 } else { 4.0 };
    let reference = Torus::of_edge(finest / finer)?;
    let (approach, load) = squash(&reference.mesh, &equilibrium(&Setting::default(), &reference.mesh)?);
    let flexibility = approach / load;
    let elements = reference.mesh.elements.len();
    let error = |of: &Found| of.squashes[0] / of.load / flexibility - 1.0;
    let text = format!(
        "With β = {BETA} s every elastic vibration is overdamped: the distance from equilibrium falls by 1 + dt/β in each step, so that 0.25 % of it are left \
         after 15 s. The torus of the thesis is still moving then. The runs go on until {ENDED:e} of the diameter are left. The error of a mesh is that of \
         its flexibility, the approach of the loaded sides over their load, against a mesh of {elements} tetrahedra whose edges are {finer} times shorter than those of the \
         largest torus here. Linear tetrahedra are too stiff in bending; few of them across the tube cost most of the deflection."
    );
    let marks = found.iter().flat_map(marks).chain(near(&found, &error));
    let caption = "Part of the flexibility that a mesh lacks.";
    let part = Part::new(text).marks(marks).tables([table(&found, &error)]);
    Ok(part.chart("rtfem-error", &chart(&found, &error), caption))
}

/// Part of the distance that is left after 15 s: the mass is negligible, so that β K u̇ + K u = f.
fn closed_form() -> f64 {
    (1.0 + DT / BETA).powf(-(DURATION / DT).ceil())
}

/// Steps a torus until its distance from equilibrium is below [`ENDED`].
fn ended(torus: Torus) -> Result<Found> {
    let at_rest = vec![nalgebra::Vector3::zeros(); torus.mesh.vertices.len()];
    let states = LAWS.iter().map(|law| equilibrium(&Setting::of_law(law), &torus.mesh)).collect::<Result<Vec<_>>>()?;
    let goal = &states[0];
    let mut simulation = Setting::default().torus(&torus.mesh)?;
    let mut remainder = f64::NAN;
    let mut last = f64::INFINITY;
    while last > ENDED && simulation.time() < LONGEST {
        step(&mut *simulation)?;
        last = difference(&displacements(&*simulation), goal);
        if simulation.steps() == (DURATION / DT).ceil() as usize {
            remainder = last;
        }
    }
    let load = squash(&torus.mesh, goal).1;
    let squashes = states.iter().map(|state| squash(&torus.mesh, state).0).collect();
    Ok(Found { remainder, last, whole: difference(&at_rest, goal), time: simulation.time(), squashes, load, torus })
}

fn marks(of: &Found) -> Vec<Mark> {
    let elements = of.torus.mesh.elements.len();
    let part = of.remainder / of.whole;
    let ended =
        format!("{elements} elements: the motion ends within {ENDED:e} of the diameter of what static computes");
    let left = format!(
        "{elements} elements: the part left after 15 s is that of the closed form within {:.0} %",
        100.0 * REMAINDER
    );
    vec![
        Mark::new(ended, format!("{:.1e} after {:.1} s", of.last, of.time), of.last <= ENDED).beside("15 s"),
        Mark::new(left, format!("{:.4} %", 100.0 * part), (part / closed_form() - 1.0).abs() <= REMAINDER),
    ]
}

/// A mark that the largest torus is near to the finer mesh; small ones are too thin as well, which makes up for some of their stiffness.
fn near(found: &[Found], error: &dyn Fn(&Found) -> f64) -> Option<Mark> {
    let [first, .., last] = found else { return None };
    let (before, after) = (error(first), error(last));
    let statement =
        format!("the flexibility of the largest torus is that of the finer mesh within {:.0} %", 100.0 * FLEXIBILITY);
    let ours = format!("{:+.1} % (smallest torus: {:+.1} %)", 100.0 * after, 100.0 * before);
    Some(Mark::new(statement, ours, after.abs() <= FLEXIBILITY))
}

fn table(found: &[Found], error: &dyn Fn(&Found) -> f64) -> Table {
    let over_linear = |of: &Found, law: usize| format!("{:.5}", of.squashes[law] / of.squashes[0]);
    Table::of(
        "rtfem-equilibrium",
        found,
        &[
            (">elements", &|of| of.torus.mesh.elements.len().to_string()),
            (">nodes", &|of| of.torus.mesh.vertices.len().to_string()),
            (">volume (m³)", &|of| format!("{:.4}", volumes(&of.torus.mesh).iter().sum::<f64>())),
            (">load (N)", &|of| format!("{:.3}", of.load)),
            (">left after 15 s (%)", &|of| format!("{:.4}", 100.0 * of.remainder / of.whole)),
            (">closed form (%)", &|_| format!("{:.4}", 100.0 * closed_form())),
            (">ended after (s)", &|of| format!("{:.2}", of.time)),
            (">distance from static, over diameter", &|of| format!("{:.2e}", of.last)),
            (">approach, linear (m)", &|of| format!("{:.6e}", of.squashes[0])),
            (">corotated over linear", &|of| over_linear(of, 1)),
            (">neo-Hookean over linear", &|of| over_linear(of, 2)),
            (">error of the flexibility (%)", &|of| format!("{:+.2}", 100.0 * error(of))),
        ],
    )
}

fn chart(found: &[Found], error: &dyn Fn(&Found) -> f64) -> Chart {
    let mut chart = Chart::new("error of the flexibility", Axis::log("elements"), Axis::log("error (%)"));
    let dot = |of: &Found| {
        let (x, y) = (of.torus.mesh.elements.len() as f64, 100.0 * error(of).abs());
        Dot::new(x, y, format!("{x} elements\n{y:.2} %"))
    };
    let dots: Vec<Dot> = found.iter().map(dot).collect();
    if let Some(last) = dots.last() {
        let name = "second order in the edge".to_owned();
        chart.guides.push(Guide::Slope { through: (last.x, last.y), slope: -2.0 / 3.0, name });
    }
    chart.series.push(Series::joined("", (0, 0), dots));
    chart
}
