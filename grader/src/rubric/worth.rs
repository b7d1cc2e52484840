//! The points of a function, and the shares of its checks.

use super::Rubric;

/// The points of a function, and the rules by which its checks earn them.
pub struct Worth<'a> {
    /// All of its points.
    pub max_score: f64,
    /// A function that is right on ordinary inputs earns the shares of the checks that it passes.
    pub partial_credit: bool,
    /// Largest share of edge cases together.
    pub edge_cases: f64,
    /// Checks with points of their own.
    pub own: Vec<(&'a str, f64)>,
}

impl Rubric {
    /// The worth of a function with these points.
    pub fn worth(&self, name: &str, max_score: f64) -> Worth<'_> {
        let own = self.own_points(name);
        Worth { max_score, partial_credit: self.partial_credit, edge_cases: self.edge_cases, own }
    }
}
