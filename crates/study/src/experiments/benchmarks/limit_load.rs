//! The limit load of a thick cylinder in plane strain with von Mises plasticity: R. Hill, The Mathematical Theory of Plasticity (1950), chapter V.

use std::f64::consts::FRAC_PI_2;
use std::path::Path;
use std::time::Instant;

use fem_engine::simulator::Simulator;
use fem_mesh::SurfaceMesh;
use fem_model::simulation::Diagnostics;
use fem_model::{Body, BodyMesh, Elastic, Integrator, Law, Material, Method, Motion, Plasticity, Selector, Volumetric};
use nalgebra::Vector3;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use super::case::{Level, Quantity, part};
use crate::scenes::step;
use crate::study::{Mark, Part, Result};

/// Inner and outer radius, m.
const INNER: f64 = 1.0;
const OUTER: f64 = 2.0;
const ELASTIC: Elastic = Elastic { young: 1e8, poisson: 0.3 };
/// Pa
const YIELD: f64 = 1e3;
/// Displacement of the inner wall, ten times as large as where the outer wall begins to yield, m, and the steps up to it.
const DISTANCE: f64 = 4e-4;
const STEPS: usize = 20;

/// The pressure after the last step over the limit load.
pub fn run(_: &Path, quick: bool) -> Result<Part> {
    let limit = 2.0 / 3f64.sqrt() * YIELD * (OUTER / INNER).ln();
    let of = Quantity { name: "pressure (Pa)", reference: limit, tolerance: 1e-2, source: "(2 σ_y/√3) ln(b/a)" };
    let text = "A quarter of a cylinder with radii of 1 and 2 m in plane strain, Hencky's law, E = 100 MPa, ν = 0.3, σ_y = 1000 Pa, volumetric = \"averaged\", on an unstructured mesh: \
                places are shifted and diagonals chosen at random. So many quadratic triangles across the wall; the inner wall moves outwards, which gives the pressure by its work. Linear triangles \
                are 0.5 % above with 16 across.";
    let mut growth = f64::NAN;
    let found = part(("j2-cylinder", text), &[of], (&[4, 8, 16], 2), quick, |rings| {
        let (level, last) = solve(rings)?;
        growth = last;
        Ok(level)
    })?;
    let statement = "the last step, a twentieth of the displacement, adds less than 0.1 %";
    Ok(found.marks([Mark::new(statement, format!("{growth:.1e}"), growth.abs() < 1e-3)]))
}

/// The level, and the relative growth of the pressure in the last step.
fn solve(rings: usize) -> Result<(Level, f64)> {
    let sectors = 2 * rings;
    let mesh = BodyMesh::flat(quarter(rings, sectors), 1.0).of_order(2).ok_or("there is no such element")?;
    let x = mesh.vertices().to_vec();
    let edges: Vec<[usize; 2]> = (0..sectors).map(|j| [j * (rings + 1), (j + 1) * (rings + 1)]).collect();
    let inner = mesh.with_middles(edges.as_flattened().to_vec(), &edges, &[]);
    let material = Material { volumetric: Volumetric::Averaged, ..Material::new(Law::Hencky(ELASTIC), 1.0) };
    let mut body = Body::new(mesh, material)?;
    body.plasticity = Some(Plasticity::J2 { yield_stress: YIELD, hardening: 0.0 });
    let prescribe = |body: Body, nodes: Vec<usize>, components: [bool; 3], by: Vector3<f64>| {
        body.prescribe(&Selector::Nodes(nodes), components, Motion::by(by.into()))
    };
    for &node in &inner {
        body = prescribe(body, vec![node], [true, true, false], DISTANCE * x[node].normalize())?;
    }
    for axis in 0..2 {
        let on_axis = (0..x.len()).filter(|node| x[*node][axis] == 0.0 && !inner.contains(node)).collect();
        body = prescribe(body, on_axis, [axis == 0, axis == 1, false], Vector3::zeros())?;
    }
    let method = Method { load_steps: STEPS, ..Method::new(Integrator::Static, 1.0) };
    let mut simulation = Simulator::<f64>::new(body, &method)?;
    // A uniform pressure does the work p A on outward displacements of 1 m, which sweep the area A: corners have a sixth of an edge's load each.
    let swept: f64 = edges
        .iter()
        .map(|edge| {
            let [a, b] = edge.map(|node| x[node]);
            let (length, normal) = ((b - a).norm(), (a + b).normalize());
            length * (normal.dot(&a.normalize()) + 2.0) / 3.0
        })
        .sum();
    let start = Instant::now();
    let mut pressures = Vec::new();
    for _ in 0..STEPS {
        step(&mut simulation)?;
        let reactions = simulation.reactions();
        let work: f64 =
            inner.iter().zip(&reactions).map(|(&node, of)| x[node].normalize().dot(&Vector3::from(of.force))).sum();
        pressures.push(work / swept);
    }
    let [before, last] = [STEPS - 2, STEPS - 1].map(|step| pressures[step]);
    Ok((Level { nodes: x.len(), values: vec![last], seconds: start.elapsed().as_secs_f64() }, last / before - 1.0))
}

/// A quarter of the ring, whose inner vertices are shifted by up to a quarter of a cell, with diagonals at random.
fn quarter(rings: usize, sectors: usize) -> SurfaceMesh {
    let mut random = ChaCha8Rng::seed_from_u64(1);
    let mut vertices = Vec::new();
    for j in 0..=sectors {
        for i in 0..=rings {
            let mut shifted = |at: usize, of: usize| {
                let shift = if at == 0 || at == of { 0.0 } else { 0.25 * random.random_range(-1.0..1.0) };
                (at as f64 + shift) / of as f64
            };
            let (radius, angle) = (INNER + (OUTER - INNER) * shifted(i, rings), FRAC_PI_2 * shifted(j, sectors));
            // The cosine of a right angle is no zero.
            vertices.push(Vector3::new(
                if j == sectors { 0.0 } else { radius * angle.cos() },
                radius * angle.sin(),
                0.0,
            ));
        }
    }
    let node = |i: usize, j: usize| i + (rings + 1) * j;
    let mut triangles = Vec::new();
    for j in 0..sectors {
        for i in 0..rings {
            let [a, b, c, d] = [node(i, j), node(i + 1, j), node(i + 1, j + 1), node(i, j + 1)];
            let halves = if random.random_bool(0.5) { [[a, b, c], [a, c, d]] } else { [[a, b, d], [b, c, d]] };
            triangles.extend(halves);
        }
    }
    SurfaceMesh::new(vertices, triangles)
}
