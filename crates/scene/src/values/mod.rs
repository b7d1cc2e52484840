//! The tables of a scene as values: SI units, the mesh's node numbers, defaults filled in.

mod batch;
mod constraints;
mod fibres;
mod initial;
mod loads;
mod materials;
mod method;
mod planes;
mod plasticity;
mod vectors;

use fem_model::Selector;

pub(crate) use constraints::dirichlet_conditions;
pub(crate) use fibres::fibres;
pub(crate) use initial::initial_velocity;
pub(crate) use loads::{curve, drag, faces_of_loads, nodal_forces, springs, surface_loads};
pub(crate) use materials::regions;
pub(crate) use method::damping;
pub(crate) use planes::contact;
pub(crate) use plasticity::plasticity;

/// The one selector of a checked table.
fn chosen(mut selectors: Vec<Selector>) -> Selector {
    match (selectors.pop(), selectors.pop()) {
        (Some(selector), None) => selector,
        _ => unreachable!("a table without exactly one selector is refused when the scene is read"),
    }
}
