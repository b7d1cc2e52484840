//! Checks of selectors.

use fem_model::numbers::{check_positive, check_vector, problem};
use fem_model::{Refusal, Region, Selector};

/// Checks that a table has exactly one selector, and its numbers. `keys` lists those that it may have.
pub(super) fn check_one(table: &str, selectors: &[Selector], keys: &str) -> Result<(), Refusal> {
    match selectors {
        [selector] => check_selector(table, selector),
        _ => problem(table, format!("needs one of {keys}; give one and only one")),
    }
}

fn check_selector(table: &str, selector: &Selector) -> Result<(), Refusal> {
    let field = format!("{table}.{}", selector.key());
    match selector {
        Selector::Region(Region::All) | Selector::Set(_) => Ok(()),
        Selector::Region(Region::Side { within, .. }) => check_distance(&field, "within", *within),
        Selector::Region(Region::Plane { below, .. }) => check_distance(&field, "below", *below),
        Selector::Region(Region::Box { min, max }) => check_box(&field, min, max),
        Selector::Region(Region::Sphere { center, radius }) => {
            check_vector(&format!("{field}.center"), center)?;
            check_positive(&format!("{field}.radius"), *radius, " of metres")
        }
        Selector::Nodes(nodes) if nodes.is_empty() => problem(&field, "is empty; name a node, or remove the table"),
        Selector::Faces(faces) if faces.is_empty() => {
            problem(&field, "is empty; name a triangle of the boundary, or remove the table")
        }
        Selector::Edges(edges) if edges.is_empty() => {
            problem(&field, "is empty; name an edge of the outline, or remove the table")
        }
        Selector::Nodes(_) | Selector::Faces(_) | Selector::Edges(_) => Ok(()),
    }
}

fn check_box(field: &str, min: &[f64; 3], max: &[f64; 3]) -> Result<(), Refusal> {
    check_vector(&format!("{field}.min"), min)?;
    check_vector(&format!("{field}.max"), max)?;
    match (0..3).find(|&i| min[i] > max[i]) {
        Some(i) => {
            let axis = ["x", "y", "z"][i];
            problem(field, format!("has min above max along {axis}: {} > {}; swap them", min[i], max[i]))
        }
        None => Ok(()),
    }
}

/// Checks a distance in an inline table. Errors name the table, because its keys share a line.
fn check_distance(field: &str, key: &str, distance: f64) -> Result<(), Refusal> {
    if distance >= 0.0 && distance.is_finite() {
        return Ok(());
    }
    problem(field, format!("has {key} = {distance}; give a distance of 0 m or more"))
}
