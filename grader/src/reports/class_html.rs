//! `class.html`: a whole class on one page, for the instructor.

use std::collections::BTreeMap;

use grader::status::Status;

use super::charts::{self, Bar, Point};
use super::page::{figure, page};
use super::rows::Row;
use super::{escape, view};
use crate::grade::Grade;

/// Statuses as the bars group them: class in the page's style, words.
const GROUPS: [(&str, &str); 4] =
    [("s-passed", "passed"), ("s-failed", "failed"), ("s-broken", "gives no answer"), ("s-missing", "missing")];

/// The most common diagnoses that the page lists.
const DIAGNOSES: usize = 15;

/// The text of `class.html`. Figures and charts count what is graded; the table holds every row.
pub fn render(rows: &[Row]) -> String {
    let grades: Vec<&Grade> = rows.iter().filter_map(Row::grade).collect();
    let mut body = head(rows.len(), &grades);
    body.push_str("<div class=\"charts\">\n<figure>\n<h2>Scores</h2>\n");
    let shares: Vec<f64> = grades.iter().map(|grade| share(grade)).collect();
    body.push_str(&charts::histogram(&shares));
    body.push_str("<figcaption>Submissions by share of the points.</figcaption>\n</figure>\n");
    body.push_str(&error_against_time(rows));
    body.push_str(&success(&grades));
    body.push_str(&common_diagnoses(&grades));
    body.push_str("</div>\n");
    body.push_str(&table(rows));
    page("Class", &body)
}

fn head(submissions: usize, grades: &[&Grade]) -> String {
    let mut shares: Vec<f64> = grades.iter().map(|grade| share(grade)).collect();
    shares.sort_by(f64::total_cmp);
    let percent = |share: Option<f64>| share.map_or("–".to_owned(), |share| format!("{:.0} %", 100.0 * share));
    let mean = (!shares.is_empty()).then(|| shares.iter().sum::<f64>() / shares.len() as f64);
    let complete = grades.iter().filter(|grade| view::parts(grade).all(|p| p.status == Status::Passed)).count();
    let mut head = String::from("<h1>Class</h1>\n<div class=\"figures\">\n");
    head.push_str(&figure(&submissions.to_string(), "submissions"));
    if grades.len() < submissions {
        head.push_str(&figure(&(submissions - grades.len()).to_string(), "without a grade"));
    }
    head.push_str(&figure(&percent(median(&shares)), "median score"));
    head.push_str(&figure(&percent(mean), "mean score"));
    head.push_str(&figure(&complete.to_string(), "pass everything"));
    head + "</div>\n"
}

fn share(grade: &Grade) -> f64 {
    view::fraction(grade.score, grade.max_score)
}

fn median(sorted: &[f64]) -> Option<f64> {
    let upper = *sorted.get(sorted.len() / 2)?;
    if sorted.len() % 2 == 1 { Some(upper) } else { Some(0.5 * (upper + sorted[sorted.len() / 2 - 1])) }
}

/// Every submission that answers, and the reference among them.
fn error_against_time(rows: &[Row]) -> String {
    let mut points: Vec<Point> = rows.iter().filter_map(point).collect();
    let mut references: Vec<f64> = rows.iter().filter_map(Row::grade).filter_map(full_reference).collect();
    references.sort_by(f64::total_cmp);
    if let Some(x) = median(&references) {
        let title = format!("reference: {}", view::seconds(Some(x)));
        points.push(Point { x, y: view::ERROR_FLOOR, title, class: "reference" });
    }
    let mut figure = String::from("<figure>\n<h2>Error against run time</h2>\n");
    if points.is_empty() {
        return figure + "<p class=\"soft\">No submission has answered yet.</p>\n</figure>\n";
    }
    figure.push_str(&charts::scatter(&points, "run time, sum over the functions (s)", "worst relative error"));
    figure.push_str("<figcaption>Hollow: some functions give no answer, so their time is not in the sum. ");
    figure.push_str("Red: the reference, at rounding error. Errors below 1e-16 are drawn there.</figcaption>\n");
    figure + "</figure>\n"
}

fn point(row: &Row) -> Option<Point> {
    let grade = row.grade()?;
    let (seconds, answered) = view::total_seconds(grade);
    let (x, error) = (seconds?, view::worst_error(grade)?);
    let title = format!(
        "{}: error {}, {}, {answered} of {} functions answer, {} points",
        escape::line(&row.entry.student),
        view::error(Some(error)),
        view::seconds(Some(x)),
        grade.functions.len(),
        view::points(grade.score)
    );
    let class = if answered == grade.functions.len() { "dot" } else { "dot part" };
    Some(Point { x, y: error.max(view::ERROR_FLOOR), title, class })
}

/// The reference's time where all functions were timed: sums over fewer would not compare.
fn full_reference(grade: &Grade) -> Option<f64> {
    let (seconds, timed) = view::reference_seconds(grade);
    seconds.filter(|_| timed == grade.functions.len())
}

fn success(grades: &[&Grade]) -> String {
    let names = grades.first().map_or(Vec::new(), |grade| view::parts(grade).map(|part| part.name.as_str()).collect());
    let bars: Vec<Bar> = names.iter().map(|name| bar(name, grades)).collect();
    let keys = GROUPS.map(|(class, words)| {
        let colour = class.trim_start_matches("s-");
        format!("<span class=\"key\" style=\"color:var(--{colour})\">{words}</span>")
    });
    format!(
        "<figure>\n<h2>Success per function</h2>\n{}<figcaption>{}</figcaption>\n</figure>\n",
        charts::bars(&bars),
        keys.concat()
    )
}

fn bar(name: &str, grades: &[&Grade]) -> Bar {
    let statuses = grades.iter().filter_map(|grade| view::parts(grade).find(|part| part.name == name));
    let mut counts = [0_usize; GROUPS.len()];
    for part in statuses {
        counts[group(part.status)] += 1;
    }
    let all = counts.iter().sum::<usize>().max(1) as f64;
    let told = GROUPS.iter().zip(counts).map(|((_, words), count)| format!("{words} {count}"));
    Bar {
        name: escape::line(name),
        shares: GROUPS.iter().zip(counts).map(|((class, _), count)| (*class, count as f64 / all)).collect(),
        figure: format!("{:.0} %", 100.0 * counts[0] as f64 / all),
        title: format!("{}: {}", escape::line(name), told.collect::<Vec<_>>().join(", ")),
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

fn common_diagnoses(grades: &[&Grade]) -> String {
    let mut counts: BTreeMap<(&str, &str), usize> = BTreeMap::new();
    for part in grades.iter().flat_map(|grade| view::parts(grade)) {
        if let Some(diagnosis) = &part.diagnosis {
            *counts.entry((&part.name, diagnosis)).or_default() += 1;
        }
    }
    let mut figure = String::from("<figure>\n<h2>Most common diagnoses</h2>\n");
    if counts.is_empty() {
        return figure + "<p class=\"soft\">None: no known mistake explains a wrong answer.</p>\n</figure>\n";
    }
    let mut ordered: Vec<_> = counts.into_iter().collect();
    ordered.sort_by_key(|(_, count)| std::cmp::Reverse(*count));
    figure.push_str("<div class=\"scroll\"><table>\n<tr><th>function</th><th>diagnosis</th>");
    figure.push_str("<th class=\"right\">submissions</th></tr>\n");
    for ((name, diagnosis), count) in ordered.into_iter().take(DIAGNOSES) {
        let (name, diagnosis) = (escape::name(name), escape::html(diagnosis));
        figure.push_str(&format!(
            "<tr><td class=\"name\">{name}</td><td>{diagnosis}</td><td class=\"right\">{count}</td></tr>\n"
        ));
    }
    figure + "</table></div>\n</figure>\n"
}

fn table(rows: &[Row]) -> String {
    let mut table = String::from("<h2>Submissions</h2>\n<div class=\"scroll\"><table>\n<tr><th>student</th>");
    table.push_str("<th>submission</th><th class=\"right\">points</th><th class=\"right\">functions</th>");
    table.push_str("<th class=\"right\">worst error</th><th class=\"right\">run time</th><th>remarks</th></tr>\n");
    for row in rows {
        table.push_str(&line(row));
    }
    table + "</table></div>\n"
}

fn line(row: &Row) -> String {
    let name = escape::html(&escape::line(&row.entry.submission));
    let submission = match row.page() {
        Some(page) => format!("<a href=\"{}\">{name}</a>", escape::link(&page)),
        None => name,
    };
    format!(
        "<tr><td>{}</td><td>{submission}</td>{}<td class=\"soft wide\">{}</td></tr>\n",
        escape::html(&row.entry.student),
        row.grade().map_or("<td class=\"right\">–</td>".repeat(4), figures),
        escape::html(&row.notes().join("; "))
    )
}

fn figures(grade: &Grade) -> String {
    let (passed, all) = view::passed(grade);
    format!(
        "<td class=\"right\">{} / {}</td><td class=\"right\">{passed} / {all}</td>\
         <td class=\"right\">{}</td><td class=\"right\">{}</td>",
        view::points(grade.score),
        view::points(grade.max_score),
        view::error(view::worst_error(grade)),
        view::seconds(view::total_seconds(grade).0)
    )
}
