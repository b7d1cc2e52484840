//! Optimal Delaunay triangulation from a plain start: scattered points, as in the thesis' figures 4.9 to 4.11.

use std::path::Path;

use fem_chart::{Picture, distribution, grid, region};
use fem_mesh::generate::delaunay::triangulate;
use fem_mesh::generate::odt::{OdtStep, improve_triangles};
use fem_mesh::{Mesh, SurfaceMesh, triangle_distributions};
use nalgebra::Vector2;
use rand::rngs::ChaCha8Rng;
use rand::{RngExt, SeedableRng};

use super::{ITERATIONS, THEIRS, boundary};
use crate::experiments::drawing::{CELL, Triangle, drawn};
use crate::experiments::flat::object::{meshed, picture};
use crate::study::{Figure, Mark};

/// Length of the edges, m, for a height of 1 m.
const EDGE: f64 = 0.06;
/// Twice the area of a triangle of the boundary's points alone, over the square of an edge, up to which it is flat.
const FLAT: f64 = 1e-6;

/// An object whose inner vertices were scattered at random.
pub struct Smoothed {
    name: &'static str,
    contours: Vec<Vec<Vector2<f64>>>,
    /// The Delaunay triangulation, and the mesh after the thesis' seven iterations.
    start: Mesh<2, 3>,
    seventh: Mesh<2, 3>,
    /// Measures of all iterations.
    pub steps: Vec<OdtStep>,
}

/// Triangulates an object's boundary and as many scattered points inside as its mesh has, and smooths the result.
pub fn smoothed(data: &Path, name: &'static str) -> Result<Smoothed, String> {
    let found = meshed(&picture(data, name)?, EDGE, 0)?;
    let start = scattered(&found.mesh, &found.contours)?;
    let improved = |iterations| improve_triangles(&start, iterations).map_err(|error| format!("{name}: {error}"));
    let (seventh, steps) = (improved(THEIRS)?.mesh, improved(ITERATIONS)?.steps);
    Ok(Smoothed { name, contours: found.contours, start, seventh, steps })
}

/// The Delaunay triangulation of a mesh's boundary and of as many points inside as the mesh has, scattered evenly.
fn scattered(mesh: &Mesh<2, 3>, contours: &[Vec<Vector2<f64>>]) -> Result<Mesh<2, 3>, String> {
    let edges = boundary(mesh);
    let mut points: Vec<Vector2<f64>> = edges.iter().map(|edge| edge[0]).collect();
    let largest = mesh.vertices.iter().fold(Vector2::zeros(), |a: Vector2<f64>, x| a.sup(x));
    let mut random = ChaCha8Rng::seed_from_u64(0);
    while points.len() < mesh.vertices.len() {
        let x = Vector2::new(random.random::<f64>() * largest.x, random.random::<f64>() * largest.y);
        // In no circle around an edge of the boundary, so that the triangulation has all of these edges.
        let is_free = edges.iter().all(|[a, b]| (x - 0.5 * (a + b)).norm() > 0.5 * (a - b).norm());
        if is_free && is_inside(x, contours) {
            points.push(x);
        }
    }
    let Mesh { vertices, mut elements, .. } = triangulate(&points).map_err(|error| error.to_string())?.mesh;
    elements.retain(|triangle| {
        let [a, b, c] = triangle.map(|i| vertices[i]);
        // Points on a straight part of the boundary have triangles without area.
        (b - a).perp(&(c - a)) > FLAT * EDGE * EDGE && is_inside((a + b + c) / 3.0, contours)
    });
    Ok(Mesh::new(vertices, elements))
}

/// Returns true if a horizontal ray from the point crosses the closed lines an odd number of times.
fn is_inside(x: Vector2<f64>, lines: &[Vec<Vector2<f64>>]) -> bool {
    let crosses = |a: Vector2<f64>, b: Vector2<f64>| {
        (a.y > x.y) != (b.y > x.y) && x.x < a.x + (x.y - a.y) / (b.y - a.y) * (b.x - a.x)
    };
    let of_line =
        |line: &Vec<Vector2<f64>>| (0..line.len()).filter(|&i| crosses(line[i], line[(i + 1) % line.len()])).count();
    lines.iter().map(of_line).sum::<usize>() % 2 == 1
}

impl Smoothed {
    /// Statements that must be true of it.
    pub fn marks(&self) -> [Mark; 2] {
        let (first, seventh) = (self.steps[0], self.steps[THEIRS.min(self.steps.len() - 1)]);
        let falls = self.steps.windows(2).all(|pair| pair[1].energy <= pair[0].energy * (1.0 + 1e-12));
        let kept = [&self.start, &self.seventh].map(|mesh| mesh.elements.len());
        [
            Mark::new(
                format!(
                    "{}, from scattered points: the energy falls in every iteration, and no triangle is left out",
                    self.name
                ),
                format!("{} and {} triangles", kept[0], kept[1]),
                falls && kept[0] == kept[1],
            ),
            Mark::new(
                format!("{}, from scattered points: the worst R/l falls in {THEIRS} iterations", self.name),
                format!(
                    "{:.2} → {:.2}, median {:.3} → {:.3}",
                    first.worst_radius_to_edge,
                    seventh.worst_radius_to_edge,
                    first.median_radius_to_edge,
                    seventh.median_radius_to_edge
                ),
                seventh.worst_radius_to_edge < first.worst_radius_to_edge,
            ),
        ]
    }

    /// The picture, the start and the seventh iteration, with histograms of R/l below.
    pub fn figure(&self) -> Result<Figure, String> {
        let lines: Vec<Vec<[f64; 2]>> =
            self.contours.iter().map(|line| line.iter().map(|x| (*x).into()).collect()).collect();
        let (mut parts, mut histograms) = (vec![region("the picture", &lines).scaled(CELL)], Vec::new());
        for (label, mesh) in [("Delaunay triangulation", &self.start), ("after 7 iterations", &self.seventh)] {
            let surface = SurfaceMesh::new(mesh.vertices.iter().map(|x| x.push(0.0)).collect(), mesh.elements.clone());
            let triangles: Vec<Triangle> =
                surface.elements.iter().map(|triangle| triangle.map(|i| surface.vertices[i].into())).collect();
            let origin = surface.vertices[0].into();
            parts.push(drawn(label, &triangles, [origin, origin])?);
            histograms.push(histogram(&format!("R/l: {label}"), &surface).scaled(CELL));
        }
        parts.push(grid("", 1, &histograms));
        let caption = format!(
            "{}: boundary points and scattered ones, smoothed from their plain Delaunay triangulation; R/l of its triangles.",
            self.name
        );
        Ok(Figure { name: format!("flat-mesh-{}", self.name), picture: grid(self.name, 2, &parts), caption })
    }
}

/// A histogram of circumradius over shortest edge. Every second end of a bin is written.
fn histogram(label: &str, mesh: &SurfaceMesh) -> Picture {
    let Some(ratios) = triangle_distributions(mesh).pop() else { return distribution(label, &[], &[]) };
    let counts = ratios.counts();
    let ends = (0..counts.len()).map(|bin| if bin % 2 == 1 { ratios.ends(bin)[0].clone() } else { String::new() });
    distribution(label, &ends.collect::<Vec<_>>(), &counts)
}
