//! Time of a step of the torus: every size, law, precision and solver, on one thread and on all; and the parts of a step.

use std::path::Path;
use std::time::Instant;

use fem_chart::{Axis, Chart, Dot, Guide, Series};
use fem_engine::solvers::{device_is_software, device_name};
use fem_model::simulation::Part as PartOfStep;
use fem_model::{Precision, SolverKind};

use super::setting::{DT, LAWS, SOLVERS, Setting, median_and_p95, one_thread};
use super::torus::{ACCEPTED, Torus, sizes};
use crate::machine::threads;
use crate::study::{Mark, Part, Result, Table, pairs};

/// Elements, and the times that the thesis prints on its processor (LU) and on its graphics card, ms a step.
type Theirs = (usize, Option<f64>, f64);

const THEIRS: [Theirs; 8] = [
    (182, Some(271.0), 3.0),
    (245, Some(640.0), 4.0),
    (572, Some(3000.0), 5.0),
    (660, None, 7.0),
    (1119, None, 11.0),
    (2000, None, 15.0),
    (3252, None, 20.0),
    (5392, None, 35.0),
];

/// Longest step of a frame in real time, ms, and of the largest linear torus.
const FRAME: f64 = 1e3 * DT;
const LARGEST: f64 = 1.0;

/// The variable that asks for times of adapters that are programs on the processor, beside those of the thesis' card.
const SOFTWARE_ADAPTERS: &str = "FEM_SOFTWARE_ADAPTERS";

/// Number types.
const PRECISIONS: [Precision; 2] = [Precision::F64, Precision::F32];

/// Steps that are timed.
fn steps(quick: bool) -> usize {
    if quick { 5 } else { 60 }
}

/// Times of all sizes.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let mut found = Found::default();
    for wanted in if quick { vec![182, 660] } else { sizes() } {
        found.add(wanted, quick)?;
    }
    let marks = found.marks(quick);
    let text = format!(
        "A torus of ring and tube radii 0.96 m and 0.5 m (the thesis gives their ratio, 1.92), E = 7000 Pa, ν = 0.2, 1 kg/m³, Rayleigh damping α = 10, β = 2.5, \
         steps of {DT} s. The boundary triangles beyond the ring's radius at both sides carry 100 Pa towards each other, the common normal of the two sides; \
         nodes next to the planes of symmetry stay on them. Every law is stepped by implicit Euler until Newton's method has \
         converged; for the linear law that is the thesis' formula (M + dt C + dt² K) v⁺ = dt Q + M v − dt K (x − x₀). The thesis solves to 1e-5 in at most 1000 iterations; here residuals are 1e-12 in double \
         precision. Times are medians of {} steps after the first, which factorises; the thesis' machines are an i5-2500k and a GTX 1060.",
        steps(quick)
    );
    let chart = found.chart();
    let by_size = ">elements, thesis | >elements | >nodes | >edge (m) | >thesis, processor (ms) | >thesis, card (ms) | law | numbers | >threads | \
                   >here, median (ms) | >95 % (ms) | >first (ms) | >Newton iterations a step | >factorisations";
    let by_solver =
        ">elements | solver | numbers | >median (ms) | >95 % (ms) | >first (ms) | >iterations a step | steps";
    let of_parts = ">elements | law | >force assembly, thesis (ms) | >here (ms) | >right-hand side, thesis (ms) | >here (ms) | \
                    >solve, thesis (ms) | >here (ms) | >the rest (ms)";
    let tables = [
        Table::new("rtfem-speed", by_size, found.rows),
        Table::new("rtfem-solvers", by_solver, found.solvers),
        Table::new("rtfem-parts", of_parts, found.parts),
    ];
    let caption = "Processor time of a step in double precision on one thread, beside the thesis.";
    Ok(Part::new(text).marks(marks).tables(tables).chart("rtfem-speed", &chart, caption))
}

/// Rows, and the figures of the marks.
#[derive(Default)]
struct Found {
    counts: Vec<(usize, usize)>,
    rows: Vec<Vec<String>>,
    solvers: Vec<Vec<String>>,
    parts: Vec<Vec<String>>,
    /// Law, elements, processor time of a step on one thread in double precision, ms, and factorisations.
    judged: Vec<(&'static str, usize, f64, usize)>,
}

impl Found {
    fn add(&mut self, wanted: usize, quick: bool) -> Result<()> {
        let torus = Torus::of_size(wanted)?;
        let elements = torus.mesh.elements.len();
        self.counts.push((wanted, elements));
        let counts = if threads() == 1 { vec![1] } else { vec![1, threads()] };
        for ((law, precision), count) in pairs(pairs(LAWS, PRECISIONS), counts) {
            let timed = on_threads(count, &torus, &Setting { precision, ..Setting::of_law(law) }, quick)?;
            self.rows.push(row(wanted, &torus, law, precision, count, &timed));
            if count == 1 && precision == Precision::F64 {
                self.judged.push((law, elements, timed.processor, timed.factorizations));
            }
        }
        let device = device_name().unwrap_or_else(|_| "no adapter".to_owned());
        for (name, solver) in SOLVERS {
            let is_on_device = solver.as_ref().is_some_and(|solver| solver.kind == SolverKind::Gpu);
            let name = if is_on_device { format!("{name}: {device}") } else { (*name).to_owned() };
            if is_on_device && device_is_software() && std::env::var_os(SOFTWARE_ADAPTERS).is_none() {
                let why = format!("the adapter is a program on the processor: set {SOFTWARE_ADAPTERS}=1 to time it");
                self.solvers.push(solver_row(elements, &name, "", Err(why.into())));
                continue;
            }
            for precision in PRECISIONS {
                let setting = Setting { solver: solver.clone(), precision, ..Setting::default() };
                let timed = on_threads(1, &torus, &setting, quick);
                self.solvers.push(solver_row(elements, &name, precision.name(), timed));
            }
        }
        for law in LAWS {
            self.parts.push(one_thread()?.install(|| parts_row(&torus, wanted, law, steps(quick)))?);
        }
        Ok(())
    }

    fn marks(&self, quick: bool) -> Vec<Mark> {
        let mut marks: Vec<Mark> = self
            .counts
            .iter()
            .map(|&(wanted, count)| {
                let off = count as f64 / wanted as f64 - 1.0;
                let statement = format!("a torus of {wanted} elements within {:.0} %", 100.0 * ACCEPTED);
                Mark::new(statement, format!("{count} ({:+.1} %)", 100.0 * off), off.abs() <= ACCEPTED)
                    .beside(format!("{wanted}"))
            })
            .collect();
        for law in LAWS {
            let slowest = self.judged.iter().filter(|of| of.0 == law).map(|of| of.2).fold(0.0, f64::max);
            let statement = format!("{law}: a step of every size under {FRAME} ms of processor time on one thread");
            let mark = Mark::new(statement, format!("{slowest:.2} ms at most"), slowest < FRAME);
            marks.push(mark.beside("up to 3000 ms (processor), 35 ms (card)").unless(quick));
        }
        if let Some(&(_, elements, processor, factorizations)) =
            self.judged.iter().filter(|of| of.0 == "linear").max_by_key(|of| of.1)
        {
            let statement =
                format!("linear, {elements} elements: a step at most {LARGEST} ms of processor time on one thread");
            let mark = Mark::new(statement, format!("{processor:.3} ms"), processor <= LARGEST);
            marks.push(mark.beside("35 ms (card)").unless(quick));
            let statement =
                format!("linear, {elements} elements: the factor is kept: at most 2 factorisations in all steps");
            marks.push(Mark::new(statement, format!("{factorizations}"), factorizations <= 2));
        }
        marks
    }

    fn chart(&self) -> Chart {
        let mut chart = Chart::new("time of a step", Axis::log("elements"), Axis::log("time of a step (ms)"));
        let series = |name: &str, colour: usize, dots: Vec<(f64, f64)>| {
            let dot = |(x, y)| Dot::new(x, y, format!("{name}: {x} elements, {y:.3} ms"));
            Series::joined(name, (colour, colour % 4), dots.into_iter().map(dot))
        };
        let of_thesis = |time: &dyn Fn(&Theirs) -> Option<f64>| {
            THEIRS.iter().filter_map(|row| Some((row.0 as f64, time(row)?))).collect::<Vec<_>>()
        };
        chart.series.push(series("thesis, processor", 0, of_thesis(&|row| row.1)));
        chart.series.push(series("thesis, graphics card", 1, of_thesis(&|row| Some(row.2))));
        for (number, law) in LAWS.into_iter().enumerate() {
            let own = self.judged.iter().filter(|of| of.0 == law).map(|of| (of.1 as f64, of.2)).collect();
            chart.series.push(series(law, 2 + number, own));
        }
        chart.guides.push(Guide::Horizontal(FRAME, format!("{FRAME} ms, one step of the thesis")));
        chart
    }
}

fn on_threads(count: usize, torus: &Torus, setting: &Setting, quick: bool) -> Result<Timed> {
    match count {
        1 => one_thread()?.install(|| timed(torus, setting, steps(quick))),
        _ => timed(torus, setting, steps(quick)),
    }
}

fn row(wanted: usize, torus: &Torus, law: &str, precision: Precision, threads: usize, timed: &Timed) -> Vec<String> {
    let theirs = THEIRS.iter().find(|theirs| theirs.0 == wanted);
    let time = |time: Option<f64>| time.map_or(String::new(), |time| format!("{time}"));
    let mut row =
        vec![wanted.to_string(), torus.mesh.elements.len().to_string(), torus.mesh.vertices.len().to_string()];
    row.push(format!("{:.4}", torus.edge));
    row.extend([time(theirs.and_then(|theirs| theirs.1)), time(theirs.map(|theirs| theirs.2))]);
    row.extend([law.to_owned(), precision.name().to_owned(), threads.to_string()]);
    row.extend([timed.median, timed.p95, timed.first].map(|time| format!("{time:.3}")));
    row.extend([format!("{:.2}", timed.newton_iterations), timed.factorizations.to_string()]);
    row
}

/// A row of a solver; one that fails is in the table too.
fn solver_row(elements: usize, name: &str, precision: &str, timed: Result<Timed>) -> Vec<String> {
    let mut row = vec![elements.to_string(), name.to_owned(), precision.to_owned()];
    match timed {
        Ok(timed) => {
            row.extend([timed.median, timed.p95, timed.first].map(|time| format!("{time:.3}")));
            row.push(format!("{:.1}", timed.solver_iterations));
            row.push(match timed.unconverged {
                0 => "converged".to_owned(),
                unconverged => format!("{unconverged} not converged"),
            });
        }
        Err(problem) => row.extend(["", "", "", ""].map(str::to_owned).into_iter().chain([problem.to_string()])),
    }
    row
}

/// Times of the steps of one run, ms.
struct Timed {
    /// The first step, which factorises.
    first: f64,
    /// The others: the middle, and the one below which 95 % lie.
    median: f64,
    p95: f64,
    /// Processor time of the thread that steps, the mean of the others; other programs on the machine do not change it.
    processor: f64,
    /// Factorisations in all steps.
    factorizations: usize,
    /// Iterations of the linear solver, and of Newton's method, a step.
    solver_iterations: f64,
    newton_iterations: f64,
    /// Largest step that did not converge.
    unconverged: usize,
}

/// Processor time of this thread so far, ms; 0 on systems other than Linux.
fn processor_time() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|nanoseconds| nanoseconds.parse::<f64>().ok()).unwrap_or(0.0) * 1e-6
}

/// Times the first steps of a run.
fn timed(torus: &Torus, setting: &Setting, count: usize) -> Result<Timed> {
    let mut simulation = setting.torus(&torus.mesh)?;
    let mut times = Vec::with_capacity(count + 1);
    let mut processor_begun = 0.0;
    for step in 0..=count {
        if step == 1 {
            processor_begun = processor_time();
        }
        let begun = Instant::now();
        simulation.step()?;
        times.push(1e3 * begun.elapsed().as_secs_f64());
    }
    let processor = (processor_time() - processor_begun) / count as f64;
    let first = times.remove(0);
    let (median, p95) = median_and_p95(times);
    let counters = simulation.counters();
    let a_step = |total: usize| total as f64 / (count + 1) as f64;
    Ok(Timed {
        first,
        median,
        p95,
        processor: if processor > 0.0 { processor } else { median },
        factorizations: counters.factorizations,
        solver_iterations: a_step(counters.solver_iterations),
        newton_iterations: a_step(counters.newton_iterations),
        unconverged: counters.unconverged_steps,
    })
}

/// Elements, and the times of the thesis for force assembly, right-hand side and solve, ms.
const THEIRS_OF_PARTS: [(usize, [f64; 3]); 3] =
    [(1119, [4.0, 0.20, 4.0]), (2000, [5.0, 0.22, 5.0]), (5392, [16.0, 0.66, 15.0])];

/// The groups, with the parts of the engine that belong to each.
const GROUPS: [(&str, &[&str]); 3] = [
    ("force assembly", &["forces", "line_search", "stiffness", "projection"]),
    ("right-hand side", &["mass", "dead_load", "damping", "prescribed"]),
    ("solve", &["solver", "preconditioner"]),
];

/// The parts of a step, as the thesis divides it: force assembly, right-hand side, solve.
fn parts_row(torus: &Torus, wanted: usize, law: &str, count: usize) -> Result<Vec<String>> {
    let mut simulation = Setting::of_law(law).torus(&torus.mesh)?;
    simulation.step()?; // factorises
    let seconds = |parts: &[PartOfStep], names: &[&str]| -> f64 {
        parts.iter().filter(|part| names.contains(&part.name)).map(|part| part.seconds).sum()
    };
    let before = simulation.parts();
    let begun = Instant::now();
    for _ in 0..count {
        simulation.step()?;
    }
    let total = begun.elapsed().as_secs_f64();
    let after = simulation.parts();
    let spent = GROUPS.map(|(_, names)| seconds(&after, names) - seconds(&before, names));
    let rest = total - spent.iter().sum::<f64>();
    let theirs = THEIRS_OF_PARTS.iter().find(|theirs| theirs.0 == wanted).map(|theirs| theirs.1);
    let mut row = vec![torus.mesh.elements.len().to_string(), law.to_owned()];
    for (number, spent) in spent.into_iter().enumerate() {
        row.push(theirs.map_or(String::new(), |theirs| format!("{}", theirs[number])));
        row.push(format!("{:.4}", 1e3 * spent / count as f64));
    }
    row.push(format!("{:.4}", 1e3 * rest / count as f64));
    Ok(row)
}

#[cfg(test)]
mod tests {
    use fem_engine::simulator::build;
    use fem_model::{Method, NewtonSettings, SolverSettings};

    use super::super::setting::on_device;
    use super::*;

    #[test]
    fn a_solver_that_fails_has_a_row_with_its_message() {
        let row = solver_row(5, "cg", "f32", Err("no convergence".into()));
        assert_eq!(row.len(), 8);
        assert_eq!(row[7], "no convergence");
    }

    #[test]
    fn a_torus_ends_on_a_graphics_device_where_it_ends_on_the_processor() {
        let torus = Torus::of_size(660).unwrap();
        let end = |solver: SolverSettings| -> Result<_> {
            let setting = Setting { law: "corotated", solver: Some(solver), ..Setting::default() };
            let newton = NewtonSettings { tolerance: Some(2e-15), ..NewtonSettings::default() };
            let mut simulation = build(setting.torus_body(&torus.mesh)?, &Method { newton, ..setting.method() })?;
            let start = simulation.positions();
            (0..5).try_for_each(|_| crate::scenes::step(&mut *simulation))?;
            Ok((start, simulation.positions()))
        };
        // Kept Cholesky factors leave 1e-10 of it.
        let with =
            |kind, precision, tolerance| SolverSettings { kind, tolerance: Some(tolerance), ..on_device(precision) };
        let (start, expected) = end(with(SolverKind::Pcg, Precision::F32, 1e-14)).unwrap();
        for (precision, bound) in [(Precision::F32, 1e-10), (Precision::F64, 1e-12)] {
            let name = precision.name();
            match end(with(SolverKind::Gpu, precision, 1e-13)).map_err(|problem| problem.to_string()) {
                Ok((_, found)) => {
                    let error = (&found - &expected).amax() / (&expected - &start).amax();
                    println!("{name}: {error:e} of the displacement");
                    assert!(error < bound, "{name}: {error:e}");
                }
                Err(why) if ["`gpu`", "adapter", "double"].iter().any(|part| why.contains(part)) => {
                    println!("skipped: {why}")
                }
                Err(why) => panic!("{why}"),
            }
        }
    }

    #[test]
    fn the_counts_of_the_thesis_have_a_time_each() {
        for size in sizes() {
            assert!(THEIRS.iter().any(|theirs| theirs.0 == size && theirs.2 > 0.0));
        }
    }
}
