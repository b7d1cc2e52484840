//! NAFEMS LE1, LE10 and LE11: a quarter of an elliptic membrane under tension on its outer edge; a thick elliptic plate under pressure; a solid of
//! a cylinder, a cone and a sphere under an initial strain. The Standard NAFEMS Benchmarks (1990).

use std::f64::consts::{FRAC_1_SQRT_2, FRAC_PI_2};
use std::path::Path;

use fem_model::{Axis, Body, BodyMesh, Elastic, Law, Material, PlaneState, Selector};
use fem_output::stresses_at_nodes;
use nalgebra::Vector3;

use super::case::{Level, Mapped, Quantity, equilibrium, part, supported};
use crate::study::{Part, Result};

const ELASTIC: Elastic = Elastic { young: 210e9, poisson: 0.3 };

/// The stress at the end of the inner ellipse's long axis.
pub fn le1(_: &Path, quick: bool) -> Result<Part> {
    let of = Quantity { name: "σ_yy at (2, 0) (Pa)", reference: 92.7e6, tolerance: 1e-2, source: "NAFEMS" };
    let text = "Plane stress, E = 210 GPa, ν = 0.3, between the ellipses with half axes of 2 and 1 m, 3.25 and 2.75 m, 10 MPa outwards on the outer edge. Stress recovered by patches.";
    part(("le1", text), &[of], (&[8, 16, 32], 2), quick, membrane)
}

/// A point between the two ellipses: from 0 to 1 across, and along the quarter.
fn between_ellipses(across: f64, along: f64) -> [f64; 2] {
    let (sin, cos) = (along * FRAC_PI_2).sin_cos();
    [(2.0 + 1.25 * across) * cos, (1.0 + 1.75 * across) * sin]
}

fn membrane(cells: usize) -> Result<Level> {
    let [nx, ny] = [cells, 2 * cells];
    let mapped = Mapped::square([nx, ny], |s, t| {
        let [x, y] = between_ellipses(s, t);
        // The cosine of a right angle is no zero.
        [if t == 1.0 { 0.0 } else { x }, y]
    })?;
    let (nodes, node) = (mapped.places.len(), mapped.node_at([0.0; 3]));
    let material = Material { plane: PlaneState::Stress, ..Material::new(Law::Linear(ELASTIC), 7800.0) };
    let body = supported(mapped.mesh, material, &mapped.places, |place| [place.y == 1.0, place.y == 0.0, false])?;
    let corner = |row: usize| nx + (nx + 1) * row;
    let outer = (0..ny).map(|row| [corner(row), corner(row + 1)]).collect();
    let body = body.pressure(&Selector::Edges(outer), -10e6)?;
    let (simulation, seconds) = equilibrium(body, 1)?;
    Ok(Level { nodes, values: vec![stresses_at_nodes(&*simulation)[node][(1, 1)]], seconds })
}

/// The stress on the loaded face, at the end of the inner ellipse's long axis.
pub fn le10(_: &Path, quick: bool) -> Result<Part> {
    let of = Quantity { name: "σ_yy at (2, 0, 0.6) (Pa)", reference: -5.38e6, tolerance: 1e-2, source: "NAFEMS" };
    let text = "The quarter of LE1, 0.6 m thick, E = 210 GPa, ν = 0.3, 1 MPa on its upper face; the outer face is constrained in its plane, and along its middle line \
                across it, so that the deflection grows with the number of elements and the stress does not. Stress recovered by patches. It settles at \
                −5.42 MPa, as that of 27-node hexahedra does. Most cells lie along the quarter: the corners of a coarse polygon would raise the stress.";
    part(("le10", text), &[of], (&[1, 2, 3], 2), quick, plate)
}

fn plate(cells: usize) -> Result<Level> {
    let mapped = Mapped::cube([3 * cells, 12 * cells, 2 * cells], |place| {
        let [x, y] = between_ellipses(place.x, place.y);
        Vector3::new(if place.y == 1.0 { 0.0 } else { x }, y, 0.6 * place.z)
    })?;
    let (nodes, node) = (mapped.places.len(), mapped.node_at([0.0, 0.0, 1.0]));
    let material = Material::new(Law::Linear(ELASTIC), 7800.0);
    let body = supported(mapped.mesh, material, &mapped.places, |place| {
        let is_outer = place.x == 1.0;
        [is_outer || place.y == 1.0, is_outer || place.y == 0.0, is_outer && place.z == 0.5]
    })?;
    let body = body.traction(&Selector::most(Axis::Z), [0.0, 0.0, -1e6])?;
    let (simulation, seconds) = equilibrium(body, 1)?;
    Ok(Level { nodes, values: vec![stresses_at_nodes(&*simulation)[node][(1, 1)]], seconds })
}

/// The stress on the inner side of the sphere.
pub fn le11(_: &Path, quick: bool) -> Result<Part> {
    let source = "NAFEMS; FeenoX −105.04e6, 27-node hexahedra −105.5e6";
    let of = Quantity { name: "σ_zz at (1, 0) (Pa)", reference: -105e6, tolerance: 2e-2, source };
    let text = "A quarter of the solid, E = 210 GPa, ν = 0.3, with an initial strain of 2.3e-4 (r + z) in all directions, no displacement across the planes at bottom and top. \
                The initial strain acts as the nodal forces ∫ Bᵀ C ε₀ dV, and its stress C ε₀ is taken from the one that is recovered by patches.";
    part(("le11", text), &[of], (&[1, 2, 3], 2), quick, solid)
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

fn solid(cells: usize) -> Result<Level> {
    let mapped = Mapped::cube([2 * cells, 4 * cells, 5 * cells], |place| {
        let [r, z] = profile(place.x, place.z);
        let (sin, cos) = (FRAC_PI_2 * place.y).sin_cos();
        // The cosine of a right angle is no zero.
        Vector3::new(if place.y == 1.0 { 0.0 } else { r * cos }, r * sin, z)
    })?;
    let node = mapped.node_at([0.0; 3]);
    let forces = forces(&mapped.mesh);
    let body = supported(mapped.mesh, Material::new(Law::Linear(ELASTIC), 7800.0), &mapped.places, |place| {
        [place.y == 1.0, place.y == 0.0, place.z == 0.0 || place.z == 1.0]
    })?;
    let add = |body: Body, (node, force)| body.force(&Selector::Nodes(vec![node]), (force as Vector3<f64>).into());
    let body = forces.into_iter().enumerate().try_fold(body, add)?;
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
