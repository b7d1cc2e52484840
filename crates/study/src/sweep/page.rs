//! The table and the page of runs: charts over every key that has several numbers.

use fem_chart::page::{figure, page, table};
use fem_chart::{Axis, COLOURS, Chart, Dot, Picture, SHAPES, Series};
use maud::{Markup, html};

use super::{Sweep, SweptRun, quantity};
use crate::machine::Machine;
use crate::report::text::{number, seconds};
use crate::study::csv_text;

/// A cell of the table.
type Cell = fn(&SweptRun) -> String;

/// Columns after the scene and the keys.
const RESULTS: [(&str, Cell); 11] = [
    ("status", |run| run.status.clone()),
    ("steps", |run| run.steps.to_string()),
    ("time", |run| digits(Some(run.time))),
    ("median_step_seconds", |run| run.median_step_seconds.map_or(String::new(), |seconds| format!("{seconds:.6e}"))),
    ("newton_iterations", |run| run.newton_iterations.to_string()),
    ("kinetic", |run| digits(run.energies[0])),
    ("potential", |run| digits(run.energies[1])),
    ("total", |run| digits(run.total())),
    ("min_J", |run| digits(run.min_J)),
    ("largest_displacement", |run| digits(run.largest_displacement)),
    ("state", |run| run.state.clone()),
];

/// Columns of a study that judges its rows.
const JUDGED: [(&str, Cell); 4] = [
    ("closed_form", |run| digits(run.closed_form)),
    ("distance", |run| digits(run.distance)),
    ("expected", |run| run.expected.map_or(String::new(), |expected| expected.to_string())),
    ("holds", |run| run.holds.map_or(String::new(), |holds| holds.to_string())),
];

fn digits(value: Option<f64>) -> String {
    value.map_or(String::new(), |value| format!("{value:.9e}"))
}

/// Columns before the results: the scene, the case if cases have names, the keys.
fn first_columns(of: &Sweep) -> (Vec<String>, impl Fn(&SweptRun) -> Vec<String> + use<>) {
    let has_names = of.scenes.iter().any(|scene| !scene.case.is_empty());
    let head = ["scene".to_owned()].into_iter().chain(has_names.then(|| "case".to_owned())).chain(of.keys.clone());
    let cells = move |run: &SweptRun| {
        let case = has_names.then(|| run.case.clone());
        [run.scene.clone()].into_iter().chain(case).chain(run.values.clone()).collect()
    };
    (head.collect(), cells)
}

/// The text of the table: a row for each run.
///
/// # Errors
/// Trouble of the CSV writer.
pub fn csv(of: &Sweep, runs: &[SweptRun]) -> Result<String, csv::Error> {
    let results = || RESULTS.iter().chain(JUDGED.iter().filter(|_| of.measure.is_some()));
    let (first, cells) = first_columns(of);
    let head: Vec<&str> = first.iter().map(String::as_str).chain(results().map(|(name, _)| *name)).collect();
    let row = |run: &SweptRun| cells(run).into_iter().chain(results().map(|(_, cell)| cell(run))).collect::<Vec<_>>();
    csv_text(&head, runs.iter().map(row))
}

/// The text of the page.
pub fn html_page(of: &Sweep, runs: &[SweptRun], machine: &Machine) -> String {
    let keys: Vec<&str> = of.keys.iter().map(String::as_str).collect();
    let failed = runs.iter().filter(|run| !run.is_done()).count();
    let judged = runs.iter().filter(|run| run.holds.is_some()).count();
    let wrong = runs.iter().filter(|run| run.holds == Some(false)).count();
    let numeric = (0..keys.len()).filter(|&key| has_several_numbers(key, runs));
    let body = html! {
        h1 { (of.title) }
        @if !of.about.is_empty() { p { (of.about) } "\n" }
        p { (runs.len()) " runs; " (failed) " of them failed or did not converge, which the table tells." } "\n"
        @if judged > 0 {
            div class="answer" {
                @if wrong == 0 { "All " b { (judged) } " rows are as expected." }
                @else { b { (wrong) } " of " (judged) " rows are not as expected." }
            } "\n"
        }
        p class="soft" { (machine.line()) "." } "\n"
        @for key in numeric {
            h2 { (keys[key]) }
            @for (name, quantity, caption) in charted(of) { (figure(&chart(&keys, key, runs, &name, quantity), caption)) }
        }
        h2 { "All runs" }
        (all_runs(of, runs))
    };
    page(&of.title, body)
}

/// Quantities with their names and captions.
type Charted = (String, fn(&SweptRun) -> Option<f64>, &'static str);

/// The quantities that are drawn over a key: the measured one first.
fn charted(of: &Sweep) -> Vec<Charted> {
    let always: [Charted; 2] = [
        (
            "largest displacement (m)".to_owned(),
            |run| run.largest_displacement,
            "Largest displacement of a node at the end.",
        ),
        (
            "median time of a step (s)".to_owned(),
            |run| run.median_step_seconds,
            "Wall time; other work on the machine enters it.",
        ),
    ];
    let measured = of.measure.as_ref().map(|measure| &measure.quantity);
    let measured = measured.filter(|name| !["largest_displacement", "median_step_seconds"].contains(&name.as_str()));
    let first = measured.and_then(|name| Some((name.replace('_', " "), quantity(name)?, "The result that is judged.")));
    first.into_iter().chain(always).collect()
}

fn number_of(text: &str) -> Option<f64> {
    text.replace('_', "").parse().ok().filter(|value: &f64| value.is_finite())
}

fn has_several_numbers(key: usize, runs: &[SweptRun]) -> bool {
    let values: Option<Vec<f64>> = runs.iter().map(|run| number_of(&run.values[key])).collect();
    values.is_some_and(|values| values.iter().any(|value| *value != values[0]))
}

/// One quantity over one key, with a line for each combination of the others.
fn chart(
    keys: &[&str],
    key: usize,
    runs: &[SweptRun],
    name: &str,
    quantity: impl Fn(&SweptRun) -> Option<f64>,
) -> Picture {
    let mut lines: Vec<(String, Vec<Dot>)> = Vec::new();
    for run in runs.iter().filter(|run| run.is_done()) {
        let (Some(x), Some(y)) = (number_of(&run.values[key]), quantity(run)) else { continue };
        let others = (0..keys.len()).filter(|&other| other != key);
        let others: Vec<String> = others.map(|other| format!("{} = {}", keys[other], run.values[other])).collect();
        let case = Some(run.case.clone()).filter(|case| !case.is_empty());
        let line = [run.scene.clone()].into_iter().chain(case).chain(others).collect::<Vec<_>>().join(", ");
        let title = format!("{line}\n{} = {}\n{name}: {}", keys[key], run.values[key], number(Some(y)));
        let dot = Dot::new(x, y, title);
        match lines.iter_mut().find(|(found, _)| *found == line) {
            Some((_, dots)) => dots.push(dot),
            None => lines.push((line, vec![dot])),
        }
    }
    let dots = || lines.iter().flat_map(|(_, dots)| dots);
    let x = axis(keys[key], dots().map(|dot| dot.x));
    let y = axis(name, dots().map(|dot| dot.y));
    let mut chart = Chart::new(format!("{name} over {}", keys[key]), x, y);
    for (place, (name, mut dots)) in lines.into_iter().enumerate() {
        dots.sort_by(|a, b| a.x.total_cmp(&b.x));
        chart.series.push(Series::joined(name, (place % COLOURS, place % SHAPES), dots));
    }
    chart.draw()
}

/// Logarithmic where positive values span more than a decade.
fn axis(name: &str, values: impl Iterator<Item = f64>) -> Axis {
    let (least, largest) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), x| (least.min(x), most.max(x)));
    if least > 0.0 && largest > 10.0 * least { Axis::log(name) } else { Axis::linear(name) }
}

fn all_runs(of: &Sweep, runs: &[SweptRun]) -> Markup {
    let results: [(&str, Cell); 6] = [
        (">steps", |run| run.steps.to_string()),
        (">step", |run| seconds(run.median_step_seconds)),
        (">total energy, J", |run| number(run.total())),
        (">min det F", |run| number(run.min_J)),
        (">largest displacement, m", |run| number(run.largest_displacement)),
        ("status", |run| run.status.clone()),
    ];
    let judged: [(&str, Cell); 4] = [
        (">closed form", |run| number(run.closed_form)),
        (">distance", |run| number(run.distance)),
        (">expected", |run| number(run.expected)),
        ("", |run| run.holds.map_or("", |holds| if holds { "as expected" } else { "not as expected" }).to_owned()),
    ];
    let results = || results.iter().chain(judged.iter().filter(|_| of.measure.is_some()));
    let (first, cells) = first_columns(of);
    let head: Vec<&str> = first.iter().map(String::as_str).chain(results().map(|(name, _)| *name)).collect();
    let row = |run: &SweptRun| cells(run).into_iter().chain(results().map(|(_, cell)| cell(run))).collect();
    table(&head, &runs.iter().map(row).collect::<Vec<Vec<String>>>())
}

#[cfg(test)]
mod tests {
    use std::path::{Path, PathBuf};

    use super::*;

    fn run(values: [&str; 2], status: &str) -> SweptRun {
        SweptRun {
            scene: "beam".to_owned(),
            values: values.map(str::to_owned).to_vec(),
            status: status.to_owned(),
            steps: 4,
            time: 0.04,
            median_step_seconds: Some(1e-3),
            newton_iterations: 12,
            energies: [Some(1.0), Some(-3.0)],
            min_J: Some(0.9),
            largest_displacement: Some(0.1),
            state: "beam-0001.json".to_owned(),
            ..SweptRun::default()
        }
    }

    #[test]
    fn a_key_of_numbers_has_charts_and_a_key_of_words_has_a_line_for_each() {
        let keys = ["material.young", "time.integrator"];
        let mut runs: Vec<SweptRun> = ["1e5", "1e6", "1_000_0000"]
            .into_iter()
            .flat_map(|young| ["verlet", "rk4"].map(|method| run([young, method], "done")))
            .collect();
        runs.push(run(["1e9", "verlet"], "failed: step 3: <diverged>"));
        let sweep = Sweep {
            name: "sweep".to_owned(),
            title: "Sweep".to_owned(),
            about: String::new(),
            keys: keys.map(str::to_owned).to_vec(),
            scenes: Vec::new(),
            measure: None,
            arguments: Vec::new(),
            out: PathBuf::new(),
            factory: &|_| Err(String::new()),
        };
        let page = html_page(&sweep, &runs, &Machine::this(Path::new(".")));
        assert_eq!(page.matches("<figure").count(), 2, "{page}");
        assert!(page.contains("time.integrator = rk4") && page.contains("1 of them failed"), "{page}");
        assert!(page.contains("&lt;diverged&gt;"), "{page}");
        let table = csv(&sweep, &runs).unwrap();
        assert_eq!(table.lines().count(), 8);
        assert!(table.starts_with("scene,material.young,time.integrator,status,steps,time,"), "{table}");
    }
}
