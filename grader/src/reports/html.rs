//! `report.html`: the student's report as a page.

use grader::status::Status;
use maud::{Markup, html};

use super::page::{figure, name, page};
use super::{escape, study, view};
use crate::grade::{CheckGrade, FunctionGrade, Grade};

/// The text of `report.html`.
pub fn render(grade: &Grade, show_diagnosis: bool) -> String {
    let body = html! {
        (head(grade))
        h2 { "Functions" }
        div class="row head" {
            span { "function" } span { "status" } span class="right" { "points" } span class="right" { "error" }
            span class="right" { "time (of reference)" }
        } "\n"
        @for part in view::parts(grade) { (function(part, grade.page_of(&part.name), show_diagnosis)) }
        @if grade.pages.is_none() {
            p class="soft" { "Pages are files of your repository: keep this file in its folder, and the links lead to them." } "\n"
        }
        p class="soft" { "Error: worst relative difference from the reference. Time: one call on a standard load." } "\n"
        @if let Some(found) = &grade.study { (study::render(grade, found)) }
    };
    page(&grade.submission, body)
}

fn head(grade: &Grade) -> Markup {
    let (passed, all) = view::passed(grade);
    let share = 100.0 * view::fraction(grade.score, grade.max_score);
    html! {
        h1 { (escape::line(&grade.submission)) }
        div class="figures" {
            (figure(&format!("{} / {}", view::points(grade.score), view::points(grade.max_score)), "points"))
            (figure(&format!("{passed} of {all}"), "functions pass"))
            (figure(&view::error(view::worst_error(grade)), "worst error"))
        } "\n"
        div class="meter" { i style=(format!("width:{share:.1}%")) {} } "\n"
        @if !grade.remarks.is_empty() {
            ul class="remarks" { @for remark in &grade.remarks { li { (escape::plain(remark)) } "\n" } }
        }
    }
}

fn function(part: &FunctionGrade, page: Option<String>, show_diagnosis: bool) -> Markup {
    html! {
        details open[view::has_notes(part)] { (summary(part)) "\n" (inside(part, page, show_diagnosis)) } "\n"
    }
}

fn summary(part: &FunctionGrade) -> Markup {
    let time = match part.seconds {
        Some(_) => format!("{} ({})", view::seconds(part.seconds), view::ratio(part)),
        None => "–".to_owned(),
    };
    html! {
        summary class="row" {
            span class="name" { (name(&part.name)) }
            span class={ "chip " (view::key(part.status)) } { (view::label(part.status)) }
            span class="right" { (view::points(part.score)) " / " (view::points(part.max_score)) }
            span class="right extra" { (view::error(part.error)) }
            span class="right extra" { (time) }
        }
    }
}

fn inside(part: &FunctionGrade, page: Option<String>, show_diagnosis: bool) -> Markup {
    html! {
        div class="inside" {
            @if let Some(page) = page { p class="soft page" { "Page: " a href=(page) { (page) } } }
            @for note in view::notes(part, show_diagnosis) {
                @let note = escape::plain(note.trim_end());
                // A compiler's message needs a font of constant width.
                @if note.contains('\n') { pre { (note) } } @else { p { (note) } }
            }
            @if !part.checks.is_empty() {
                ul class="checks" { @for one in &part.checks { (check(one)) "\n" } }
            }
        }
    }
}

fn check(check: &CheckGrade) -> Markup {
    let name = view::sentence(&check.name);
    html! {
        @if check.status == Status::Passed {
            li class="yes" { (name) }
        } @else {
            li class="no" { (name) " " span class="soft" { "(" (view::label(check.status)) ")" } p { (escape::plain(&check.message)) } }
        }
    }
}
