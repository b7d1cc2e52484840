//! `class.html`: a whole class on one page, for the instructor.

use std::collections::BTreeMap;

use fem_chart::{Axis, Bar, Chart, Dot, Series, bars, histogram};
use grader::status::Status;
use maud::{Markup, html};

use super::page::{chart, figure, name, page};
use super::rows::Row;
use super::study::{CHART, REFERENCE, SUBMISSION};
use super::{escape, view};
use crate::grade::Grade;

/// Groups of statuses, with the numbers of their colours.
const GROUPS: [(&str, usize); 4] = [("passed", 2), ("failed", 7), ("no answer", 6), ("missing", 8)];

/// The most common diagnoses that the page lists.
const DIAGNOSES: usize = 15;

/// The text of `class.html`. Figures and charts include graded submissions only; the table includes all.
pub fn render(rows: &[Row]) -> String {
    let grades: Vec<&Grade> = rows.iter().filter_map(Row::grade).collect();
    let shares: Vec<f64> = grades.iter().map(|grade| share(grade)).collect();
    let body = html! {
        (head(rows, &grades))
        div class="charts" {
            (chart("Scores", &histogram("Distribution of scores", &shares), "Submissions by share of the points."))
            (error_against_time(rows))
            (success(&grades))
            (common_diagnoses(&grades))
        } "\n"
        (table(rows))
    };
    page("Class", body)
}

fn head(rows: &[Row], grades: &[&Grade]) -> Markup {
    let submissions = rows.iter().filter(|row| row.has_submission()).count();
    let mut shares: Vec<f64> = grades.iter().map(|grade| share(grade)).collect();
    shares.sort_by(f64::total_cmp);
    let percent = |share: Option<f64>| share.map_or("–".to_owned(), |share| format!("{:.0} %", 100.0 * share));
    let mean = (!shares.is_empty()).then(|| shares.iter().sum::<f64>() / shares.len() as f64);
    let complete = grades.iter().filter(|grade| view::parts(grade).all(|p| p.status == Status::Passed)).count();
    html! {
        h1 { "Class" }
        div class="figures" {
            (figure(&submissions.to_string(), "students with a submission"))
            @if grades.len() < submissions { (figure(&(submissions - grades.len()).to_string(), "without a grade")) }
            @if submissions < rows.len() { (figure(&(rows.len() - submissions).to_string(), "students without a submission")) }
            (figure(&percent(median(&shares)), "median score"))
            (figure(&percent(mean), "mean score"))
            (figure(&complete.to_string(), "pass everything"))
        } "\n"
    }
}

fn share(grade: &Grade) -> f64 {
    view::fraction(grade.score, grade.max_score)
}

fn median(sorted: &[f64]) -> Option<f64> {
    let upper = *sorted.get(sorted.len() / 2)?;
    if sorted.len() % 2 == 1 { Some(upper) } else { Some(0.5 * (upper + sorted[sorted.len() / 2 - 1])) }
}

/// Every submission with a right function, and the reference among them.
fn error_against_time(rows: &[Row]) -> Markup {
    let heading = "Error against run time";
    let dots = |is_full: bool| rows.iter().filter_map(|row| dot(row, is_full)).collect::<Vec<_>>();
    let mut references: Vec<f64> = rows.iter().filter_map(Row::grade).filter_map(full_reference).collect();
    references.sort_by(f64::total_cmp);
    let reference = median(&references).map(|x| {
        let title = format!("reference: {}", view::seconds(Some(x)));
        Dot { x, y: view::ERROR_FLOOR, title, ..Dot::default() }
    });
    let series = |name: &str, colour, is_hollow, dots| Series {
        name: name.to_owned(),
        colour,
        is_hollow,
        has_dots: true,
        dots,
        ..Series::default()
    };
    let mut figure =
        Chart::new(heading, Axis::log("run time, sum over the functions (s)"), Axis::log("worst relative error"));
    figure.size = CHART;
    figure.series = vec![
        series("all functions are right", SUBMISSION, false, dots(true)),
        series("some functions are wrong: their time is not in the sum", SUBMISSION, true, dots(false)),
        series("reference, at round-off", REFERENCE, false, reference.into_iter().collect()),
    ];
    figure.series.retain(|series| !series.dots.is_empty());
    if figure.series.is_empty() {
        return html! { figure { h2 { (heading) } p class="soft" { "No submission has a right function yet." } } };
    }
    chart(heading, &figure.draw(), "Errors below 1e-16 are drawn at 1e-16.")
}

/// A submission's error and time; `None` unless all functions are right, or some are not, as asked.
fn dot(row: &Row, is_full: bool) -> Option<Dot> {
    let grade = row.grade()?;
    let (seconds, right) = view::total_seconds(grade);
    let (x, error) = (seconds?, view::worst_error(grade)?);
    let title = format!(
        "{}: error {}, {}, {right} of {} functions right, {} points",
        escape::line(&row.entry.student),
        view::error(Some(error)),
        view::seconds(Some(x)),
        grade.functions.len(),
        view::points(grade.score)
    );
    let is_wanted = (right == grade.functions.len()) == is_full;
    is_wanted.then(|| Dot { x, y: error.max(view::ERROR_FLOOR), title, ..Dot::default() })
}

/// The reference's time if all functions were timed: sums over fewer functions are not comparable.
fn full_reference(grade: &Grade) -> Option<f64> {
    let (seconds, timed) = view::reference_seconds(grade);
    seconds.filter(|_| timed == grade.functions.len())
}

fn success(grades: &[&Grade]) -> Markup {
    let names = grades.first().map_or(Vec::new(), |grade| view::parts(grade).map(|part| part.name.as_str()).collect());
    let all: Vec<Bar> = names.iter().map(|name| bar(name, grades)).collect();
    let heading = "Success per function";
    chart(heading, &bars(heading, &GROUPS, &all, |count, _| format!("{count:.0}")), "Submissions by outcome.")
}

fn bar(name: &str, grades: &[&Grade]) -> Bar {
    let mut counts = [0_usize; GROUPS.len()];
    for part in grades.iter().filter_map(|grade| view::parts(grade).find(|part| part.name == name)) {
        counts[group(part.status)] += 1;
    }
    let all = counts.iter().sum::<usize>().max(1) as f64;
    Bar {
        name: escape::line(name),
        shares: counts.map(|count| count as f64).to_vec(),
        figure: format!("{:.0} %", 100.0 * counts[0] as f64 / all),
    }
}

fn group(status: Status) -> usize {
    match status {
        Status::Passed => 0,
        Status::Failed => 1,
        Status::Crashed | Status::TimedOut | Status::DidNotCompile | Status::Refused => 2,
        Status::Missing => 3,
    }
}

fn common_diagnoses(grades: &[&Grade]) -> Markup {
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for part in grades.iter().flat_map(|grade| view::parts(grade)) {
        if let Some(diagnosis) = &part.diagnosis {
            *counts.entry((&part.name, diagnosis)).or_default() += 1;
        }
    }
    let mut ordered: Vec<_> = counts.into_iter().collect();
    ordered.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    html! {
        figure {
            h2 { "Most common diagnoses" }
            @if ordered.is_empty() {
                p class="soft" { "None: no known mistake explains a wrong answer." }
            } @else {
                div class="scroll" { table {
                    tr { th { "function" } th { "diagnosis" } th class="right" { "submissions" } } "\n"
                    @for ((function, diagnosis), count) in ordered.into_iter().take(DIAGNOSES) {
                        tr {
                            td class="name" { (name(function)) } td { (escape::plain(diagnosis)) } td class="right" { (count) }
                        } "\n"
                    }
                } }
            }
        } "\n"
    }
}

fn table(rows: &[Row]) -> Markup {
    html! {
        h2 { "Submissions" }
        div class="scroll" { table {
            tr {
                th { "student" } th { "submission" } th class="right" { "points" } th class="right" { "functions" }
                th class="right" { "worst error" } th class="right" { "run time" } th { "remarks" }
            } "\n"
            @for row in rows { (line(row)) "\n" }
        } }
    }
}

fn line(row: &Row) -> Markup {
    let submission = escape::line(&row.entry.submission);
    let figures = row.grade().map_or(["–"; 4].map(str::to_owned), figures);
    html! {
        tr {
            td { (escape::plain(&row.entry.student)) }
            td { @if let Some(page) = row.page() { a href=(escape::link(&page)) { (submission) } } @else { (submission) } }
            @for figure in figures { td class="right" { (figure) } }
            td class="soft wide" { (escape::plain(&row.notes().join("; "))) }
        }
    }
}

fn figures(grade: &Grade) -> [String; 4] {
    let (passed, all) = view::passed(grade);
    [
        format!("{} / {}", view::points(grade.score), view::points(grade.max_score)),
        format!("{passed} / {all}"),
        view::error(view::worst_error(grade)),
        view::seconds(view::total_seconds(grade).0),
    ]
}
