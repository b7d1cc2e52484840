//! A thick cylinder in plane strain under internal pressure, with von Mises plasticity: Hill, The Mathematical Theory of Plasticity (1950),
//! chapter V.

use std::f64::consts::FRAC_PI_2;

use fem_mesh::SurfaceMesh;
use fem_model::simulation::Diagnostics;
use fem_model::{Axis, Body, BodyMesh, Integrator, Method, Motion, Plasticity, Selector};
use nalgebra::Vector3;

use crate::scenes::{displaced, material, simulator, step};
use crate::study::Result;

/// Inner and outer radius, m.
const INNER: f64 = 1.0;
const OUTER: f64 = 2.0;
/// Young's modulus and yield stress, Pa, and Poisson's ratio.
const YOUNG: f64 = 1e7;
const YIELD: f64 = 1e3;
const POISSON: f64 = 0.3;
/// Displacement of the inner wall at which no point yields, m.
pub const ELASTIC: f64 = 2e-5;

/// The limit load p = (2 σ_y/√3) ln(b/a), Pa.
pub fn limit() -> f64 {
    2.0 / 3f64.sqrt() * YIELD * (OUTER / INNER).ln()
}

/// The pressure at [`ELASTIC`] by Lamé, Pa: u(a) = p a (1 + ν)/E ((1 − 2ν) a² + b²)/(b² − a²).
pub fn elastic_pressure() -> f64 {
    let [a, b] = [INNER, OUTER].map(|radius| radius * radius);
    ELASTIC * YOUNG * (b - a) / (INNER * (1.0 + POISSON) * ((1.0 - 2.0 * POISSON) * a + b))
}

/// Pressure on the inside after each of `load_steps` equal steps of the inner wall's displacement, which is `distance` (m) at the end; Pa.
pub fn pressures(rings: usize, sectors: usize, distance: f64, load_steps: usize) -> Result<Vec<f64>> {
    let mesh = quarter(rings, sectors);
    let method = Method { load_steps, ..Method::new(Integrator::Static, 1.0) };
    let mut simulation = simulator(widened(&mesh, sectors, distance)?, &method)?;
    let mut pressure = || {
        step(&mut simulation)?;
        let outward = |(x, force): (&Vector3<f64>, [f64; 3])| x.normalize().dot(&Vector3::from(force));
        let forces = simulation.reactions().into_iter().map(|reaction| reaction.force);
        let sum: f64 = mesh.vertices.iter().zip(forces).take(sectors + 1).map(outward).sum();
        Ok(sum / (INNER * FRAC_PI_2))
    };
    (0..load_steps).map(|_| pressure()).collect()
}

/// A quarter of a ring of quadrilaterals, each of four triangles about its centre: these do not lock in isochoric flow, Nagtegaal,
/// Parks and Rice, On Numerically Accurate Finite Element Solutions in the Fully Plastic Range (1974).
fn quarter(rings: usize, sectors: usize) -> SurfaceMesh {
    let point = |ring: f64, sector: f64| {
        let r = INNER + (OUTER - INNER) * ring / rings as f64;
        let angle = FRAC_PI_2 * sector / sectors as f64;
        Vector3::new(r * angle.cos(), r * angle.sin(), 0.0)
    };
    let mut vertices: Vec<_> =
        (0..=rings).flat_map(|i| (0..=sectors).map(move |j| point(i as f64, j as f64))).collect();
    let mut triangles = Vec::new();
    for i in 0..rings {
        for j in 0..sectors {
            let node = |i: usize, j: usize| i * (sectors + 1) + j;
            let corners = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
            let centre = vertices.len();
            let sum: Vector3<f64> = corners.iter().map(|&corner| vertices[corner]).sum();
            vertices.push(sum / 4.0);
            triangles.extend((0..4).map(|k| [corners[k], corners[(k + 1) % 4], centre]));
        }
    }
    SurfaceMesh::new(vertices, triangles)
}

/// The ring whose inner nodes move outwards by `distance`, m.
fn widened(mesh: &SurfaceMesh, sectors: usize, distance: f64) -> Result<Body> {
    let mut body = Body::new(BodyMesh::flat(mesh.clone(), 1.0), material("hencky", YOUNG, POISSON, 1.0)?)?;
    body.plasticity = Some(Plasticity::J2 { yield_stress: YIELD, hardening: 0.0 });
    for (node, x) in mesh.vertices.iter().enumerate().take(sectors + 1) {
        let outwards = Motion::by((distance * x / INNER).into());
        body = body.prescribe(&Selector::Nodes(vec![node]), [true, true, false], outwards)?;
    }
    for axis in [Axis::X, Axis::Y] {
        let is_on_axis = |node: &usize| mesh.vertices[*node][axis as usize].abs() < 1e-12;
        let on_axis = (sectors + 1..mesh.vertices.len()).filter(is_on_axis).collect();
        body = displaced(body, &Selector::Nodes(on_axis), axis, 0.0)?;
    }
    Ok(body)
}
