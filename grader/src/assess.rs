//! Computes the score of a submission from the results of its checks: the rubric's points, adjustments by hand, lateness. A change of any
//! of these needs no new grading.

mod adjustments;
mod metadata;
#[cfg(test)]
mod tests;

use grader::status::Status;
use jiff::Timestamp;

use crate::grade::{Account, CheckGrade, FunctionGrade, Grade};
use crate::reference::compare::Check;
use crate::rubric::{Rubric, Worth};
use crate::weights::{MOST_OF_ENDLESS, is_edge_case, shares};
pub use adjustments::{ADJUSTMENTS, Adjustments};
pub use metadata::Metadata;

/// The points of a function. If a check with points of its own fails, the function keeps the points of its other checks.
pub fn points(function: &str, worth: &Worth, (status, checks): (Status, &[CheckGrade])) -> f64 {
    if status == Status::Passed {
        return worth.max_score;
    }
    let points_of =
        |check: &CheckGrade| worth.own.iter().find(|(name, _)| *name == check.name).map(|(_, points)| *points);
    let (apart, others): (Vec<_>, Vec<_>) = checks.iter().partition(|check| points_of(check).is_some());
    let earned: f64 = apart.into_iter().filter(|check| check.status == Status::Passed).filter_map(points_of).sum();
    let rest = worth.max_score - worth.own.iter().map(|(_, points)| points).sum::<f64>();
    let points = rest * kept(function, worth, &others);
    // Exact if nothing is lost, and else no more than is earned.
    earned + if points == rest { rest } else { (points * 100.0 + ROUND_OFF).floor() / 100.0 }
}

/// Round-off of sums of shares, in hundredths of a point.
const ROUND_OFF: f64 = 1e-6;

/// The share of its points that a function keeps.
fn kept(function: &str, worth: &Worth, checks: &[&CheckGrade]) -> f64 {
    let passes = |check: &&CheckGrade| check.status == Status::Passed;
    if !checks.is_empty() && checks.iter().all(passes) {
        return 1.0;
    }
    let is_right_at_heart = checks.iter().any(|check| check.name == Check::Agrees.name() && passes(check));
    if !(worth.partial_credit && is_right_at_heart) {
        return 0.0;
    }
    let names: Vec<_> = checks.iter().map(|check| check.name.as_str()).collect();
    let shares = shares(function, &names, worth.edge_cases);
    let passed: f64 = checks.iter().zip(shares).filter(|(check, _)| passes(check)).map(|(_, share)| share).sum();
    let endless: Vec<_> = checks.iter().filter(|check| check.status == Status::TimedOut).collect();
    let is_ordinary = endless.iter().any(|check| !is_edge_case(function, &check.name));
    if is_ordinary || 2 * endless.len() >= checks.len() { passed.min(MOST_OF_ENDLESS) } else { passed }
}

/// The rules that turn the results of a graded submission into points.
#[derive(Clone, Debug)]
pub struct Accounts {
    rubric: Rubric,
    adjustments: Adjustments,
}

impl Accounts {
    /// The rubric's rules, with adjustments by hand.
    pub fn new(rubric: Rubric, adjustments: Adjustments) -> Self {
        Self { rubric, adjustments }
    }

    /// The rubric.
    pub fn rubric(&self) -> &Rubric {
        &self.rubric
    }

    /// Names in the table of adjustments that are not among the students.
    pub fn strangers(&self, students: &[&str]) -> Vec<String> {
        self.adjustments.strangers(students)
    }

    /// The grade that counts for a student, known by any of these names. Without a time, a submission is not late.
    pub fn assess(&self, mut grade: Grade, students: &[&str], submitted: Option<Timestamp>) -> Grade {
        self.recount(&mut grade);
        let raw_score = grade.score;
        let adjustments = self.adjustments.of(students);
        for adjustment in &adjustments {
            if let (Some(name), Some(points)) = (&adjustment.function, adjustment.points) {
                let parts = grade.functions.iter_mut().chain([&mut grade.simulation]);
                let change = parts.filter(|part| part.name == *name).map(|part| {
                    let change = points - part.score;
                    part.score = points;
                    change
                });
                grade.score += change.sum::<f64>();
                grade.remarks.push(format!("{name}: {} points, given by hand", crate::grade::points(points)));
            }
        }
        let deadline = self.rubric.deadline.as_ref();
        let late =
            deadline.zip(submitted).map(|(deadline, at)| deadline.lateness(&self.rubric.extensions, students, at));
        if let Some(late) = late.as_ref().filter(|late| late.days > 0) {
            let days = if late.days == 1 { "1 day".to_owned() } else { format!("{} days", late.days) };
            let before = crate::grade::points(grade.score);
            grade.score = (100.0 * grade.score * (1.0 - late.penalty)).round() / 100.0;
            let [share, after] = [100.0 * late.penalty, grade.score].map(crate::grade::points);
            grade.remarks.push(format!("{days} late: {before} points, less {share} %, are {after}"));
        }
        if let Some(points) = adjustments.iter().rfind(|one| one.function.is_none()).and_then(|whole| whole.points) {
            grade.score = points;
            grade.remarks.push(format!("{} points in all, given by hand", crate::grade::points(points)));
        }
        grade.remarks.extend(adjustments.iter().filter_map(|adjustment| adjustment.comment.clone()));
        grade.score = rounded(grade.score).clamp(0.0, grade.max_score);
        let student = students.first().map(|student| (*student).to_owned()).unwrap_or_default();
        grade.account = Some(Account { student, raw_score: rounded(raw_score), late, adjustments });
        grade
    }

    /// Updates points and hints from the present rubric.
    fn recount(&self, grade: &mut Grade) {
        let Rubric { growth_costs, students, functions, simulation, .. } = &self.rubric;
        let mut change = (0.0, 0.0);
        let mut count = |part: &mut FunctionGrade, max_score: f64| {
            let worth = self.rubric.worth(&part.name, max_score);
            let score = points(&part.name, &worth, (part.status, &part.checks)) * part.kept(*growth_costs);
            change = (change.0 + score - part.score, change.1 + max_score - part.max_score);
            (part.score, part.max_score) = (score, max_score);
        };
        for part in &mut grade.functions {
            if let Some(function) = functions.iter().find(|function| *function.name.get_ref() == part.name) {
                count(part, *function.points.get_ref());
                let is_shown = students.hints && part.status != Status::Passed;
                part.hint = function.hint.clone().filter(|_| is_shown);
            }
        }
        grade.pages.clone_from(&students.pages);
        if grade.simulation.name == "simulation" {
            count(&mut grade.simulation, simulation.points);
        }
        grade.score = rounded(grade.score + change.0);
        grade.max_score = rounded(grade.max_score + change.1);
    }
}

/// Points without the round-off of sums and shares.
fn rounded(points: f64) -> f64 {
    (points * 1e4).round() / 1e4
}
