//! `class.html`: a whole class on one page, for the instructor.

use std::collections::{BTreeMap, BTreeSet};

use fem_chart::{Axis, Bar, Chart, Dot, Series, bars, histogram};
use grader::status::Status;
use maud::{Markup, html};

use super::page::{chart, figure, name, page_with_table};
use super::rows::Row;
use super::study::{CHART, REFERENCE, SUBMISSION};
use super::{escape, view};
use crate::class::{Person, Summary};
use crate::grade::Grade;

/// Groups of statuses, with the numbers of their colours.
const GROUPS: [(&str, usize); 4] = [("passed", 2), ("failed", 7), ("no answer", 6), ("missing", 8)];

/// The most common diagnoses that the page lists.
const DIAGNOSES: usize = 15;

/// The text of `class.html`. Figures and charts include graded submissions only; the table includes all.
pub fn render(rows: &[Row], summary: &Summary) -> String {
    let grades: Vec<&Grade> = rows.iter().filter_map(Row::grade).collect();
    let shares: Vec<f64> = grades.iter().map(|grade| share(grade)).collect();
    let body = html! {
        (head(rows, &grades, &summary.title))
        div class="charts" {
            (chart("Scores", &histogram("Distribution of scores", &shares), "Submissions by share of the points."))
            (error_against_time(rows))
            (success(&grades))
            (common_diagnoses(&grades))
        } "\n"
        (table(rows, &summary.people))
    };
    page_with_table(&format!("{}: class", summary.title), body)
}

fn head(rows: &[Row], grades: &[&Grade], title: &str) -> Markup {
    let submissions = rows.iter().filter(|row| row.has_submission()).count();
    let names = rows.iter().filter(|row| row.has_submission()).map(|row| row.entry.submission.as_str());
    let different = names.collect::<BTreeSet<_>>().len();
    let mut shares: Vec<f64> = grades.iter().map(|grade| share(grade)).collect();
    shares.sort_by(f64::total_cmp);
    let percent = |share: Option<f64>| share.map_or("–".to_owned(), |share| format!("{:.0} %", 100.0 * share));
    let mean = (!shares.is_empty()).then(|| shares.iter().sum::<f64>() / shares.len() as f64);
    let complete = grades.iter().filter(|grade| view::parts(grade).all(|p| p.status == Status::Passed)).count();
    html! {
        h1 { (escape::line(title)) }
        div class="figures" {
            (figure(&submissions.to_string(), "students with a submission"))
            // Groups hand in one for several students.
            @if different < submissions { (figure(&different.to_string(), "submissions")) }
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

fn table(rows: &[Row], people: &[Person]) -> Markup {
    let has_names = people.iter().any(|person| !person.name.is_empty());
    html! {
        h2 { "Students and submissions" }
        div class="scroll" { table class="sortable" {
            thead { tr {
                th { "student" } @if has_names { th { "name" } } th { "submission" } th class="right" { "points" }
                th class="right" { "functions" } th class="right extra" { "worst error" } th class="right extra" { "run time" }
                th { "remarks" }
            } } "\n"
            tbody { "\n" @for row in rows { (line(row, has_names.then_some(people))) "\n" } }
        } }
    }
}

/// A row of the table; with people, it has their names.
fn line(row: &Row, people: Option<&[Person]>) -> Markup {
    let submission = escape::line(&row.entry.submission);
    let student = &row.entry.student;
    let name = |people: &[Person]| {
        let person = people.iter().find(|person| person.student == *student);
        person.map_or(String::new(), |person| escape::line(&person.name))
    };
    html! {
        tr {
            td { (escape::plain(student)) }
            @if let Some(people) = people { td { (name(people)) } }
            td { @if let Some(page) = row.page() { a href=(escape::link(&page)) { (submission) } } @else { (submission) } }
            @for (index, (figure, value)) in figures(row.grade()).into_iter().enumerate() {
                td class={ "right" @if index >= 2 { " extra" } } data-sort=[value] { (figure) }
            }
            td class="soft wide" { (escape::plain(&row.notes().join("; "))) }
        }
    }
}

/// Points, functions, error and time as people read them, with the numbers by which they are sorted.
fn figures(grade: Option<&Grade>) -> [(String, Option<f64>); 4] {
    let Some(grade) = grade else { return [const { None }; 4].map(|none: Option<f64>| ("–".to_owned(), none)) };
    let (passed, all) = view::passed(grade);
    let (error, seconds) = (view::worst_error(grade), view::total_seconds(grade).0);
    [
        (format!("{} / {}", view::points(grade.score), view::points(grade.max_score)), Some(grade.score)),
        (format!("{passed} / {all}"), Some(passed as f64)),
        (view::error(error), error.filter(|error| error.is_finite())),
        (view::seconds(seconds), seconds.filter(|seconds| seconds.is_finite())),
    ]
}
