//! Results of a sweep: one scene with many values of its keys, as a table and as a page with charts.

use fem_chart::page::{figure, page, table};
use fem_chart::{Axis, COLOURS, Chart, Dot, Picture, SHAPES, Series};
use maud::{Markup, html};

use crate::csv_table::csv_text;
use crate::report::text::{number, seconds};

/// A run of a sweep.
#[derive(Clone, Debug)]
pub struct SweptRun {
    /// Name of the scene.
    pub scene: String,
    /// The value of each key, as it was written.
    pub values: Vec<String>,
    /// `done`, or the reason why the result is not to be trusted.
    pub status: String,
    /// Number of steps.
    pub steps: usize,
    /// Time at their end, s.
    pub time: f64,
    /// Median wall time of a step, s; `None` without steps.
    pub median_step_seconds: Option<f64>,
    /// Iterations of Newton's method.
    pub newton_iterations: usize,
    /// Kinetic and potential energy, J.
    pub energies: [f64; 2],
    /// Minimum of det F.
    pub min_J: f64,
    /// Largest displacement of a node, m.
    pub largest_displacement: f64,
    /// File name of the state at the end.
    pub state: String,
}

impl SweptRun {
    /// Returns true if the run reached its end and converged.
    pub fn is_done(&self) -> bool {
        self.status == "done"
    }
}

/// Columns after the scene and the keys.
const RESULTS: [&str; 11] = [
    "status",
    "steps",
    "time",
    "median_step_seconds",
    "newton_iterations",
    "kinetic",
    "potential",
    "total",
    "min_J",
    "largest_displacement",
    "state",
];

/// The text of `sweep.csv`: a row for each run.
///
/// # Errors
/// Trouble of the CSV writer.
pub fn csv(keys: &[&str], runs: &[SweptRun]) -> Result<String, csv::Error> {
    let head: Vec<&str> = ["scene"].iter().chain(keys).chain(&RESULTS).copied().collect();
    let row = |run: &SweptRun| {
        let number = |value: f64| format!("{value:.9e}");
        let [kinetic, potential] = run.energies;
        let results = [
            run.status.clone(),
            run.steps.to_string(),
            number(run.time),
            run.median_step_seconds.map_or(String::new(), |seconds| format!("{seconds:.6e}")),
            run.newton_iterations.to_string(),
            number(kinetic),
            number(potential),
            number(kinetic + potential),
            number(run.min_J),
            number(run.largest_displacement),
            run.state.clone(),
        ];
        [run.scene.clone()].into_iter().chain(run.values.clone()).chain(results).collect::<Vec<_>>()
    };
    csv_text(&head, runs.iter().map(row))
}

/// The text of `sweep.html`: charts over every key that has several numbers as values, and the table.
pub fn html_page(keys: &[&str], runs: &[SweptRun]) -> String {
    let failed = runs.iter().filter(|run| !run.is_done()).count();
    let numeric = (0..keys.len()).filter(|&key| has_several_numbers(key, runs));
    let body = html! {
        h1 { "Sweep over " (keys.join(", ")) }
        p { (runs.len()) " runs; " (failed) " of them failed or did not converge, which the table tells." } "\n"
        @for key in numeric {
            h2 { (keys[key]) }
            (figure(&chart(keys, key, runs, "largest displacement (m)", |run| Some(run.largest_displacement)), "Largest displacement of a \
                node at the end."))
            (figure(&chart(keys, key, runs, "median time of a step (s)", |run| run.median_step_seconds), "Wall time; other work on the \
                machine enters it."))
        }
        h2 { "All runs" }
        (all_runs(keys, runs))
    };
    page("Sweep", body)
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
        let line = [std::slice::from_ref(&run.scene), &others].concat().join(", ");
        let title = format!("{line}\n{} = {}\n{name}: {}", keys[key], run.values[key], number(Some(y)));
        let dot = Dot { x, y, title, ..Dot::default() };
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
        let (colour, shape) = (place % COLOURS, place % SHAPES);
        chart.series.push(Series { name, colour, shape, is_joined: true, has_dots: true, dots, ..Series::default() });
    }
    chart.draw()
}

/// Logarithmic where positive values span more than a decade.
fn axis(name: &str, values: impl Iterator<Item = f64>) -> Axis {
    let (least, largest) =
        values.fold((f64::INFINITY, f64::NEG_INFINITY), |(least, most), x| (least.min(x), most.max(x)));
    if least > 0.0 && largest > 10.0 * least { Axis::log(name) } else { Axis::linear(name) }
}

fn all_runs(keys: &[&str], runs: &[SweptRun]) -> Markup {
    let results = [">steps", ">step", ">total energy, J", ">min det F", ">largest displacement, m", "status"];
    let head: Vec<&str> = ["scene"].iter().chain(keys).chain(&results).copied().collect();
    let row = |run: &SweptRun| {
        let results = [
            run.steps.to_string(),
            seconds(run.median_step_seconds),
            number(Some(run.energies.iter().sum())),
            number(Some(run.min_J)),
            number(Some(run.largest_displacement)),
            run.status.clone(),
        ];
        [run.scene.clone()].into_iter().chain(run.values.clone()).chain(results).collect()
    };
    table(&head, &runs.iter().map(row).collect::<Vec<Vec<String>>>())
}

#[cfg(test)]
mod tests {
    use super::{SweptRun, csv, html_page};

    fn run(values: [&str; 2], status: &str) -> SweptRun {
        SweptRun {
            scene: "beam".to_owned(),
            values: values.map(str::to_owned).to_vec(),
            status: status.to_owned(),
            steps: 4,
            time: 0.04,
            median_step_seconds: Some(1e-3),
            newton_iterations: 12,
            energies: [1.0, -3.0],
            min_J: 0.9,
            largest_displacement: 0.1,
            state: "beam-0001.json".to_owned(),
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
        let page = html_page(&keys, &runs);
        assert_eq!(page.matches("<figure").count(), 2, "{page}");
        assert!(page.contains("time.integrator = rk4") && page.contains("1 of them failed"), "{page}");
        assert!(page.contains("&lt;diverged&gt;"), "{page}");
        let table = csv(&keys, &runs).unwrap();
        assert_eq!(table.lines().count(), 8);
        assert!(table.starts_with("scene,material.young,time.integrator,status,steps,time,"), "{table}");
    }
}
