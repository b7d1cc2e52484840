//! Thick spheres and cylinders under inner pressure: Lamé's closed form, and the orders with which displacements and stresses come near it.

use std::path::Path;

use fem_chart::{Axis, Chart, Dot, Series};
use fem_mesh::{Pattern, SurfaceMesh, TetrahedralMesh, rectangle_mesh, signed_volume};
use fem_model::{BodyMesh, Elastic, Law, Material, Region, Selector};
use nalgebra::{Matrix3, Vector3};

use super::case::{equilibrium, supported};
use crate::study::{Mark, Part, Result, Table};
use fem_reference::space::norms;

/// Inner and outer radius, m; the pressure, Pa, small enough for its following the inner surface to be without effect.
const INNER: f64 = 1.0;
const OUTER: f64 = 2.0;
const PRESSURE: f64 = 1.0;
const ELASTIC: Elastic = Elastic { young: 1e9, poisson: 0.3 };

/// Orders of displacement and stress of linear and of quadratic elements with straight sides.
const EXPECTED: [[f64; 2]; 2] = [[2.0, 1.0], [2.0, 1.5]];

/// A thick wall of one of two shapes.
struct Wall {
    name: &'static str,
    /// Part of a mesh with so many cells across the wall, of linear elements.
    mesh: fn(usize) -> Result<BodyMesh>,
    /// Numbers of cells with linear and with quadratic elements, and how many of a short run.
    cells: [(&'static [usize], usize); 2],
    /// Radial displacement at a radius, m.
    displacement: fn(f64) -> f64,
    /// Radial, hoop and axial stress at a radius, Pa.
    stress: fn(f64) -> [f64; 3],
}

/// A solution on one mesh.
struct Level {
    cells: usize,
    nodes: usize,
    /// Relative errors of displacement and stress in L2.
    errors: [f64; 2],
    seconds: f64,
}

/// An eighth of a sphere.
pub fn sphere(_: &Path, quick: bool) -> Result<Part> {
    let wall = Wall {
        name: "lame-sphere",
        mesh: eighth,
        cells: [(&[4, 8, 16], 3), (&[2, 4, 8], 2)],
        displacement: |r| {
            let Elastic { young, poisson } = ELASTIC;
            PRESSURE / 7.0 / young * ((1.0 - 2.0 * poisson) * r + (1.0 + poisson) * 4.0 / (r * r))
        },
        stress: |r| {
            let hoop = PRESSURE / 7.0 * (1.0 + 4.0 / r.powi(3));
            [PRESSURE / 7.0 * (1.0 - 8.0 / r.powi(3)), hoop, hoop]
        },
    };
    compare(&wall, quick)
}

/// A quarter of a cylinder in plane strain.
pub fn cylinder(_: &Path, quick: bool) -> Result<Part> {
    let wall = Wall {
        name: "lame-cylinder",
        mesh: quarter,
        cells: [(&[8, 16, 32], 3), (&[4, 8, 16], 3)],
        displacement: |r| {
            let Elastic { young, poisson } = ELASTIC;
            PRESSURE / 3.0 / young * (1.0 + poisson) * ((1.0 - 2.0 * poisson) * r + 4.0 / r)
        },
        stress: |r| {
            let [radial, hoop] = [-4.0, 4.0].map(|factor| PRESSURE / 3.0 * (1.0 + factor / (r * r)));
            [radial, hoop, ELASTIC.poisson * (radial + hoop)]
        },
    };
    compare(&wall, quick)
}

/// Errors on sequences of meshes of linear and of quadratic elements, and their orders.
fn compare(wall: &Wall, quick: bool) -> Result<Part> {
    let (mut marks, mut rows) = (Vec::new(), Vec::new());
    let mut chart = Chart::new("relative errors in L2", Axis::log("nodes"), Axis::log("relative error"));
    for (order, name) in [(1, "linear"), (2, "quadratic")] {
        let (cells, short) = wall.cells[order - 1];
        let cells = if quick { &cells[..short] } else { cells };
        let levels = cells.iter().map(|&cells| solve(wall, cells, order)).collect::<Result<Vec<_>>>()?;
        let order_at = |at: usize, k: usize| {
            let [coarse, fine] = [&levels[at - 1], &levels[at]];
            (coarse.errors[k] / fine.errors[k]).ln() / (fine.cells as f64 / coarse.cells as f64).ln()
        };
        for (at, level) in levels.iter().enumerate() {
            let mut row = vec![name.to_owned(), level.cells.to_string(), level.nodes.to_string()];
            for (k, error) in level.errors.iter().enumerate() {
                row.push(format!("{error:.3e}"));
                row.push(if at == 0 { String::new() } else { format!("{:.2}", order_at(at, k)) });
            }
            row.push(format!("{:.1}", 1e3 * level.seconds));
            rows.push(row);
        }
        for (k, (value, expected)) in ["displacement", "stress"].into_iter().zip(EXPECTED[order - 1]).enumerate() {
            let (found, last) = (order_at(levels.len() - 1, k), &levels[levels.len() - 1]);
            let statement = format!("{name}: the {value} is of order {expected} or more, up to 0.1");
            let ours = format!("{found:.2}; error {:.2e} at {} nodes", last.errors[k], last.nodes);
            marks.push(Mark::new(statement, ours, found > expected - 0.1));
            let dot = |level: &Level| {
                let error = level.errors[k];
                Dot::new(level.nodes as f64, error, format!("{} nodes, error {error:.2e}", level.nodes))
            };
            chart.series.push(Series::joined(format!("{name}, {value}"), (k, order - 1), levels.iter().map(dot)));
        }
    }
    let head = "elements | >cells | >nodes | >displacement | >order | >stress | >order | >solution (ms)";
    let text = "Radii of 1 and 2 m, ν = 0.3; so many cells across the wall. Relative errors in L2, of stresses at the quadrature points. Elements with straight sides replace the \
                curved surfaces by polygons, which alone costs quadratic ones their third order of the displacement (G. Strang and G. J. Fix, An Analysis of the Finite Element \
                Method, 1973, chapter 4).";
    let table = Table::new(format!("benchmarks-{}", wall.name), head, rows);
    let caption = "Relative errors in L2 against Lamé's closed form.";
    Ok(Part::new(text).marks(marks).tables([table]).chart(format!("benchmarks-{}", wall.name), &chart, caption))
}

fn solve(wall: &Wall, cells: usize, order: usize) -> Result<Level> {
    let mesh = (wall.mesh)(cells)?.of_order(order).ok_or("there is no such element")?;
    let places = mesh.vertices().to_vec();
    let material = Material::new(Law::Linear(ELASTIC), 1.0);
    let is_solid = mesh.dimension() == 3;
    let body = supported(mesh.clone(), material, &places, |x| [x.x == 0.0, x.y == 0.0, is_solid && x.z == 0.0])?;
    let inside = Selector::Region(Region::Sphere { center: [0.0; 3], radius: INNER * (1.0 + 1e-9) });
    let body = body.pressure(&inside, PRESSURE)?;
    let (simulation, seconds) = equilibrium(body, 1)?;
    let radial = |x: &Vector3<f64>| -> [f64; 3] { ((wall.displacement)(x.norm()) * x.normalize()).into() };
    let exact: Vec<f64> = places.iter().flat_map(radial).collect();
    let found: Vec<f64> = simulation.positions().iter().zip(places.iter().flatten()).map(|(q, x)| q - x).collect();
    let weights = norms::weights(&mesh);
    let displacement = norms::l2(&weights, &found, &exact) / norms::l2(&weights, &exact, &vec![0.0; exact.len()]);
    let stresses = simulation.stresses_at_points();
    let (mut difference, mut norm) = (0.0, 0.0);
    let points = stresses.len() / mesh.elements();
    for (element, volume) in mesh.volumes().into_iter().enumerate() {
        for (x, found) in mesh.points(element).iter().zip(&stresses[points * element..]) {
            let exact = tensor((wall.stress)(x.norm()), x, is_solid);
            difference += volume * (found - exact).norm_squared();
            norm += volume * exact.norm_squared();
        }
    }
    Ok(Level { cells, nodes: places.len(), errors: [displacement, (difference / norm).sqrt()], seconds })
}

/// The stress at a point, of its radial, hoop and axial component.
fn tensor([radial, hoop, axial]: [f64; 3], x: &Vector3<f64>, is_solid: bool) -> Matrix3<f64> {
    let n = x.normalize();
    let axis = if is_solid { Matrix3::zeros() } else { Vector3::z() * Vector3::z().transpose() };
    n * n.transpose() * (radial - hoop) + Matrix3::identity() * hoop + axis * (axial - hoop)
}

/// A quarter of the ring between the radii, with twice as many cells along it as across.
fn quarter(cells: usize) -> Result<BodyMesh> {
    let size = [cells as f64, 2.0 * cells as f64];
    let mut mesh: SurfaceMesh = rectangle_mesh(size, 1, Pattern::Alternating)?;
    for x in &mut mesh.vertices {
        let radius = INNER + (OUTER - INNER) * x.x / size[0];
        let (sin, cos) = (x.y / size[1] * std::f64::consts::FRAC_PI_2).sin_cos();
        // The cosine of a right angle is no zero.
        *x = Vector3::new(if x.y == size[1] { 0.0 } else { radius * cos }, radius * sin, 0.0);
    }
    Ok(BodyMesh::flat(mesh, 1.0))
}

/// An eighth of the shell between the radii, of layers of prisms over the triangles of an octant; each prism is three tetrahedra.
fn eighth(cells: usize) -> Result<BodyMesh> {
    let along = 2 * cells;
    let row = |i: usize| i * (along + 1) - i * i.saturating_sub(1) / 2;
    let node = |[i, j]: [usize; 2]| row(i) + j;
    let mut places = Vec::new();
    let mut triangles = Vec::new();
    for i in 0..=along {
        for j in 0..=along - i {
            places.push(Vector3::new(i as f64, j as f64, (along - i - j) as f64).normalize());
            if i + j < along {
                triangles.push([[i, j], [i + 1, j], [i, j + 1]].map(node));
            }
            if i + j + 1 < along {
                triangles.push([[i + 1, j], [i + 1, j + 1], [i, j + 1]].map(node));
            }
        }
    }
    let of_layer = places.len();
    let radius = |layer: usize| INNER + (OUTER - INNER) * layer as f64 / cells as f64;
    let vertices: Vec<_> = (0..=cells).flat_map(|layer| places.iter().map(move |x| x * radius(layer))).collect();
    let mut elements = Vec::new();
    for layer in 0..cells {
        for mut corners in triangles.clone() {
            // Diagonals from the lower number below to the higher one above fit those of the neighbours.
            corners.sort_unstable();
            let [[a, b, c], [d, e, f]] = [layer, layer + 1].map(|layer| corners.map(|node| of_layer * layer + node));
            elements.extend([[a, b, c, f], [a, b, e, f], [a, d, e, f]]);
        }
    }
    for element in &mut elements {
        if signed_volume(element.map(|node| vertices[node])) < 0.0 {
            element.swap(2, 3);
        }
    }
    Ok(BodyMesh::solid(TetrahedralMesh::new(vertices, elements)))
}
