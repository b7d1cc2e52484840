//! The structural cases of S. Turek and J. Hron, Proposal for Numerical Benchmarking of Fluid–Structure Interaction (2006): a beam of 0.35 × 0.02 m behind
//! a cylinder under its weight.

use std::path::Path;

use fem_model::{Body, Elastic, Law, Material};

use super::case::{Level, Mapped, Quantity, constrain, displacement, equilibrium, part};
use crate::study::Part;

const SOURCE: &str = "FeatFlow";

/// μ = 0.5 MPa.
pub fn csm1(_: &Path, quick: bool) -> Result<Part, String> {
    case("csm1", 0.5e6, [-7.1877e-3, -66.1029e-3], quick)
}

/// μ = 2 MPa.
pub fn csm2(_: &Path, quick: bool) -> Result<Part, String> {
    case("csm2", 2e6, [-0.46901e-3, -16.9740e-3], quick)
}

fn case(name: &str, shear: f64, [along, down]: [f64; 2], quick: bool) -> Result<Part, String> {
    let of = |name, reference| Quantity { name, reference, tolerance: 1e-3, source: SOURCE };
    let text = format!(
        "St. Venant–Kirchhoff, plane strain, μ = {shear:e} Pa, ν = 0.4, ρ = 1000 kg/m³, 2 m/s² downwards; the displacement of the middle of the free end."
    );
    part((name, &text), &[of("u_x (m)", along), of("u_y (m)", down)], (&[2, 4, 8], 3), quick, |cells| {
        solve(cells, shear)
    })
}

fn solve(cells: usize, shear: f64) -> Result<Level, String> {
    let mapped = Mapped::square([20 * cells, cells], |s, t| {
        let y = 0.19 + 0.02 * t;
        // The beam begins on the cylinder of radius 0.05 about (0.2, 0.2).
        let start = 0.2 + (0.05f64.powi(2) - (y - 0.2).powi(2)).sqrt();
        [start + s * (0.6 - start), y]
    })?;
    let (nodes, node) = (mapped.places.len(), mapped.node_at([1.0, 0.5, 0.0]));
    let material = Material::new(Law::StVenantKirchhoff(Elastic::new(2.8 * shear, 0.4)), 1000.0);
    let body = Body::new(mapped.mesh, material).map_err(|refusal| refusal.to_string())?;
    let body = constrain(body, &mapped.places, |place| [place.x == 0.0, place.x == 0.0, false])?;
    let body = body.gravity([0.0, -2.0, 0.0]).map_err(|refusal| refusal.to_string())?;
    let (simulation, seconds) = equilibrium(body, 4)?;
    let u = displacement(&*simulation, node);
    Ok(Level { nodes, values: vec![u.x, u.y], seconds })
}
