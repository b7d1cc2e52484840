//! `report.html`: the student's report as a page.

use grader::status::Status;

use super::page::{figure, page};
use super::{escape, study, view};
use crate::grade::{CheckGrade, FunctionGrade, Grade};

/// The text of `report.html`.
pub fn render(grade: &Grade, show_diagnosis: bool) -> String {
    let mut body = head(grade);
    body.push_str("<h2>Functions</h2>\n<div class=\"row head\"><span>function</span><span>status</span>");
    body.push_str("<span class=\"right\">points</span><span class=\"right\">error</span>");
    body.push_str("<span class=\"right\">time (of reference)</span></div>\n");
    for part in view::parts(grade) {
        body.push_str(&function(part, show_diagnosis));
    }
    body.push_str("<p class=\"soft\">Error: worst relative difference from the reference. ");
    body.push_str("Time: one call on a standard load.</p>\n");
    if let Some(found) = &grade.study {
        body.push_str(&study::render(grade, found));
    }
    page(&grade.submission, &body)
}

fn head(grade: &Grade) -> String {
    let (passed, all) = view::passed(grade);
    let score = format!("{} / {}", view::points(grade.score), view::points(grade.max_score));
    let share = 100.0 * view::fraction(grade.score, grade.max_score);
    let mut head = format!("<h1>{}</h1>\n<div class=\"figures\">\n", escape::html(&escape::line(&grade.submission)));
    head.push_str(&figure(&score, "points"));
    head.push_str(&figure(&format!("{passed} of {all}"), "functions pass"));
    head.push_str(&figure(&view::error(view::worst_error(grade)), "worst error"));
    head.push_str("</div>\n");
    head.push_str(&format!("<div class=\"meter\"><i style=\"width:{share:.1}%\"></i></div>\n"));
    if !grade.remarks.is_empty() {
        let items = grade.remarks.iter().map(|remark| format!("<li>{}</li>\n", escape::html(remark)));
        head.push_str(&format!("<ul class=\"remarks\">\n{}</ul>\n", items.collect::<String>()));
    }
    head
}

fn function(part: &FunctionGrade, show_diagnosis: bool) -> String {
    let open = if part.status == Status::Passed { "" } else { " open" };
    format!("<details{open}>\n{}{}</details>\n", summary(part), inside(part, show_diagnosis))
}

fn summary(part: &FunctionGrade) -> String {
    let time = match part.seconds {
        Some(_) => format!("{} ({})", view::seconds(part.seconds), view::ratio(part)),
        None => "–".to_owned(),
    };
    format!(
        "<summary class=\"row\"><span class=\"name\">{}</span>{}<span class=\"right\">{} / {}</span>\
         <span class=\"right extra\">{}</span><span class=\"right extra\">{}</span></summary>\n",
        escape::name(&part.name),
        chip(part.status),
        view::points(part.score),
        view::points(part.max_score),
        view::error(part.error),
        time,
    )
}

/// A status with its colour.
fn chip(status: Status) -> String {
    format!("<span class=\"chip {}\">{}</span>", view::key(status), view::label(status))
}

fn inside(part: &FunctionGrade, show_diagnosis: bool) -> String {
    let mut inside = String::from("<div class=\"inside\">\n");
    for note in view::notes(part, show_diagnosis) {
        let escaped = escape::html(note.trim_end());
        // A compiler's message lives from its columns.
        let block =
            if escaped.contains('\n') { format!("<pre>{escaped}</pre>\n") } else { format!("<p>{escaped}</p>\n") };
        inside.push_str(&block);
    }
    let checks: String = part.checks.iter().map(check).collect();
    if !checks.is_empty() {
        inside.push_str(&format!("<ul class=\"checks\">\n{checks}</ul>\n"));
    }
    inside + "</div>\n"
}

fn check(check: &CheckGrade) -> String {
    let name = escape::html(&view::sentence(&check.name));
    match check.status {
        Status::Passed => format!("<li class=\"yes\">{name}</li>\n"),
        status => format!(
            "<li class=\"no\">{name} <span class=\"soft\">({})</span><p>{}</p></li>\n",
            view::label(status),
            escape::html(&check.message)
        ),
    }
}
