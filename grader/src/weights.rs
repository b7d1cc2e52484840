//! The cost of each kind of failure: the shares of a function's points that its checks have.
//!
//! A function that answers ordinary inputs wrongly earns nothing. If it answers them rightly, each check that it passes earns its share.
//! The shares are equal, but for edge cases, which together have at most [`Rubric::edge_cases`](crate::rubric::Rubric::edge_cases): a
//! mistake in an edge case fails several of these checks, and costs no more than that. A function that does not end in a check that is no
//! edge case, or in half of all checks, loses at least half of its points.

mod edge_cases;
mod table;
#[cfg(test)]
mod tests;

use crate::reference::compare::Check;
pub use table::table;

/// Largest share of its points that a function keeps if it does not end in a check that is no edge case, or in half of all checks.
pub const MOST_OF_ENDLESS: f64 = 0.5;

/// The share of a function's points that each of these checks has, if edge cases have at most this share together.
pub fn shares(function: &str, checks: &[&str], most: f64) -> Vec<f64> {
    let edges: Vec<bool> = checks.iter().map(|check| is_edge_case(function, check)).collect();
    let (all, of_edges) = (checks.len() as f64, edges.iter().filter(|is_edge| **is_edge).count() as f64);
    if of_edges == 0.0 || of_edges == all || of_edges <= most * all {
        return vec![1.0 / all; checks.len()];
    }
    let share = |is_edge: &bool| if *is_edge { most / of_edges } else { (1.0 - most) / (all - of_edges) };
    edges.iter().map(share).collect()
}

/// Returns true if a check holds a function to limiting cases alone, which most users of the function never meet.
pub fn is_edge_case(function: &str, check: &str) -> bool {
    let listed = edge_cases::EDGE_CASES.iter().find(|(whose, _)| *whose == function);
    check == Check::EdgeCases.name() || listed.is_some_and(|(_, names)| names.contains(&check))
}
