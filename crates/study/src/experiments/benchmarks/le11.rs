//! NAFEMS LE11: a solid of a cylinder, a cone and a sphere under an initial strain. The Standard NAFEMS Benchmarks (1990).

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};
use std::path::Path;

use fem_model::{Body, BodyMesh, Elastic, Law, Material, Selector};
use fem_output::stresses_at_nodes;
use nalgebra::Vector3;

use super::case::{Level, Mapped, Quantity, constrain, equilibrium, part};
use crate::study::Part;

const ELASTIC: Elastic = Elastic { young: 210e9, poisson: 0.3 };

/// The stress on the inner side of the sphere.
pub fn run(_: &Path, quick: bool) -> Result<Part, String> {
    let source = "NAFEMS; FeenoX −105.04e6, 27-node hexahedra −105.5e6";
    let of = Quantity { name: "σ_zz at (1, 0) (Pa)", reference: -105e6, tolerance: 2e-2, source };
    let text = "A quarter of the solid, E = 210 GPa, ν = 0.3, with an initial strain of 2.3e-4 (r + z) in all directions, no displacement across the planes at bottom and top. \
                The initial strain acts as the nodal forces ∫ Bᵀ C ε₀ dV, and its stress C ε₀ is taken from the one that is recovered by patches.";
    part(("le11", text), &[of], (&[1, 2, 3], 2), quick, solve)
}

/// A point of the profile: from 0 to 1 across and upwards. The sphere has two fifths of the height, the cone as much, the cylinder the rest.
fn profile(across: f64, up: f64) -> [f64; 2] {
    let line = |[a, b]: [[f64; 2]; 2], part: f64| [0, 1].map(|i| a[i] + part * (b[i] - a[i]));
    let (knee, waist) = ([FRAC_1_SQRT_2; 2], [1.2083, FRAC_1_SQRT_2]);
    let shoulder = [1.0, 1.3971];
    let (inner, outer) = if up <= 0.4 {
        let arc = |radius: f64, angle: f64| [radius * angle.cos(), radius * angle.sin()];
        let part = up / 0.4;
        (arc(1.0, 0.5 * FRAC_PI_2 * part), arc(1.4, (FRAC_1_SQRT_2 / 1.4).asin() * part))
    } else if up <= 0.8 {
        let part = (up - 0.4) / 0.4;
        (line([knee, [knee[0], shoulder[1]]], part), line([waist, shoulder], part))
    } else {
        let part = (up - 0.8) / 0.2;
        (line([[knee[0], shoulder[1]], [knee[0], 1.7971]], part), line([shoulder, [1.0, 1.7971]], part))
    };
    line([inner, outer], across)
}

fn solve(cells: usize) -> Result<Level, String> {
    let mapped = Mapped::cube([2 * cells, 4 * cells, 5 * cells], |place| {
        let [r, z] = profile(place.x, place.z);
        let (sin, cos) = (FRAC_PI_2 * place.y).sin_cos();
        // The cosine of a right angle is no zero.
        Vector3::new(if place.y == 1.0 { 0.0 } else { r * cos }, r * sin, z)
    })?;
    let node = mapped.node_at([0.0; 3]);
    let forces = forces(&mapped.mesh);
    let body = Body::new(mapped.mesh, Material::new(Law::Linear(ELASTIC), 7800.0));
    let body = body.map_err(|refusal| refusal.to_string())?;
    let body =
        constrain(body, &mapped.places, |place| [place.y == 1.0, place.y == 0.0, place.z == 0.0 || place.z == 1.0])?;
    let loaded = forces.iter().enumerate();
    let body = loaded.into_iter().try_fold(body, |body, (node, force)| {
        body.force(&Selector::Nodes(vec![node]), (*force).into()).map_err(|refusal| refusal.to_string())
    })?;
    let (simulation, seconds) = equilibrium(body, 1)?;
    let stress = stresses_at_nodes(&*simulation)[node][(2, 2)] - initial_stress(&Vector3::x());
    Ok(Level { nodes: mapped.places.len(), values: vec![stress], seconds })
}

/// C ε₀ = E/(1 − 2ν) · 2.3e-4 (r + z) in every direction, Pa.
fn initial_stress(x: &Vector3<f64>) -> f64 {
    ELASTIC.young / (1.0 - 2.0 * ELASTIC.poisson) * 2.3e-4 * (x.x.hypot(x.y) + x.z)
}

/// ∫ ∇N C ε₀ dV of each node, N.
fn forces(mesh: &BodyMesh) -> Vec<Vector3<f64>> {
    let mut forces = vec![Vector3::zeros(); mesh.vertices().len()];
    let points = mesh.element().points;
    for (element, volume) in mesh.volumes().into_iter().enumerate() {
        for (L, x) in points.iter().zip(mesh.points(element)) {
            let weight = initial_stress(&x) * volume / points.len() as f64;
            for &node in mesh.nodes_of(element) {
                let unit = |other: usize| Vector3::x() * f64::from(other == node);
                forces[node] += weight * mesh.displacement_gradient_at(element, L, unit).row(0).transpose();
            }
        }
    }
    forces
}
