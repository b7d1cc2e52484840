//! NAFEMS LE1: a quarter of an elliptic membrane under tension on its outer edge. The Standard NAFEMS Benchmarks (1990).

use std::path::Path;

use fem_model::{Body, Elastic, Law, Material, PlaneState, Selector};
use fem_output::stresses_at_nodes;

use super::case::{Level, Mapped, Quantity, constrain, equilibrium, part};
use crate::study::Part;

/// The stress at the end of the inner ellipse's long axis.
pub fn run(_: &Path, quick: bool) -> Result<Part, String> {
    let of = Quantity { name: "σ_yy at (2, 0) (Pa)", reference: 92.7e6, tolerance: 1e-2, source: "NAFEMS" };
    let text = "Plane stress, E = 210 GPa, ν = 0.3, between the ellipses with half axes of 2 and 1 m, 3.25 and 2.75 m, 10 MPa outwards on the outer edge. Stress recovered by patches.";
    part(("le1", text), &[of], (&[8, 16, 32], 2), quick, solve)
}

/// A point between the two ellipses: from 0 to 1 across, and along the quarter.
pub fn between_ellipses(across: f64, along: f64) -> [f64; 2] {
    let (sin, cos) = (along * std::f64::consts::FRAC_PI_2).sin_cos();
    [(2.0 + 1.25 * across) * cos, (1.0 + 1.75 * across) * sin]
}

fn solve(cells: usize) -> Result<Level, String> {
    let [nx, ny] = [cells, 2 * cells];
    let mapped = Mapped::square([nx, ny], |s, t| {
        let [x, y] = between_ellipses(s, t);
        // The cosine of a right angle is no zero.
        [if t == 1.0 { 0.0 } else { x }, y]
    })?;
    let (nodes, node) = (mapped.places.len(), mapped.node_at([0.0; 3]));
    let material =
        Material { plane: PlaneState::Stress, ..Material::new(Law::Linear(Elastic::new(210e9, 0.3)), 7800.0) };
    let body = Body::new(mapped.mesh, material).map_err(|refusal| refusal.to_string())?;
    let body = constrain(body, &mapped.places, |place| [place.y == 1.0, place.y == 0.0, false])?;
    let corner = |row: usize| nx + (nx + 1) * row;
    let outer = (0..ny).map(|row| [corner(row), corner(row + 1)]).collect();
    let body = body.pressure(&Selector::Edges(outer), -10e6).map_err(|refusal| refusal.to_string())?;
    let (simulation, seconds) = equilibrium(body, 1)?;
    Ok(Level { nodes, values: vec![stresses_at_nodes(&*simulation)[node][(1, 1)]], seconds })
}
