//! Plastic flow: the additive model of the thesis, corrected, and von Mises plasticity beside it.

pub mod cylinder;
pub mod motion;
pub mod paths;
pub mod relaxation;

use std::path::Path;

use fem_chart::{Axis, Chart, Dot, Guide, Series};
use fem_mesh::{Pattern, rectangle_mesh};
use fem_model::{Body, BodyMesh, Plasticity};

use super::object::{LAME, material};
use crate::study::{Mark, Part, Result, Table};
use relaxation::{Relaxation, YIELD};

/// Random strain paths of each model in a full and in a short run.
const PATHS: [usize; 2] = [1_000_000, 300];

/// Runs all of it.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let (mut marks, mut tables) = (Vec::new(), Vec::new());
    let fine = relaxation::relaxation(0.05)?;
    let coarse = relaxation::relaxation(0.25)?;
    let error = fine.error().max(coarse.error());
    let law =
        "|εᵉ|(t) = y + (|ε₀| − y) e^(−ct) in a strip of constant strain within 1e-6, with steps of 0.05 s and 0.25 s";
    marks.push(Mark::at_most(law, error, 1e-6));
    tables.push(relaxation_table(&fine));
    add_motion(&mut marks, &mut tables, quick)?;
    add_cylinder(&mut marks, &mut tables)?;
    add_paths(&mut marks, &mut tables, PATHS[usize::from(quick)]);
    let (curve, of_curve) = relaxation::tension()?;
    marks.extend(of_curve);
    let text = format!(
        "The additive model has a yield strain y = {YIELD}, a creep rate c and a maximum. The thesis lets the plastic strain flow by the whole elastic \
         strain as long as that exceeds y, so that it falls below y, the farther the longer the substep; here the excess over y flows, exactly over a step. \
         Below it: a strip that is thrown apart at one end and flows while it swings, a strip that is released, von Mises plasticity (j2) in a thick \
         cylinder under internal pressure with the limit load (2 σ_y/√3) ln(b/a) (Hill 1950), and random paths of strain."
    );
    let caption = "The elastic strain of a strip of constant strain, and that of the thesis' rule with 10 substeps at 60 frames a second.";
    let part = Part::new(text).marks(marks).tables(tables).chart("flat-plasticity", &relaxation_chart(&fine), caption);
    Ok(part.figures([curve]))
}

/// A strip of 2 × 1 m with so many cells per metre and λ = μ = 45 000 Pa that flows.
fn strip(cells: usize, yield_strain: f64, creep: f64, maximum: f64) -> Result<Body> {
    let mesh = BodyMesh::flat(rectangle_mesh([2.0, 1.0], cells, Pattern::Kuhn)?, 1.0);
    let plasticity = Some(Plasticity::Additive { yield_strain, creep, maximum });
    Ok(Body { plasticity, ..Body::new(mesh, material(LAME))? })
}

/// Bound, dissipation, order and release of moving bodies.
fn add_motion(marks: &mut Vec<Mark>, tables: &mut Vec<Table>, quick: bool) -> Result<()> {
    let thrown = motion::thrown(if quick { 600 } else { 4000 })?;
    let motion::Thrown { elements, steps, largest, .. } = thrown;
    marks.push(Mark::new(
        format!("|εᵖ| ≤ maximum exactly, in each of {elements} elements and {steps} steps of a thrown strip"),
        format!("largest |εᵖ| − maximum: {:.1e}", largest - motion::MAXIMUM),
        largest <= motion::MAXIMUM && largest > 0.99 * motion::MAXIMUM,
    ));
    marks.push(Mark::new(
        "the strip dissipates in every step or keeps its energy",
        format!("smallest change {:.1e} J of {:.0} J in all", thrown.least_dissipation, thrown.dissipated),
        thrown.least_dissipation >= 0.0 && thrown.dissipated > 0.0,
    ));
    let orders = motion::orders()?;
    let last = orders[orders.len() - 1].1;
    marks.push(Mark::new(
        "the flow is of first order in the time step (0.9 to 1.1)",
        last.map_or(String::new(), |order| format!("{order:.3}")),
        last.is_some_and(|order| (0.9..1.1).contains(&order)),
    ));
    tables.push(Table::of(
        "flat-plasticity-order",
        &orders,
        &[
            (">time step (s)", &|(change, _)| format!("{:e}", change.dt)),
            (">change of the end with half of it (m)", &|(change, _)| format!("{:.3e}", change.distance)),
            (">order", &|(_, order)| order.map_or(String::new(), |order| format!("{order:.3}"))),
        ],
    ));
    let released = motion::released()?;
    marks.push(Mark::new(
        "a released strip comes to rest at εᵖ within 1e-6, without stress",
        format!("{:.1e}, {:.1e} of the stress before", released.strain_error, released.stress_left),
        released.strain_error <= 1e-6 && released.stress_left <= 1e-6,
    ));
    Ok(())
}

fn add_cylinder(marks: &mut Vec<Mark>, tables: &mut Vec<Table>) -> Result<()> {
    let limit = cylinder::limit();
    let found = cylinder::pressures(12, 12, 1e-3, 10)?;
    let (last, before) = (found[9], found[8]);
    let has_settled = (last / before - 1.0).abs() < 2e-3;
    marks.push(Mark::new(
        "j2: the limit load of a thick cylinder is (2 σ_y/√3) ln(b/a) within 1 %",
        format!("{last:.1} of {limit:.1} Pa, {:+.2} %", 100.0 * (last / limit - 1.0)),
        (last / limit - 1.0).abs() < 0.01 && has_settled,
    ));
    let stiffness = cylinder::pressures(12, 12, cylinder::ELASTIC, 1)?[0] / cylinder::elastic_pressure();
    marks.push(Mark::new(
        "before it yields, the cylinder is as stiff as Lamé says, within 1 %",
        format!("{stiffness:.4} of it"),
        (stiffness - 1.0).abs() < 0.01,
    ));
    let found: Vec<_> = found.into_iter().enumerate().collect();
    tables.push(Table::of(
        "flat-plasticity-cylinder",
        &found,
        &[
            (">displacement of the inner wall (m)", &|(number, _)| format!("{:.1e}", 1e-4 * (number + 1) as f64)),
            (">pressure (Pa)", &|(_, pressure)| format!("{pressure:.2}")),
            (">over the limit load", &|(_, pressure)| format!("{:.4}", pressure / limit)),
        ],
    ));
    Ok(())
}

fn add_paths(marks: &mut Vec<Mark>, tables: &mut Vec<Table>, count: usize) {
    let found = [("j2", paths::j2(count)), ("additive", paths::additive(count))];
    for (model, found) in &found {
        marks.push(Mark::new(
            format!("{model}: {count} random paths of plane strain never gain energy by their flow"),
            format!(
                "{} of {} steps flow; least dissipation {:.1e}, least loss of free energy {:.1e} of it",
                found.flows, found.steps, found.least_dissipation, found.least_loss
            ),
            found.flows > found.steps / 10 && found.least_dissipation >= 0.0 && found.least_loss >= -paths::ROUNDING,
        ));
    }
    tables.push(Table::of(
        "flat-plasticity-paths",
        &found,
        &[
            ("model", &|(model, _)| (*model).to_owned()),
            (">paths", &|_| count.to_string()),
            (">steps", &|(_, found)| found.steps.to_string()),
            (">of them with flow", &|(_, found)| found.flows.to_string()),
            (">least dissipation over μ", &|(_, found)| format!("{:.2e}", found.least_dissipation)),
            (">least loss of free energy", &|(_, found)| format!("{:.2e}", found.least_loss)),
        ],
    ));
}

fn relaxation_table(fine: &Relaxation) -> Table {
    Table::of(
        "flat-plasticity",
        &fine.instants,
        &[
            (">time (s)", &|at| format!("{:.2}", at.time)),
            (">closed form", &|at| format!("{:.12}", at.closed_form)),
            (">here", &|at| format!("{:.12}", at.elastic)),
            (">error", &|at| format!("{:.1e}", (at.elastic - at.closed_form).abs())),
            (">the thesis' rule", &|at| format!("{:.6}", at.theirs)),
        ],
    )
}

fn relaxation_chart(fine: &Relaxation) -> Chart {
    let dots = |value: fn(&relaxation::Instant) -> f64| {
        fine.instants.iter().map(move |at| Dot::new(at.time, value(at), format!("{:.2} s\n{:.5}", at.time, value(at))))
    };
    let mut chart = Chart::new("elastic strain at constant strain", Axis::linear("time (s)"), Axis::linear("|εᵉ|"));
    chart.series = vec![
        Series::line("y + (|ε₀| − y) e^(−ct)", 0, dots(|at| at.closed_form)),
        Series { is_joined: false, ..Series::joined("here", (0, 0), dots(|at| at.elastic)) },
        Series::line("the thesis' rule", 1, dots(|at| at.theirs)),
    ];
    chart.guides = vec![Guide::Horizontal(YIELD, "yield strain".to_owned())];
    chart
}
