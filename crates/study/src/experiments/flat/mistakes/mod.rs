//! Mistakes of the thesis, each with three figures: by the thesis' rule, ours, and the true one.

mod contact;
mod elasticity;
mod flow;
mod order;
mod triangles;

use std::path::Path;

use crate::experiments::mistake::{marks, table};
use crate::study::Part;

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
    let text = "The thesis' rules, programmed in a few lines each, beside this program. Two figures are not computed but printed in the thesis: the best R/l of 0.5 and the \
                order 4 of Verlet. The thesis does not say which norms it compares; the row of the cap takes the Frobenius norm for the yield and the spectral norm for the cap.";
    Ok(Part::new(text).marks(marks(&found)).tables([table("flat-mistakes", &found)]))
}
