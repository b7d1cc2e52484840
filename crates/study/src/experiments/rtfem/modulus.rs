//! The stiffness that a bar has with iterated methods: its apparent modulus against iterations and time step.

use std::path::Path;

use fem_chart::{Axis, Chart, Dot, Guide, Series};
use fem_engine::simulator::Simulator;
use fem_model::Axis::X;
use fem_model::simulation::Simulation;
use fem_model::{Body, Damping, DampingForm, Integrator, IterationSettings, Method, Selector};

use super::methods::block;
use super::setting::one_thread;
use crate::scenes::{SPRINGS, material, step};
use crate::study::{Figure, Mark, Part, Result, Table, pairs};

/// Length of the bar, m; its cross-section is 1 m².
const LENGTH: f64 = 2.0;
const CELLS: [usize; 3] = [4, 2, 2];
const DENSITY: f64 = 1000.0;

/// The modulus at which the marks are judged, Pa.
const SOFT: f64 = 1e5;

/// Mean strain of the bar under its weight.
const STRAIN: f64 = 0.01;

/// Speed (lengths times the slowest frequency) below which the bar is at rest, and the time (s) within which it must be.
const STILL: f64 = 1e-7;
const LONGEST: f64 = 30.0;

/// Deviation of the modulus of a converged method.
const CONVERGED: f64 = 1e-3;

/// Methods: name, integrator, and whether XPBD keeps the residual.
const METHODS: [(&str, Integrator, bool); 5] = [
    ("PBD", Integrator::Pbd, true),
    ("XPBD", Integrator::Xpbd, true),
    ("XPBD, no residual", Integrator::Xpbd, false),
    ("VBD", Integrator::Vbd, true),
    ("PD", Integrator::ProjectiveDynamics, true),
];

/// A bar at rest with some iterations a step.
struct Hung {
    method: usize,
    young: f64,
    rate: usize,
    iterations: usize,
    /// Apparent modulus over E, and whether the bar came to rest.
    modulus: f64,
    is_still: bool,
}

/// Hangs a bar with every method, number of iterations and time step.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let Ranges { youngs, rates } = ranges(quick);
    let (mut found, mut springs) = (Vec::new(), Vec::new());
    for (young, counts) in &youngs {
        let exact = equilibrium(*young, "corotated")?;
        springs.push((*young, exact / equilibrium(*young, SPRINGS)?));
        for ((method, &rate), &iterations) in pairs(pairs(0..METHODS.len(), rates), *counts) {
            found.push(one_thread()?.install(|| hung(method, *young, (rate, iterations), exact))?);
        }
    }
    let text = format!(
        "A bar of {LENGTH} × 1 × 1 m hangs at one end, stretched by {} % under its weight (corotated law, ν = 1/4), until it is at rest. Its apparent modulus is E times the \
         extension of the same mesh in equilibrium over the one found: 1 is right, less is too soft, more is too stiff. The weight grows with E, so that PBD, which knows no modulus, \
         bears each. Springs in place of the elements, in their own equilibrium, have {}. After {LONGEST} s {} of {} bars are still moving, as their cells say.",
        100.0 * STRAIN,
        springs.iter().map(|(young, part)| format!("{part:.3} at E = {young:e} Pa")).collect::<Vec<_>>().join(" and "),
        found.iter().filter(|hung| !hung.is_still).count(),
        found.len()
    );
    let figures = youngs.iter().map(|(young, _)| figure(&found, *young));
    Ok(Part::new(text).marks(marks(&found)).tables([table(&found)]).figures(figures))
}

/// Ranges of the sweep.
struct Ranges {
    /// Young's moduli, Pa, each with numbers of iterations.
    youngs: Vec<(f64, &'static [usize])>,
    /// Steps of a second.
    rates: &'static [usize],
}

fn ranges(quick: bool) -> Ranges {
    match quick {
        true => Ranges { youngs: vec![(SOFT, &[1, 5, 20])], rates: &[60] },
        false => Ranges {
            youngs: vec![(SOFT, &[1, 2, 5, 10, 20, 50]), (1e7, &[1, 2, 5, 10, 20, 50, 100, 200])],
            rates: &[30, 60, 240],
        },
    }
}

/// The bar; its weight strains it by [`STRAIN`] in the mean.
fn bar(young: f64, law: &str) -> Result<Body> {
    let gravity = 2.0 * STRAIN * young / (DENSITY * LENGTH);
    let mesh = block(CELLS, LENGTH / CELLS[0] as f64);
    let body = Body::new(mesh, material(law, young, 0.25, DENSITY)?)?
        .gravity([gravity, 0.0, 0.0])?
        .fix(&Selector::least(X))?;
    Ok(Body { lumped_mass: true, ..body })
}

/// Mean displacement of the free end along the bar, m.
fn extension(simulation: &dyn Simulation) -> f64 {
    let (shape, q) = (simulation.shape(), simulation.positions());
    let end = shape.mesh.vertices().iter().enumerate().filter(|(_, x)| x.x > LENGTH - 1e-9);
    let moved: Vec<f64> = end.map(|(node, x)| q[3 * node] - x.x).collect();
    moved.iter().sum::<f64>() / moved.len() as f64
}

/// Extension in equilibrium, m.
fn equilibrium(young: f64, law: &str) -> Result<f64> {
    let mut simulation = Simulator::<f64>::new(bar(young, law)?, &Method::new(Integrator::Static, 1.0))?;
    step(&mut simulation)?;
    Ok(extension(&simulation))
}

/// Steps a bar until it is at rest. Its damping is critical for the slowest vibration, a bending one: the frequency of a clamped beam of
/// square cross-section, whose first root is 1.875.
fn hung(method: usize, young: f64, (rate, iterations): (usize, usize), exact: f64) -> Result<Hung> {
    let (name, integrator, residual) = METHODS[method];
    let slowest = 1.875f64.powi(2) / LENGTH.powi(2) * (young / DENSITY / 12.0).sqrt();
    let damping = Damping { alpha: 2.0 * slowest, beta: 0.0, form: DampingForm::default() };
    let settings = Method {
        iterations: IterationSettings { count: iterations, residual, ..IterationSettings::default() },
        ..Method::new(integrator, 1.0 / rate as f64)
    };
    let mut simulation = Simulator::<f64>::new(bar(young, "corotated")?.damping(damping)?, &settings)?;
    let mut is_still = false;
    for _ in 0..(LONGEST * rate as f64) as usize {
        simulation.step().map_err(|failure| format!("{name}: {failure}"))?;
        is_still = simulation.velocities().amax() <= STILL * LENGTH * slowest;
        if is_still {
            break;
        }
    }
    Ok(Hung { method, young, rate, iterations, modulus: exact / extension(&simulation), is_still })
}

fn marks(found: &[Hung]) -> Vec<Mark> {
    let of = |name: &'static str| found.iter().filter(move |hung| METHODS[hung.method].0 == name);
    let soft = |name| of(name).filter(|hung| hung.young == SOFT);
    let converged = |name| {
        let most = soft(name).map(|hung| hung.iterations).max().unwrap_or_default();
        let last = soft(name).filter(|hung| hung.iterations == most);
        let apart = last.map(|hung| (hung.modulus - 1.0).abs()).fold(0.0, f64::max);
        let bar = format!("{name}: with {most} iterations the bar of E = {SOFT:e} Pa");
        Mark::at_most(format!("{bar} has its modulus within {CONVERGED:e}"), apart, CONVERGED)
    };
    let mut marks: Vec<Mark> = ["XPBD", "VBD", "PD"].map(converged).into();
    let ends = |(a, b): (f64, f64), x: f64| (a.min(x), b.max(x));
    let (least, largest) = soft("PBD").map(|hung| hung.modulus).fold((f64::INFINITY, 0.0), ends);
    marks.push(Mark::new(
        "PBD: the modulus comes from iterations and time step, and differs by more than ten times",
        format!("{least:.2} to {largest:.2e} E"),
        largest > 10.0 * least,
    ));
    marks
}

fn cell(hung: &Hung) -> String {
    let moving = if hung.is_still { "" } else { " (moving)" };
    match hung.modulus.abs() {
        0.01..1e4 => format!("{:.4}{moving}", hung.modulus),
        _ => format!("{:.2e}{moving}", hung.modulus),
    }
}

fn table(found: &[Hung]) -> Table {
    let row = |first: &Hung| {
        let is_same =
            |hung: &&Hung| (hung.young, hung.rate, hung.iterations) == (first.young, first.rate, first.iterations);
        let name = [format!("{:e}", first.young), format!("1/{}", first.rate), first.iterations.to_string()];
        name.into_iter().chain(found.iter().filter(is_same).map(cell)).collect()
    };
    let head = ">E (Pa) | >dt (s) | >iterations a step | >PBD, over E | >XPBD, over E | >XPBD without residual, over E | >VBD, over E | >PD, over E";
    Table::new("rtfem-modulus", head, found.iter().filter(|hung| hung.method == 0).map(row).collect())
}

/// Every method at the usual time step, PBD at all of them.
fn figure(found: &[Hung], young: f64) -> Figure {
    let mut chart = Chart::new(
        format!("apparent modulus at E = {young:e} Pa"),
        Axis::log("iterations of a step"),
        Axis::log("apparent modulus over E"),
    );
    let mut rates: Vec<usize> = found.iter().map(|hung| hung.rate).collect();
    rates.sort_unstable();
    rates.dedup();
    let shown = |method: usize, rate: usize| METHODS[method].0 == "PBD" || rate == 60;
    for (method, (name, ..)) in METHODS.iter().enumerate() {
        for (number, &rate) in rates.iter().enumerate().filter(|(_, rate)| shown(method, **rate)) {
            let of_line = found.iter().filter(|hung| (hung.method, hung.young, hung.rate) == (method, young, rate));
            let dots = of_line.map(|hung| Dot::new(hung.iterations as f64, hung.modulus, cell(hung)));
            chart.series.push(Series::joined(format!("{name}, 1/{rate} s"), (method + 1, number), dots));
        }
    }
    chart.guides.push(Guide::Horizontal(1.0, "the modulus of the material".to_owned()));
    let caption = format!("A hanging bar at rest, E = {young:e} Pa: its apparent modulus over E.");
    Figure::new(format!("rtfem-modulus-{young:e}"), chart.draw(), caption)
}
