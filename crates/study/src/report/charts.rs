//! The charts of a report.

use crate::report::text::{number, seconds, step};
use crate::runs::convergence_order::asymptotic;
use crate::runs::costs::{self, KINDS};
use crate::runs::row::Row;
use crate::studies::scene::{SceneStudy, competing_error};
use fem_chart::{Axis, Bar, Chart, Dot, Guide, Picture, SHAPES, Series, bars};
use fem_model::Integrator;

/// Frames in a second of motion.
const FRAMES: f64 = 60.0;

/// The text that a dot shows under the pointer.
pub fn title(row: &Row) -> String {
    let case = &row.config;
    let counters = &row.counters;
    format!(
        "{}\n{} steps of {}\nerror {} (largest {})\n{} in all, {} a step\nsteps {}, forces {}, Newton {}, factorizations {}, solver {}\n{}",
        case.method,
        case.steps,
        step(case.dt),
        number(competing_error(row)),
        number(row.errors.time_linf),
        seconds(row.seconds()),
        seconds(row.times.step_ms[0].map(|ms| ms / 1e3)),
        counters.steps,
        counters.force_assemblies,
        counters.newton_iterations,
        counters.factorizations,
        counters.solver_iterations,
        case.id
    )
}

/// Colour and shape of a method, from one of its runs.
fn look(study: &SceneStudy, method: &str) -> (usize, usize) {
    let run = study.rows.iter().find(|row| row.config.method == method);
    let of_course = run.is_some_and(|row| row.config.pipeline == "course");
    match run.map(|row| row.config.integrator) {
        Some(Integrator::ImplicitEuler) if of_course => (7, 2),
        Some(Integrator::LinearlyImplicitEuler) if of_course => (7, 3),
        Some(Integrator::ImplicitEuler) => (0, 0),
        Some(Integrator::LinearlyImplicitEuler) => (1, 1),
        Some(Integrator::Verlet) => (2, 2),
        Some(Integrator::Rk4) => (3, 3),
        Some(Integrator::SemiImplicitEuler) => (4, 4),
        Some(Integrator::Rk2) => (5, 0),
        Some(Integrator::ExplicitEuler) => (6, 1),
        Some(Integrator::ImplicitMidpoint) => (1, 3),
        Some(Integrator::Newmark) => (2, 4),
        Some(Integrator::GeneralizedAlpha) => (3, 0),
        Some(Integrator::Bdf2) => (4, 1),
        _ => (8, 4),
    }
}

/// Names of the methods with a ladder, in the order of their first run.
pub(super) fn methods(study: &SceneStudy) -> Vec<String> {
    let mut methods: Vec<String> = Vec::new();
    for row in study.rows.iter().filter(|row| ["method", "order"].contains(&&*row.config.group)) {
        if !methods.contains(&row.config.method) {
            methods.push(row.config.method.clone());
        }
    }
    methods
}

/// The chart of error against run time.
pub fn error_against_time(study: &SceneStudy) -> Picture {
    let is_moving = study.horizon > 0.0;
    let (unit, name) = if is_moving {
        (1e3 / (study.horizon * FRAMES), "wall time for 1/60 s of motion (ms)")
    } else {
        (1e3, "wall time of the whole equilibrium (ms)")
    };
    let error_name = if is_moving { "error in time / body length" } else { "error against the closed form" };
    let label = format!("{}: error against run time", study.name);
    let mut chart = Chart::new(label, Axis::log(name), Axis::log(error_name));
    chart.size = (660.0, 450.0);
    let own = |row: &&Row| row.is_done() && (row.config.nodes == study.size.0 || !is_moving);
    let dot = |row: &Row| {
        let [low, median, high] = row.times.total_s;
        let spread = low.zip(high).map(|(low, high)| (low * unit, high * unit));
        let is_best = row.standing == "front";
        Some(Dot { x: median? * unit, y: competing_error(row)?, title: title(row), spread, is_best })
    };
    let rows =
        |method: &str| study.rows.iter().filter(own).filter(|row| row.config.method == method).collect::<Vec<_>>();
    for method in methods(study) {
        let look = look(study, &method);
        let dots: Vec<Dot> = rows(&method).into_iter().filter_map(dot).collect();
        let name = if dots.is_empty() { format!("{method} (all runs failed)") } else { method };
        chart.series.push(Series::joined(name, look, dots));
    }
    let others = study.rows.iter().filter(own).filter(|row| row.config.group != "method");
    let dots: Vec<Dot> = others.filter_map(dot).collect();
    if !dots.is_empty() {
        let name = "variants: tolerance, solver, projection, precision";
        chart.series.push(Series { is_joined: false, ..Series::joined(name, (8, 4), dots) });
    }
    if is_moving {
        chart.guides.push(Guide::Vertical(4.0, "4 ms".to_owned()));
        chart.guides.push(Guide::Vertical(16.0, "16 ms".to_owned()));
        chart.guides.extend(slopes(&chart));
        if let Some(level) = study.richardson.as_ref().and_then(|nested| nested.errors.get(1)) {
            chart.guides.push(Guide::Horizontal(level.1, "error in space".to_owned()));
        }
    }
    chart.draw()
}

/// Slopes of order 1, 2 and 4 beside methods of these orders.
fn slopes(chart: &Chart) -> Vec<Guide> {
    let of = |integrator: Integrator| {
        let facts = integrator.facts();
        let (series, order) = (chart.series.iter().find(|series| series.name == facts.label)?, facts.order?);
        let dot = series.dots.get(series.dots.len().checked_sub(2)?)?;
        let through = (dot.x, dot.y / 2.5);
        Some(Guide::Slope { through, slope: -f64::from(order), name: format!("order {order}") })
    };
    [Integrator::LinearlyImplicitEuler, Integrator::Verlet, Integrator::Rk4].into_iter().filter_map(of).collect()
}

/// Error over time step.
pub fn convergence(study: &SceneStudy) -> Picture {
    let label = format!("{}: convergence in dt", study.name);
    let mut chart = Chart::new(label, Axis::log("time step (s)"), Axis::log("error in time / body length"));
    for method in methods(study) {
        let rows = study.rows.iter().filter(|row| row.config.method == method && row.is_done());
        let dot = |row: &Row| Some(Dot::new(row.config.dt, row.errors.time_l2?, title(row)));
        let dots: Vec<Dot> = rows.filter_map(dot).collect();
        let pairs: Vec<_> = dots.iter().map(|dot| (dot.x, dot.y)).collect();
        let order = asymptotic(&pairs, super::FINEST, super::FLOOR).filter(|order| order.points > 2);
        let name = order.map_or(method.clone(), |order| format!("{method}: {:.2}", order.value));
        chart.series.push(Series::joined(name, look(study, &method), dots));
    }
    chart.draw()
}

/// Change of the total energy over time, relative to the larger of kinetic and potential energy.
pub fn drift(study: &SceneStudy) -> Option<Picture> {
    let label = format!("{}: total energy over time", study.name);
    let name = "change of total energy / larger of kinetic and potential";
    let mut chart = Chart::new(label, Axis::linear("time (s)"), Axis::linear(name));
    for method in methods(study).iter().filter(|method| !method.starts_with("course")) {
        // The middle run of the ladder has a usual time step.
        let places: Vec<usize> = (0..study.rows.len())
            .filter(|&place| study.rows[place].config.method == *method && study.rows[place].is_done())
            .collect();
        let Some(&place) = places.get(places.len() / 2) else { continue };
        let scale = study.energy_scale;
        let dots = study.histories[place].iter().map(|(time, energy)| (*time, energy / scale));
        let name = format!("{method}, dt = {}", step(study.rows[place].config.dt));
        chart.series.push(Series::line(name, look(study, method).0, dots));
    }
    (study.energy_scale > 0.0).then(|| chart.draw())
}

/// Milliseconds of a step by part, for the middle run of each method.
pub fn costs_of_a_step(study: &SceneStudy) -> Option<Picture> {
    let costs = study.costs.as_ref()?;
    let bar = |method: String| {
        let rows: Vec<&Row> = study.rows.iter().filter(|row| row.config.method == method && row.is_done()).collect();
        let row = rows.get(rows.len() / 2)?;
        let shares = costs::shares(costs, row)?;
        let whole: f64 = shares.iter().sum();
        let figure = format!("{} at {}", seconds(Some(whole / 1e3)), step(row.config.dt));
        Some(Bar { name: method, shares: shares.to_vec(), figure })
    };
    let all: Vec<Bar> = methods(study).into_iter().filter_map(bar).collect();
    let kinds: Vec<(&str, usize)> = KINDS.into_iter().zip(0..).collect();
    let label = format!("{}: costs of a step", study.name);
    let percent = |share: f64, whole: f64| format!("{:.0} %", 100.0 * share / whole);
    (!all.is_empty()).then(|| bars(&label, &kinds, &all, percent))
}

/// The completed runs of adaptive steps.
pub(super) fn adaptive_rows(study: &SceneStudy) -> impl Iterator<Item = &Row> {
    study.rows.iter().filter(|row| row.config.group == "adaptive" && row.is_done() && row.errors.estimated.is_some())
}

/// True over estimated errors; `None` without such runs.
pub(super) fn adaptive(study: &SceneStudy) -> Option<Picture> {
    let label = format!("{}: estimated and true error of adaptive steps", study.name);
    let (x, y) = ("sum of estimated errors / body length", "largest true error / body length");
    let mut chart = Chart::new(label, Axis::log(x), Axis::log(y));
    for (number, method) in adaptive_methods(study).into_iter().enumerate() {
        let dot = |row: &Row| Some(Dot::new(row.errors.estimated?, row.errors.time_linf?, row.config.method.clone()));
        let dots = adaptive_rows(study).filter(|row| row.config.integrator == method).filter_map(dot);
        chart.series.push(Series::joined(method.name().replace('_', " "), (number, number % SHAPES), dots));
    }
    let through = chart.series.first()?.dots.first().map(|dot| (dot.x, dot.x))?;
    chart.guides.push(Guide::Slope { through, slope: 1.0, name: "equal".to_owned() });
    Some(chart.draw())
}

/// The integrators with such runs.
fn adaptive_methods(study: &SceneStudy) -> Vec<Integrator> {
    let mut methods: Vec<Integrator> = adaptive_rows(study).map(|row| row.config.integrator).collect();
    methods.dedup();
    methods
}
