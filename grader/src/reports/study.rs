//! Charts of one submission's errors and run times beside the reference's: of each function, and of the whole simulation.
//!
//! Students see these charts. They show the figures of the report, and no inputs of the functions.

use fem_chart::{Axis, Chart, Dot, DotRow, Series, dot_rows};
use maud::{Markup, html};

use super::page::chart;
use super::{escape, view};
use crate::grade::{FunctionGrade, Grade, Outcome, Run, Study};

/// Numbers of colours.
pub const SUBMISSION: usize = 0;
pub const REFERENCE: usize = 7;

/// Width and height of a chart with two axes, pixels.
pub const CHART: (f64, f64) = (540.0, 380.0);

/// The charts, as a part of the student's page.
pub fn render(grade: &Grade, study: &Study) -> Markup {
    html! {
        h2 { "Beside the reference" }
        div class="charts" { (errors(grade)) (times(grade)) (whole_simulation(study)) } "\n"
    }
}

fn errors(grade: &Grade) -> Markup {
    let row = |part: &FunctionGrade| {
        let (name, error) = (escape::line(&part.name), part.error.filter(|error| error.is_finite()));
        let title = format!("{name}: {}", view::error(error));
        let dot = |error: f64| (Dot { x: error.max(view::ERROR_FLOOR), title, ..Dot::default() }, SUBMISSION);
        DotRow { name, dots: error.map(dot).into_iter().collect(), figure: view::error(error) }
    };
    let rows: Vec<DotRow> = view::parts(grade).map(row).collect();
    let picture = dot_rows("Error of each function", &Axis::log("relative error"), &rows);
    let caption = "Worst relative difference from the reference's answers; of the simulation, that of the positions. About 1e-16 is round-off; \
        smaller errors are drawn there.";
    chart("Error", &picture, caption)
}

fn times(grade: &Grade) -> Markup {
    let row = |part: &FunctionGrade| {
        let name = escape::line(&part.name);
        let dot = |seconds: Option<f64>, who: &str, colour| {
            let x = seconds.filter(|seconds| seconds.is_finite() && *seconds > 0.0)?;
            Some((Dot { x, title: format!("{name}, {who}: {}", view::seconds(seconds)), ..Dot::default() }, colour))
        };
        let own = dot(view::timed(part), "submission", SUBMISSION);
        let reference = own.is_some().then(|| dot(part.reference_seconds, "reference", REFERENCE)).flatten();
        DotRow { dots: reference.into_iter().chain(own).collect(), figure: view::ratio(part), name }
    };
    let rows: Vec<DotRow> = view::parts(grade).map(row).collect();
    let picture = dot_rows("Run time of each function", &Axis::log("run time (s)"), &rows);
    let caption = "One call of each right function on a standard load, and the whole simulation. Red: the reference on the same machine. On the right: time relative to the \
        reference. On a busy machine short times are uncertain.";
    chart("Run time", &picture, caption)
}

fn whole_simulation(study: &Study) -> Markup {
    let heading = "The whole simulation: error against run time";
    if study.runs.is_empty() {
        return html! {
            figure {
                h2 { (heading) }
                p class="soft" { "This submission has no runs of the simulation: the functions do not reach its end." }
            }
        };
    }
    let mut figure = Chart::new(heading, Axis::log("run time (s)"), Axis::log("error (m)"));
    (figure.size, figure.series) = (CHART, curves(&study.runs));
    let silent = study.runs.iter().filter(|run| run.submission.is_none()).count();
    let wrong = study.runs.iter().filter(|run| run.submission.is_some() && !run.is_right).count();
    let caption = html! {
        "A cube of 1 m for 0.2 s; each curve has one point for each time step. Error: largest distance of a vertex at the end from a motion \
         computed with a method of fourth order, whose uncertainty is " (format!("{:.0e}", study.uncertainty)) " m."
        @if silent > 0 {
            " " (silent) " of " (study.runs.len()) " runs of the submission gave no finite positions."
        }
        @if wrong > 0 {
            " " (wrong) " of " (study.runs.len()) " gave other positions than the reference's and are not drawn."
        }
    };
    html! { div { (chart(heading, &figure.draw(), caption)) (table(&study.runs)) } }
}

/// A curve for each integrator, of the reference and of the submission.
fn curves(runs: &[Run]) -> Vec<Series> {
    let curve = |integrator: &str, who: &str, colour, outcome: fn(&Run) -> Option<Outcome>| {
        let dot = |run: &Run| {
            let Outcome { error, seconds } = outcome(run).filter(|outcome| outcome.seconds > 0.0)?;
            let figures = format!("{:.1e} m, {}", error, view::seconds(Some(seconds)));
            let title = format!("{who}, {}, time step {} s: {figures}", words(integrator), run.dt);
            Some(Dot { x: seconds, y: error.max(view::ERROR_FLOOR), title, ..Dot::default() })
        };
        Series {
            name: format!("{who}, {}", words(integrator)),
            colour,
            is_joined: true,
            has_dots: true,
            is_hollow: integrator != "implicit_euler",
            dots: runs.iter().filter(|run| run.integrator == integrator).filter_map(dot).collect(),
            ..Series::default()
        }
    };
    let mut integrators: Vec<&str> = runs.iter().map(|run| run.integrator.as_str()).collect();
    integrators.dedup();
    let both = integrators.into_iter().flat_map(|integrator| {
        [
            curve(integrator, "reference", REFERENCE, |run| Some(run.reference)),
            curve(integrator, "submission", SUBMISSION, |run| run.submission.filter(|_| run.is_right)),
        ]
    });
    both.collect()
}

fn words(integrator: &str) -> String {
    escape::line(&integrator.replace('_', " "))
}

/// The figures of the chart, for paper and for screen readers.
fn table(runs: &[Run]) -> Markup {
    let error =
        |outcome: Option<Outcome>| outcome.map_or("–".to_owned(), |outcome| format!("{:.2e} m", outcome.error));
    let row = |run: &Run| {
        vec![
            words(&run.integrator),
            view::seconds(Some(run.dt)),
            error(run.submission),
            error(Some(run.reference)),
            view::seconds(run.submission.map(|own| own.seconds)),
            view::seconds(Some(run.reference.seconds)),
        ]
    };
    let head = ["integrator", ">time step", ">error", ">of reference", ">time", ">of reference"];
    fem_chart::page::table(&head, &runs.iter().map(row).collect::<Vec<_>>())
}
