//! Cook's membrane: a tapered panel, 48 m long and 44 and 16 m high, clamped at its long side and loaded along its short one.

use std::path::Path;

use fem_model::{Axis, Elastic, Law, Material, NeoHookean, PlaneState, Selector, Volumetric};

use super::case::{Level, Mapped, Quantity, equilibrium, part, supported};
use crate::scenes::displacement;
use crate::study::{Part, Result};

/// Small strain, E = 1, ν = 1/3.
pub fn plane_stress(_: &Path, quick: bool) -> Result<Part> {
    let law = Law::Linear(Elastic::new(1.0, 1.0 / 3.0));
    let material = Material { plane: PlaneState::Stress, ..Material::new(law, 1.0) };
    let of = Quantity {
        name: "u_y at (48, 52) (m)",
        reference: 23.965,
        tolerance: 2e-3,
        source: "quadratic quadrilaterals, 64 × 64; 23.96 in the literature",
    };
    let text = "Linear law, plane stress, thickness 1, a shear of 1 in sum. R. D. Cook, Improved Two-Dimensional Finite Element (1974).";
    part(("cook", text), &[of], (&[4, 8, 16, 32], 3), quick, |cells| solve(cells, material, 1.0, 1, 0.5))
}

/// Small strain, E = 70, ν = 1/3.
pub fn plane_strain(_: &Path, quick: bool) -> Result<Part> {
    let material = Material::new(Law::Linear(Elastic::new(70.0, 1.0 / 3.0)), 1.0);
    let of = Quantity {
        name: "u_y at (48, 60) (m)",
        reference: 32.26,
        tolerance: 5e-3,
        source: "quadratic quadrilaterals, 64 × 64; CalculiX 32.27, Code_Aster 32.20, Elmer 32.28 (CoFEA)",
    };
    let text = "Linear law, plane strain, a load of 6.25 per length.";
    part(("cook-strain", text), &[of], (&[4, 8, 16, 32], 3), quick, |cells| solve(cells, material, 100.0, 1, 1.0))
}

/// Large strain, κ/μ = 5000, with the volume averaged over each element.
pub fn incompressible(_: &Path, quick: bool) -> Result<Part> {
    let law = Law::NeoHookean(NeoHookean::Moduli { C: 40.0969, D: 200_471.6 });
    let material = Material { volumetric: Volumetric::Averaged, ..Material::new(law, 1.0) };
    let of = Quantity {
        name: "u_y at (48, 60) (m)",
        reference: 6.93,
        tolerance: 1e-2,
        source: "mixed elements, extrapolated 6.931 and 6.935; 6.932 in FinEALE",
    };
    let text = "Neo-Hookean, plane strain, μ = 80.1938 and κ/μ = 5000, a dead load of 100 in eight steps, volumetric = \"averaged\". J. C. Simo and F. Armero, \
                Geometrically Non-linear Enhanced Strain Mixed Methods and the Method of Incompatible Modes (1992).";
    part(("cook-incompressible", text), &[of], (&[4, 8, 16, 32], 3), quick, |cells| {
        solve(cells, material, 100.0, 8, 1.0)
    })
}

/// The vertical displacement at a part of the height of the loaded side.
fn solve(cells: usize, material: Material, load: f64, load_steps: usize, height: f64) -> Result<Level> {
    let mapped = Mapped::square([cells; 2], |s, t| [48.0 * s, 44.0 * s + t * (44.0 - 28.0 * s)])?;
    let (nodes, node) = (mapped.places.len(), mapped.node_at([1.0, height, 0.0]));
    let body = supported(mapped.mesh, material, &mapped.places, |place| [place.x == 0.0, place.x == 0.0, false])?;
    let body = body.traction(&Selector::most(Axis::X), [0.0, load / 16.0, 0.0])?;
    let (simulation, seconds) = equilibrium(body, load_steps)?;
    Ok(Level { nodes, values: vec![displacement(&*simulation, node).y], seconds })
}
