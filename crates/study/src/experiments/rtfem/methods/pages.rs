//! Tables and pictures of the comparison.

use fem_chart::{Axis, Chart, Dot, Guide, Series};

use super::runs::{ALL, BUDGETS, Compared, Contender, ERRORS, Run, Swept};
use crate::study::{Figure, Table};

/// The tables: every run, errors within budgets, times to errors, the errors that no solver can avoid, failures.
pub fn tables(found: &[Compared]) -> Vec<Table> {
    vec![unavoidable(found), times(found), before_newton(found), budgets(found), failures(found), all_runs(found)]
}

/// A table whose rows begin with the cells of a case.
fn of_cases(name: &str, rest: &str, rows: Vec<Vec<String>>) -> Table {
    Table::new(name, &format!("body | >E (Pa) | >ν | >dt (s) | {rest}"), rows)
}

fn number(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), |value| format!("{value:.1e}"))
}

fn milliseconds(value: Option<f64>) -> String {
    value.map_or("–".to_owned(), |value| format!("{value:.3}"))
}

/// A number of iterations.
fn count(iterations: f64) -> String {
    if iterations.fract() == 0.0 { format!("{iterations}") } else { format!("{iterations:.2}") }
}

fn unavoidable(found: &[Compared]) -> Table {
    let row = |of: &Compared| {
        of.case.cells().into_iter().chain([of.time_error, of.model_error].map(|error| number(Some(error)))).collect()
    };
    let head = ">time error of implicit Euler | >model error of springs";
    of_cases("rtfem-methods-errors", head, found.iter().map(row).collect())
}

/// A row for each method on each case.
fn by_method(
    found: &[Compared],
    is_shown: impl Fn(&Swept) -> bool,
    cells: impl Fn(&Swept) -> Vec<String>,
) -> Vec<Vec<String>> {
    let row = |of: &Compared, swept: &Swept| -> Vec<String> {
        of.case.cells().into_iter().chain([swept.contender.name.to_owned()]).chain(cells(swept)).collect()
    };
    let rows = |of: &Compared| -> Vec<Vec<String>> {
        of.methods.iter().filter(|swept| is_shown(swept)).map(|swept| row(of, swept)).collect()
    };
    found.iter().flat_map(rows).collect()
}

fn times(found: &[Compared]) -> Table {
    let cells = |swept: &Swept| {
        let value = swept.runs.first().and_then(|run| run.value);
        let times = ERRORS.map(|error| milliseconds(swept.time_to(error)));
        times.into_iter().chain([value.map_or(String::new(), |value| value.to_string())]).collect()
    };
    let head = "method | >to a solver error of 1e-2 (ms a step) | >1e-3 | >1e-6 | >best parameter";
    let rows = by_method(found, |swept| swept.contender.has_solver_error(), cells);
    of_cases("rtfem-methods-times", head, rows)
}

/// The iterated methods that reach a solver error of 1e-3 before Newton's, at any modulus.
fn before_newton(found: &[Compared]) -> Table {
    let row = |of: &Compared, name: &str, part: f64| -> Vec<String> {
        of.case.cells().into_iter().chain([name.to_owned(), format!("{part:.2}")]).collect()
    };
    let rows = |of: &Compared| -> Vec<Vec<String>> {
        of.before_newton().into_iter().map(|(name, part)| row(of, name, part)).collect()
    };
    let head = "method | >its time to 1e-3 over that of Newton's method";
    of_cases("rtfem-methods-before-newton", head, found.iter().flat_map(rows).collect())
}

fn budgets(found: &[Compared]) -> Table {
    let cells = |swept: &Swept| -> Vec<String> {
        let of = |budget: f64| {
            let run = swept.within(budget);
            [number(run.and_then(|run| run.solver_error)), number(run.and_then(|run| run.total_error))]
        };
        BUDGETS.into_iter().flat_map(of).collect()
    };
    let head = "method | >solver error within 1 ms a step | >total | >solver error within 4 ms | >total | >solver error within 16 ms | >total";
    of_cases("rtfem-methods-budgets", head, by_method(found, |_| true, cells))
}

fn failures(found: &[Compared]) -> Table {
    let row = |contender: &Contender| {
        let of_it = || found.iter().flat_map(|of| &of.methods).filter(|swept| swept.contender.name == contender.name);
        let runs = || of_it().flat_map(|swept| &swept.runs);
        let inverted = runs().filter(|run| run.inverted > 0).count();
        let failed = runs().filter(|run| run.has_failed()).count();
        let counts = [runs().count(), failed, inverted].map(|n| n.to_string());
        [contender.name.to_owned()].into_iter().chain(counts).collect()
    };
    let head = "method | >runs | >failed | >of them with inverted elements";
    Table::new("rtfem-methods-failures", head, ALL.iter().map(row).collect())
}

fn all_runs(found: &[Compared]) -> Table {
    let cells = |of: &Compared, swept: &Swept, run: &Run| -> Vec<String> {
        let method = [swept.contender.name.to_owned(), run.iterations.map_or("–".to_owned(), count)];
        let figures = [
            run.value.map_or(String::new(), |value| value.to_string()),
            milliseconds(Some(run.milliseconds).filter(|time| time.is_finite())),
            number(run.solver_error),
            number(run.total_error),
            run.outcome.clone(),
        ];
        of.case.cells().into_iter().chain(method).chain(figures).collect()
    };
    let of_method =
        |of: &Compared, swept: &Swept| swept.runs.iter().map(|run| cells(of, swept, run)).collect::<Vec<_>>();
    let head = "method | >iterations | >parameter | >step, median (ms) | >solver error | >total error | outcome";
    let rows = found.iter().flat_map(|of| of.methods.iter().flat_map(|swept| of_method(of, swept)).collect::<Vec<_>>());
    of_cases("rtfem-methods", head, rows.collect())
}

/// A chart for each case at 1/60 s whose springs are fair: the solver error over the time of a step.
pub fn figures(found: &[Compared]) -> Vec<Figure> {
    let is_shown = |of: &&Compared| of.case.rate == 60 && of.case.poisson == 0.25;
    let figure = |of: &Compared| {
        let name = of.case.name();
        let caption = format!("{name}. Distance from the converged steps of implicit Euler over the time of a step.");
        Figure::new(format!("rtfem-methods-{:e}", of.case.young), chart(of).draw(), caption)
    };
    found.iter().filter(is_shown).map(figure).collect()
}

fn chart(of: &Compared) -> Chart {
    let label = format!("solver error and time of a step: {}", of.case.name());
    let mut chart = Chart::new(label, Axis::log("time of a step (ms)"), Axis::log("solver error"));
    let shown = of.methods.iter().filter(|swept| swept.contender.has_solver_error());
    for (number, swept) in shown.enumerate() {
        let dot = |run: &Run| {
            let iterations = run.iterations.map_or(String::new(), |n| format!("{} iterations\n", count(n)));
            let (x, y) = (run.milliseconds, run.solver_error?);
            Some(Dot::new(x, y, format!("{}\n{iterations}{x:.3} ms, {y:.1e}", swept.contender.name)))
        };
        let look = (number % fem_chart::COLOURS, number % fem_chart::SHAPES);
        chart.series.push(Series::joined(swept.contender.name, look, swept.runs.iter().filter_map(dot)));
    }
    chart.guides.push(Guide::Horizontal(of.time_error, "time error of implicit Euler".to_owned()));
    chart
}
