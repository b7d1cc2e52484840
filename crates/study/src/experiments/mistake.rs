//! Mistakes of a thesis, each with three figures: by the thesis' rule, ours, and the true one.

use crate::study::{Mark, Table};

/// A mistake.
pub struct Mistake {
    /// The rule of the thesis.
    pub rule: &'static str,
    /// The right rule.
    pub right: &'static str,
    /// The quantity that shows it, with its unit.
    pub quantity: String,
    /// Its value by the rule of the thesis.
    pub theirs: f64,
    /// Its value by this program.
    pub ours: f64,
    /// Its value in truth.
    pub truth: f64,
    /// Largest error of ours.
    pub tolerance: f64,
}

/// A mark for each mistake: ours is the truth within the tolerance.
pub fn marks(found: &[Mistake]) -> Vec<Mark> {
    let mark = |of: &Mistake| {
        let statement = format!("{}: {} is {} within {:.0e}", of.right, of.quantity, number(of.truth), of.tolerance);
        let holds = (of.ours - of.truth).abs() <= of.tolerance;
        Mark::new(statement, number(of.ours), holds).beside(number(of.theirs))
    };
    found.iter().map(mark).collect()
}

/// The table of all mistakes.
pub fn table(name: &str, found: &[Mistake]) -> Table {
    Table::of(
        name,
        found,
        &[
            ("rule of the thesis", &|of| of.rule.to_owned()),
            ("right", &|of| of.right.to_owned()),
            ("quantity", &|of| of.quantity.clone()),
            (">thesis", &|of| number(of.theirs)),
            (">here", &|of| number(of.ours)),
            (">truth", &|of| number(of.truth)),
        ],
    )
}

/// Six digits, as a decimal or with a power of ten.
fn number(x: f64) -> String {
    match x.abs() {
        0.0 => "0".to_owned(),
        size if (1e-3..1e5).contains(&size) => {
            let text = format!("{x:.6}");
            text.trim_end_matches('0').trim_end_matches('.').to_owned()
        }
        _ => format!("{x:.3e}"),
    }
}
