//! NAFEMS LE10: a thick elliptic plate under pressure. The Standard NAFEMS Benchmarks (1990).

use std::path::Path;

use fem_model::{Axis, Body, Elastic, Law, Material, Selector};
use fem_output::stresses_at_nodes;
use nalgebra::Vector3;

use super::case::{Level, Mapped, Quantity, constrain, equilibrium, part};
use super::le1::between_ellipses;
use crate::study::Part;

/// The stress on the loaded face, at the end of the inner ellipse's long axis.
pub fn run(_: &Path, quick: bool) -> Result<Part, String> {
    let of = Quantity { name: "σ_yy at (2, 0, 0.6) (Pa)", reference: -5.38e6, tolerance: 1e-2, source: "NAFEMS" };
    let text = "The quarter of LE1, 0.6 m thick, E = 210 GPa, ν = 0.3, 1 MPa on its upper face; the outer face is constrained in its plane, and along its middle line \
                across it, so that the deflection grows with the number of elements and the stress does not. Stress recovered by patches. It settles at \
                −5.42 MPa, as that of 27-node hexahedra does. Most cells lie along the quarter: the corners of a coarse polygon would raise the stress.";
    part(("le10", text), &[of], (&[1, 2, 3], 2), quick, solve)
}

fn solve(cells: usize) -> Result<Level, String> {
    let mapped = Mapped::cube([3 * cells, 12 * cells, 2 * cells], |place| {
        let [x, y] = between_ellipses(place.x, place.y);
        Vector3::new(if place.y == 1.0 { 0.0 } else { x }, y, 0.6 * place.z)
    })?;
    let (nodes, node) = (mapped.places.len(), mapped.node_at([0.0, 0.0, 1.0]));
    let material = Material::new(Law::Linear(Elastic::new(210e9, 0.3)), 7800.0);
    let body = Body::new(mapped.mesh, material).map_err(|refusal| refusal.to_string())?;
    let body = constrain(body, &mapped.places, |place| {
        let is_outer = place.x == 1.0;
        [is_outer || place.y == 1.0, is_outer || place.y == 0.0, is_outer && place.z == 0.5]
    })?;
    let body = body.traction(&Selector::most(Axis::Z), [0.0, 0.0, -1e6]).map_err(|refusal| refusal.to_string())?;
    let (simulation, seconds) = equilibrium(body, 1)?;
    Ok(Level { nodes, values: vec![stresses_at_nodes(&*simulation)[node][(1, 1)]], seconds })
}
