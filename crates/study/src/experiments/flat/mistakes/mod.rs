//! The mistakes of the thesis, each with the figure that its rule leads to, ours, and the true one.

mod contact;
mod elasticity;
mod flow;
mod order;
mod triangles;

use std::path::Path;

use crate::experiments::{Mark, Part, Table};

/// A mistake.
struct Mistake {
    /// The rule of the thesis.
    rule: &'static str,
    /// The right rule.
    right: &'static str,
    /// The quantity that shows it, with its unit.
    quantity: String,
    /// Its value by the rule of the thesis, by this program, and in truth.
    theirs: f64,
    ours: f64,
    truth: f64,
    /// Largest error of ours.
    tolerance: f64,
}

impl Mistake {
    fn holds(&self) -> bool {
        (self.ours - self.truth).abs() <= self.tolerance
    }
}

/// Computes all of them.
pub fn run(data: &Path, quick: bool) -> Result<Part, String> {
    let mut found = vec![elasticity::thirds()?, triangles::best()];
    found.push(triangles::energy_factor(data)?);
    found.extend(contact::friction(quick)?);
    found.push(flow::creep()?);
    found.push(flow::cap());
    found.push(elasticity::first_vertex());
    found.push(contact::projection()?);
    found.push(triangles::slivers(data)?);
    found.push(order::verlet()?);
    let mark = |of: &Mistake| {
        let statement = format!("{}: {} is {} within {:.0e}", of.right, of.quantity, number(of.truth), of.tolerance);
        Mark::new(statement, number(of.ours), of.holds()).beside(number(of.theirs))
    };
    let row = |of: &Mistake| {
        let numbers = [of.theirs, of.ours, of.truth].map(number);
        [of.rule.to_owned(), of.right.to_owned(), of.quantity.clone()].into_iter().chain(numbers).collect()
    };
    Ok(Part {
        name: "mistakes",
        title: "Each mistake, with its figures",
        text: "The thesis' rules, programmed in a few lines each, beside this program. Two figures are not computed but printed in the thesis: the best R/l of 0.5 and the \
               order 4 of Verlet. The thesis does not say which norms it compares; the row of the cap takes the Frobenius norm for the yield and the spectral norm for the cap."
            .to_owned(),
        marks: found.iter().map(mark).collect(),
        tables: vec![Table {
            name: "flat-mistakes".to_owned(),
            head: vec!["rule of the thesis", "right", "quantity", ">thesis", ">here", ">truth"],
            rows: found.iter().map(row).collect(),
        }],
        figures: Vec::new(),
    })
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
