//! The function to work on next, as a tutor would name it.

use super::report::{Cause, Report};
use super::roles::Role;
use crate::status::Status;
use crate::submission::NAMES;

/// The function to work on.
pub struct Next<'a> {
    /// Its name.
    pub name: &'static str,
    /// Its part in the assignment.
    pub role: Role,
    /// Its report; `None` if it is not among the reports.
    pub report: Option<&'a Report>,
    /// The functions that wait for it.
    pub waiting: Vec<&'static str>,
}

/// The function to work on next; `None` if all pass that the assignment asks for.
///
/// The function `about`, which has just been saved, comes first, or else what it waits for. Otherwise mistakes are mended before more is
/// written, and what written functions wait for is written before the others, in teaching order each. A function that waits is never next.
pub fn next<'a>(reports: &'a [Report], about: Option<&str>) -> Option<Next<'a>> {
    let saved: Vec<&Report> = reports.iter().filter(|report| is_open(report) && Some(report.name) == about).collect();
    let asked: Vec<&Report> = reports.iter().filter(|report| is_open(report) && report.role != Role::Later).collect();
    let not_written =
        || asked.iter().find(|report| report.waits_for.is_empty()).map(|report| (report.name, report.role));
    let (name, role) = first_to_mend(&saved).or_else(|| first_to_mend(&asked)).or_else(not_written)?;
    let waits = |report: &&Report| report.waits_for.iter().any(|cause| cause.name == name);
    Some(Next {
        name,
        role,
        report: reports.iter().find(|report| report.name == name),
        waiting: reports.iter().filter(waits).map(|report| report.name).collect(),
    })
}

fn is_open(report: &Report) -> bool {
    report.status != Status::Passed
}

/// The first of these functions that is written and has a mistake of its own, or else the first for which one of them waits.
fn first_to_mend(reports: &[&Report]) -> Option<(&'static str, Role)> {
    let has_mistake = |report: &&&Report| report.waits_for.is_empty() && report.status != Status::Missing;
    let mistake = reports.iter().find(has_mistake).map(|report| (report.name, report.role));
    let causes = reports.iter().flat_map(|report| &report.waits_for);
    // A wrong function comes before one that is not written.
    let order = |cause: &&Cause| (cause.status == Status::Missing, NAMES.iter().position(|name| *name == cause.name));
    mistake.or_else(|| causes.min_by_key(order).map(|cause| (cause.name, cause.role)))
}
