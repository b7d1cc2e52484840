//! Errors and run times of one submission beside the reference's, as pictures: of each function, and of the whole simulation.
//!
//! Students see these. They hold figures that the report tells anyway, and nothing of what a function was asked.

use super::charts::{self, Point, Row};
use super::{escape, view};
use crate::grade::{FunctionGrade, Grade, Outcome, Run, Study};

/// The pictures, as a part of the student's page.
pub fn render(grade: &Grade, study: &Study) -> String {
    let mut part = String::from("<h2>Beside the reference</h2>\n<div class=\"charts\">\n");
    part.push_str(&errors(grade));
    part.push_str(&times(grade));
    part.push_str(&whole_simulation(study));
    part + "</div>\n"
}

fn errors(grade: &Grade) -> String {
    let row = |part: &FunctionGrade| {
        let error = part.error.filter(|error| error.is_finite());
        let title = format!("{}: {}", escape::line(&part.name), view::error(error));
        let point = |error: f64| Point { x: error.max(view::ERROR_FLOOR), y: 1.0, title, class: "dot" };
        Row {
            name: escape::line(&part.name),
            points: error.map(point).into_iter().collect(),
            figure: view::error(error),
        }
    };
    let rows: Vec<Row> = view::parts(grade).map(row).collect();
    format!(
        "<figure>\n<h2>Error</h2>\n{}<figcaption>Worst relative difference from the reference&#39;s answers; of the \
         simulation, that of the positions. About 1e-16 is round-off; smaller ones are drawn there.</figcaption>\n</figure>\n",
        charts::rows(&rows, "Error of each function", "relative error")
    )
}

fn times(grade: &Grade) -> String {
    let row = |part: &FunctionGrade| {
        let point = |seconds: Option<f64>, who: &str, class| {
            let x = seconds.filter(|seconds| seconds.is_finite() && *seconds > 0.0)?;
            let title = format!("{}, {who}: {}", escape::line(&part.name), view::seconds(seconds));
            Some(Point { x, y: 1.0, title, class })
        };
        let own = point(part.seconds, "submission", "dot");
        let reference = own.is_some().then(|| point(part.reference_seconds, "reference", "reference")).flatten();
        let points = reference.into_iter().chain(own).collect();
        Row { name: escape::line(&part.name), points, figure: view::ratio(part) }
    };
    let rows: Vec<Row> = view::parts(grade).map(row).collect();
    format!(
        "<figure>\n<h2>Run time</h2>\n{}<figcaption>One call on a standard load, and the whole simulation. Red: the reference on \
         the same machine. On the right: how many times as long as the reference. On a busy machine short times are uncertain.</figcaption>\n</figure>\n",
        charts::rows(&rows, "Run time of each function", "run time (s)")
    )
}

fn whole_simulation(study: &Study) -> String {
    let mut figure = String::from("<figure>\n<h2>The whole simulation: error against run time</h2>\n");
    if study.runs.is_empty() {
        return figure
            + "<p class=\"soft\">There is none: it needs functions with which it comes to its end.</p>\n</figure>\n";
    }
    let curves: Vec<Vec<Point>> = curves(&study.runs);
    let silent = study.runs.iter().filter(|run| run.submission.is_none()).count();
    if silent > 0 {
        let all = study.runs.len();
        figure.push_str(&format!(
            "<p>{silent} of {all} runs of the submission gave no positions that are numbers.</p>\n"
        ));
    }
    figure.push_str(&charts::curves(&curves, "run time (s)", "error (m)"));
    figure.push_str("<figcaption>A cube of 1 m for 0.2 s; each curve has one point for each time step. Filled: ");
    figure.push_str(
        "implicit Euler; hollow: linearly implicit Euler. Blue: the submission; red: the reference. Error: largest ",
    );
    figure.push_str(
        "distance of a vertex at the end from the motion that a method of fourth order gives, which is known to ",
    );
    figure.push_str(&format!("{:.0e} m.</figcaption>\n{}</figure>\n", study.uncertainty, table(&study.runs)));
    figure
}

/// A curve for each integrator, of the reference and of the submission.
fn curves(runs: &[Run]) -> Vec<Vec<Point>> {
    let curve = |integrator: &str, who: &str, class, outcome: fn(&Run) -> Option<Outcome>| {
        let of_integrator = runs.iter().filter(|run| run.integrator == integrator);
        let point = |run: &Run| {
            let Outcome { error, seconds } = outcome(run).filter(|outcome| outcome.seconds > 0.0)?;
            let figures = format!("{:.1e} m, {}", error, view::seconds(Some(seconds)));
            let title = format!("{who}, {}, time step {} s: {figures}", words(integrator), run.dt);
            Some(Point { x: seconds, y: error.max(view::ERROR_FLOOR), title, class })
        };
        of_integrator.filter_map(point).collect()
    };
    let mut integrators: Vec<&str> = runs.iter().map(|run| run.integrator.as_str()).collect();
    integrators.dedup();
    let both = integrators.into_iter().flat_map(|integrator| {
        let is_filled = integrator == "implicit_euler";
        let (own, ours) = if is_filled { ("dot", "reference") } else { ("dot part", "reference part") };
        [
            curve(integrator, "reference", ours, |run| Some(run.reference)),
            curve(integrator, "submission", own, |run| run.submission),
        ]
    });
    both.collect()
}

fn words(integrator: &str) -> String {
    escape::line(&integrator.replace('_', " "))
}

/// The figures, for readers of paper and of screens that are read aloud.
fn table(runs: &[Run]) -> String {
    let mut table =
        String::from("<div class=\"scroll\"><table>\n<tr><th>integrator</th><th class=\"right\">time step</th>");
    table.push_str("<th class=\"right\">error</th><th class=\"right\">of reference</th>");
    table.push_str("<th class=\"right\">time</th><th class=\"right\">of reference</th></tr>\n");
    let error =
        |outcome: Option<Outcome>| outcome.map_or("–".to_owned(), |outcome| format!("{:.2e} m", outcome.error));
    for run in runs {
        let own = run.submission;
        let cells = [
            view::seconds(Some(run.dt)),
            error(own),
            error(Some(run.reference)),
            view::seconds(own.map(|own| own.seconds)),
            view::seconds(Some(run.reference.seconds)),
        ];
        let cells = cells.map(|cell| format!("<td class=\"right\">{cell}</td>")).concat();
        table.push_str(&format!("<tr><td>{}</td>{cells}</tr>\n", escape::html(&words(&run.integrator))));
    }
    table + "</table></div>\n"
}
