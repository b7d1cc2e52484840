//! Improvement of a mesh of triangles that is given.

use std::collections::HashSet;

use nalgebra::Vector2;
use thiserror::Error;

use super::plane::{OdtStep, relax};
use crate::Mesh;
use crate::connectivity::sorted;
use crate::generate::outline::Outline;
use crate::generate::triangulation::{Triangulation, edge_opposite};
use crate::sets::combinations;

/// Times that the sizes of neighbours are averaged, so that they follow the grading of the mesh and not its single elements.
const AVERAGES: usize = 10;

/// A mesh of triangles after improvement, and how it became so.
#[derive(Clone, Debug, PartialEq)]
pub struct ImprovedTriangles {
    /// The mesh. Vertices keep their numbers, triangles do not; each set has the same region as before.
    pub mesh: Mesh<2, 3>,
    /// Measures before the first iteration and after each; the energy falls in each.
    pub steps: Vec<OdtStep>,
}

/// An edge of more than two triangles, or of two that are turned differently.
#[derive(Clone, Copy, Debug, Error, PartialEq, Eq)]
#[error(
    "the edge between vertices {} and {} (counted from 0) has more than two triangles, or two that are turned differently; remove or turn one", vertices[0], vertices[1]
)]
pub struct NotManifold {
    /// Ends of the edge.
    pub vertices: [usize; 2],
}

/// Improves a mesh of triangles that has passed the check, by up to `iterations` of optimal Delaunay triangulation. The grading of the mesh stays, as do
/// the polygons of its boundary, along whose straight runs vertices slide, the boundaries between different sets, and the edges and points that sets
/// name. No triangle is worse than the worst was before, in circumradius over shortest edge.
///
/// # Errors
/// An edge of more than two triangles.
///
/// ```
/// use fem_mesh::generate::odt::improve_triangles;
///
/// let corners = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0], [0.8, 0.3]].map(nalgebra::Vector2::from);
/// let mesh = fem_mesh::Mesh::new(corners.to_vec(), vec![[0, 1, 4], [1, 2, 4], [2, 3, 4], [3, 0, 4]]);
/// let improved = improve_triangles(&mesh, 20)?;
/// assert!((improved.mesh.vertices[4] - nalgebra::Vector2::repeat(0.5)).norm() < 0.01);
/// # Ok::<(), fem_mesh::generate::odt::NotManifold>(())
/// ```
pub fn improve_triangles(mesh: &Mesh<2, 3>, iterations: usize) -> Result<ImprovedTriangles, NotManifold> {
    let triangles = mesh.elements.iter().map(|element| element.map(|i| i as u32)).collect();
    let mut triangulation = Triangulation::new(mesh.vertices.clone(), triangles, &combinations(mesh).0)
        .map_err(|vertices| NotManifold { vertices })?;
    let kept: HashSet<[usize; 2]> = mesh.sets.values().flat_map(|set| set.edges.iter().copied()).collect();
    for triangle in 0..triangulation.triangles.len() {
        for i in 0..3 {
            let [a, b] = edge_opposite(triangulation.triangles[triangle], i).map(|vertex| vertex as usize);
            if kept.contains(&sorted([a, b])) {
                triangulation.constrained[triangle] |= 1 << i;
            }
        }
    }
    let mut outline = Outline::of(&triangulation);
    let points = mesh.sets.values().flat_map(|set| set.points.iter().chain(set.edges.iter().flatten()));
    points.for_each(|&vertex| outline.fix(vertex as u32));
    let sizes = sizes(&triangulation);
    let steps = if mesh.elements.is_empty() {
        Vec::new()
    } else {
        relax(&mut triangulation, &mut outline, |vertex, _: Vector2<f64>| sizes[vertex as usize], iterations, 0.0)
    };
    let mut improved = triangulation.into_mesh();
    improved.sets = mesh.sets.clone();
    Ok(ImprovedTriangles { mesh: improved, steps })
}

/// Length of the edges at each vertex, averaged with those of its neighbours.
fn sizes(triangulation: &Triangulation) -> Vec<f64> {
    let average = |value: &dyn Fn(usize, usize) -> f64| {
        let mut sums = vec![(0.0, 0.0); triangulation.points.len()];
        for corners in &triangulation.triangles {
            for i in 0..3 {
                let [a, b] = edge_opposite(*corners, i).map(|vertex| vertex as usize);
                for (at, other) in [(a, b), (b, a)] {
                    sums[at] = (sums[at].0 + value(at, other), sums[at].1 + 1.0);
                }
            }
        }
        sums.into_iter().map(|(sum, count)| if count > 0.0 { sum / count } else { 1.0 }).collect::<Vec<f64>>()
    };
    let mut sizes = average(&|a, b| (triangulation.points[a] - triangulation.points[b]).norm());
    for _ in 0..AVERAGES {
        sizes = average(&|a, b| 0.5 * (sizes[a] + sizes[b]));
    }
    sizes
}
