//! Time of a step of the torus: every size, law, precision and solver, on one thread and on all.

use std::path::Path;

use fem_chart::{Axis, Chart, Dot, Guide, Series};
use fem_engine::solvers::{device_is_software, device_name};

use super::setting::{DT, LAWS, SOLVERS, Setting, one_thread};
use super::steps::{parts_table, share};
use super::timing::{Timed, timed};
use super::torus::{ACCEPTED, Torus, sizes};
use crate::machine::threads;
use crate::study::{Mark, Part, Table};

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

/// Steps that are timed.
fn steps(quick: bool) -> usize {
    if quick { 5 } else { 60 }
}

/// Times of all sizes.
pub fn run(_: &Path, quick: bool) -> Result<Part, String> {
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
    let by_size = [
        ">elements, thesis",
        ">elements",
        ">nodes",
        ">edge (m)",
        ">thesis, processor (ms)",
        ">thesis, card (ms)",
        "law",
        "numbers",
        ">threads",
        ">here, median (ms)",
        ">95 % (ms)",
        ">first (ms)",
        ">Newton iterations a step",
        ">factorisations",
    ];
    let by_solver =
        [">elements", "solver", "numbers", ">median (ms)", ">95 % (ms)", ">first (ms)", ">iterations a step", "steps"];
    let tables = [
        Table::new("rtfem-speed", &by_size, found.rows),
        Table::new("rtfem-solvers", &by_solver, found.solvers),
        parts_table(found.parts),
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
    fn add(&mut self, wanted: usize, quick: bool) -> Result<(), String> {
        let torus = Torus::of_size(wanted)?;
        let elements = torus.mesh.elements.len();
        self.counts.push((wanted, elements));
        for law in LAWS {
            for precision in ["f64", "f32"] {
                for count in [1, threads()] {
                    let timed = on_threads(count, &torus, &Setting { precision, ..Setting::of_law(law) }, quick)?;
                    self.rows.push(row(wanted, &torus, law, precision, count, &timed));
                    if count == 1 && precision == "f64" {
                        self.judged.push((law, elements, timed.processor, timed.factorizations));
                    }
                    if threads() == 1 {
                        break;
                    }
                }
            }
        }
        let device = device_name().unwrap_or_else(|_| "no adapter".to_owned());
        for &(solver, tables) in SOLVERS {
            let is_on_device = tables.contains("\"gpu\"");
            let name = if is_on_device { format!("{solver}: {device}") } else { solver.to_owned() };
            if is_on_device && device_is_software() && std::env::var_os(SOFTWARE_ADAPTERS).is_none() {
                let why = format!("the adapter is a program on the processor: set {SOFTWARE_ADAPTERS}=1 to time it");
                self.solvers.push(solver_row(elements, &name, "", Err(why)));
                continue;
            }
            for precision in ["f64", "f32"] {
                let setting = Setting { tables, precision, ..Setting::default() };
                self.solvers.push(solver_row(elements, &name, precision, on_threads(1, &torus, &setting, quick)));
            }
        }
        self.parts.extend(share(&torus, wanted, if quick { 5 } else { 60 })?);
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

fn on_threads(count: usize, torus: &Torus, setting: &Setting, quick: bool) -> Result<Timed, String> {
    match count {
        1 => one_thread()?.install(|| timed(torus, setting, steps(quick))),
        _ => timed(torus, setting, steps(quick)),
    }
}

fn row(wanted: usize, torus: &Torus, law: &str, precision: &str, threads: usize, timed: &Timed) -> Vec<String> {
    let theirs = THEIRS.iter().find(|theirs| theirs.0 == wanted);
    let time = |time: Option<f64>| time.map_or(String::new(), |time| format!("{time}"));
    let mut row =
        vec![wanted.to_string(), torus.mesh.elements.len().to_string(), torus.mesh.vertices.len().to_string()];
    row.push(format!("{:.4}", torus.edge));
    row.extend([time(theirs.and_then(|theirs| theirs.1)), time(theirs.map(|theirs| theirs.2))]);
    row.extend([law.to_owned(), precision.to_owned(), threads.to_string()]);
    row.extend([timed.median, timed.p95, timed.first].map(|time| format!("{time:.3}")));
    row.extend([format!("{:.2}", timed.newton_iterations), timed.factorizations.to_string()]);
    row
}

/// A row of a solver; one that fails is in the table too.
fn solver_row(elements: usize, name: &str, precision: &str, timed: Result<Timed, String>) -> Vec<String> {
    let mut row = vec![elements.to_string(), name.to_owned(), precision.to_owned()];
    match timed {
        Ok(timed) => {
            row.extend([timed.median, timed.p95, timed.first].map(|time| format!("{time:.3}")));
            row.push(format!("{:.1}", timed.solver_iterations));
            row.push(if timed.unconverged == 0 {
                "converged".to_owned()
            } else {
                format!("{} not converged", timed.unconverged)
            });
        }
        Err(message) => row.extend(["", "", "", ""].map(str::to_owned).into_iter().chain([message])),
    }
    row
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_solver_that_fails_has_a_row_with_its_message() {
        let row = solver_row(5, "cg", "f32", Err("no convergence".to_owned()));
        assert_eq!(row.len(), 8);
        assert_eq!(row[7], "no convergence");
    }

    #[test]
    fn a_torus_ends_on_a_graphics_device_where_it_ends_on_the_processor() {
        let torus = Torus::of_size(660).unwrap();
        let end = |tables: &str| -> Result<_, String> {
            let tables = format!("{tables}[newton]\ntolerance = 2e-15\n");
            let mut simulation =
                Setting { law: "corotated", tables: &tables, ..Setting::default() }.torus(&torus.mesh)?;
            let start = simulation.positions();
            (0..5).try_for_each(|_| crate::scenes::step(&mut *simulation))?;
            Ok((start, simulation.positions()))
        };
        // Kept Cholesky factors leave 1e-10 of it.
        let (start, expected) = end("[solver]\nkind = \"pcg\"\ntolerance = 1e-14\n").unwrap();
        for (precision, bound) in [("f32", 1e-10), ("f64", 1e-12)] {
            let found = end(&format!("[solver]\nkind = \"gpu\"\nprecision = \"{precision}\"\ntolerance = 1e-13\n"));
            match found {
                Ok((_, found)) => {
                    let error = (&found - &expected).amax() / (&expected - &start).amax();
                    println!("{precision}: {error:e} of the displacement");
                    assert!(error < bound, "{precision}: {error:e}");
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
