//! Plastic flow: the additive model of the thesis, corrected, and von Mises plasticity beside it.

pub mod cylinder;
pub mod motion;
pub mod paths;
pub mod relaxation;

use std::path::Path;

use fem_chart::{Axis, Chart, Dot, Guide, Series};

use crate::experiments::{Figure, Mark, Part, Table};
use relaxation::{Relaxation, YIELD};

/// Random strain paths of each model in a full and in a short run.
const PATHS: [usize; 2] = [1_000_000, 300];

/// Runs all of it.
pub fn run(_: &Path, quick: bool) -> Result<Part, String> {
    let (mut marks, mut tables) = (Vec::new(), Vec::new());
    let fine = relaxation::relaxation(0.05)?;
    let coarse = relaxation::relaxation(0.25)?;
    let error = fine.error().max(coarse.error());
    marks.push(Mark::new(
        "|εᵉ|(t) = y + (|ε₀| − y) e^(−ct) in a strip of constant strain within 1e-6, with steps of 0.05 s and 0.25 s",
        format!("{error:.1e}"),
        error <= 1e-6,
    ));
    tables.push(relaxation_table(&fine));
    add_motion(&mut marks, &mut tables, quick)?;
    add_cylinder(&mut marks, &mut tables)?;
    add_paths(&mut marks, &mut tables, PATHS[usize::from(quick)]);
    Ok(Part {
        name: "plasticity",
        title: "Plastic flow",
        text: format!(
            "The additive model has a yield strain y = {YIELD}, a creep rate c and a maximum. The thesis lets the plastic strain flow by the whole elastic \
             strain as long as that exceeds y, so that it falls below y, the farther the longer the substep; here the excess over y flows, exactly over a step. \
             Below it: a strip that is thrown apart at one end and flows while it swings, a strip that is released, von Mises plasticity (j2) in a thick \
             cylinder under internal pressure with the limit load (2 σ_y/√3) ln(b/a) (Hill 1950), and random paths of strain."
        ),
        marks,
        tables,
        figures: vec![Figure {
            name: "flat-plasticity".to_owned(),
            picture: relaxation_chart(&fine).draw(),
            caption: "The elastic strain of a strip of constant strain, and that of the thesis' rule with 10 substeps at 60 frames a second.".to_owned(),
        }],
    })
}

/// Bound, dissipation, order and release of moving bodies.
fn add_motion(marks: &mut Vec<Mark>, tables: &mut Vec<Table>, quick: bool) -> Result<(), String> {
    let thrown = motion::thrown(if quick { 600 } else { 4000 })?;
    marks.push(Mark::new(
        format!(
            "|εᵖ| ≤ maximum exactly, in each of {} elements and {} steps of a thrown strip",
            thrown.elements, thrown.steps
        ),
        format!("largest |εᵖ| − maximum: {:.1e}", thrown.largest - motion::MAXIMUM),
        thrown.largest <= motion::MAXIMUM && thrown.largest > 0.99 * motion::MAXIMUM,
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
    let row = |(change, order): &(motion::Change, Option<f64>)| {
        vec![
            format!("{:e}", change.dt),
            format!("{:.3e}", change.distance),
            order.map_or(String::new(), |order| format!("{order:.3}")),
        ]
    };
    tables.push(Table {
        name: "flat-plasticity-order".to_owned(),
        head: vec![">time step (s)", ">change of the end with half of it (m)", ">order"],
        rows: orders.iter().map(row).collect(),
    });
    let released = motion::released()?;
    marks.push(Mark::new(
        "a released strip comes to rest at εᵖ within 1e-6, without stress",
        format!("{:.1e}, {:.1e} of the stress before", released.strain_error, released.stress_left),
        released.strain_error <= 1e-6 && released.stress_left <= 1e-6,
    ));
    Ok(())
}

fn add_cylinder(marks: &mut Vec<Mark>, tables: &mut Vec<Table>) -> Result<(), String> {
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
    let row = |(number, pressure): (usize, &f64)| {
        vec![
            format!("{:.1e}", 1e-4 * (number + 1) as f64),
            format!("{pressure:.2}"),
            format!("{:.4}", pressure / limit),
        ]
    };
    tables.push(Table {
        name: "flat-plasticity-cylinder".to_owned(),
        head: vec![">displacement of the inner wall (m)", ">pressure (Pa)", ">over the limit load"],
        rows: found.iter().enumerate().map(row).collect(),
    });
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
    let row = |(model, found): &(&str, paths::Found)| {
        let [steps, flows] = [found.steps, found.flows].map(|count| count.to_string());
        let [least, loss] = [found.least_dissipation, found.least_loss].map(|least| format!("{least:.2e}"));
        vec![(*model).to_owned(), count.to_string(), steps, flows, least, loss]
    };
    tables.push(Table {
        name: "flat-plasticity-paths".to_owned(),
        head: vec![
            "model",
            ">paths",
            ">steps",
            ">of them with flow",
            ">least dissipation over μ",
            ">least loss of free energy",
        ],
        rows: found.iter().map(row).collect(),
    });
}

fn relaxation_table(fine: &Relaxation) -> Table {
    let row = |at: &relaxation::Instant| {
        vec![
            format!("{:.2}", at.time),
            format!("{:.12}", at.closed_form),
            format!("{:.12}", at.elastic),
            format!("{:.1e}", (at.elastic - at.closed_form).abs()),
            format!("{:.6}", at.theirs),
        ]
    };
    Table {
        name: "flat-plasticity".to_owned(),
        head: vec![">time (s)", ">closed form", ">here", ">error", ">the thesis' rule"],
        rows: fine.instants.iter().map(row).collect(),
    }
}

fn relaxation_chart(fine: &Relaxation) -> Chart {
    let dots = |value: fn(&relaxation::Instant) -> f64| {
        let dot = |at: &relaxation::Instant| Dot {
            x: at.time,
            y: value(at),
            title: format!("{:.2} s\n{:.5}", at.time, value(at)),
            ..Dot::default()
        };
        fine.instants.iter().map(dot).collect::<Vec<_>>()
    };
    let curve = |name: &str, colour: usize, dots: Vec<Dot>| Series {
        name: name.to_owned(),
        colour,
        is_joined: true,
        dots,
        ..Series::default()
    };
    let mut chart = Chart::new("elastic strain at constant strain", Axis::linear("time (s)"), Axis::linear("|εᵉ|"));
    let here = Series { is_joined: false, has_dots: true, ..curve("here", 0, dots(|at| at.elastic)) };
    chart.series = vec![
        curve("y + (|ε₀| − y) e^(−ct)", 0, dots(|at| at.closed_form)),
        here,
        curve("the thesis' rule", 1, dots(|at| at.theirs)),
    ];
    chart.guides = vec![Guide::Horizontal(YIELD, "yield strain".to_owned())];
    chart
}
