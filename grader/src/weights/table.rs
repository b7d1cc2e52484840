//! The table of `grader weights`.

use std::fmt::Write;

use grader::properties::{FUNCTIONS, sentence};

use super::{MOST_OF_ENDLESS, is_edge_case, shares};
use crate::own_checks;
use crate::reference::compare::Check;
use crate::reference::judge;
use crate::rubric::Rubric;

/// The checks of a function in the order of a grade.
pub fn checks_of(function: &str, rubric: &Rubric) -> Vec<&'static str> {
    let compared = judge::checks(function).into_iter().map(Check::name);
    let properties = FUNCTIONS.iter().find(|(name, _)| *name == function).map_or(&[][..], |(_, checks)| checks);
    let own = own_checks::of(function, rubric);
    compared.chain(properties.iter().chain(own).map(|check| check.name)).collect()
}

/// Each check of each function that a rubric asks for, with the share of the function's points that a failure costs.
pub fn table(rubric: &Rubric) -> String {
    let mut text = format!("{:<31} {:<82} {:>7} {:>7}\n", "function", "check that fails", "share", "points");
    for function in &rubric.functions {
        let name = function.name.get_ref().as_str();
        let apart = rubric.own_points(name);
        let points = *function.points.get_ref() - apart.iter().map(|(_, points)| points).sum::<f64>();
        let mut row = |check: &str, share: f64| {
            let _ = writeln!(text, "{name:<31} {check:<82} {:>5.1} % {:>7.2}", 100.0 * share, points * share);
        };
        let checks: Vec<_> =
            checks_of(name, rubric).into_iter().filter(|check| apart.iter().all(|(own, _)| own != check)).collect();
        let shares = shares(name, &checks, rubric.edge_cases);
        for (check, share) in checks.iter().zip(&shares) {
            let kind = if is_edge_case(name, check) { " (edge case)" } else { "" };
            let is_heart = *check == Check::Agrees.name() || !rubric.partial_credit;
            row(&format!("{}{kind}", sentence(check)), if is_heart { 1.0 } else { *share });
        }
        let edges = checks.iter().zip(&shares).filter(|(check, _)| is_edge_case(name, check));
        let edges: f64 = edges.map(|(_, share)| share).sum();
        if edges > 0.0 && rubric.partial_credit {
            row("all edge cases", edges);
        }
        row("no answer in time, in a check that is no edge case or in half of all: at least", 1.0 - MOST_OF_ENDLESS);
        for (check, points) in apart {
            let _ = writeln!(text, "{name:<31} {check:<82} {:>7} {points:>7.2}", "its own");
        }
    }
    text
}
