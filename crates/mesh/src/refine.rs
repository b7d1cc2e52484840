//! Uniform refinement: every tetrahedron becomes eight.

use std::path::Path;

use nalgebra::Vector3;

use super::box_mesh::MOST_ELEMENTS;
use super::sets::EDGES;
use super::{MeshError, MeshSet, Problem, TetrahedralMesh};

/// The three diagonals of the inner octahedron: the two ends of each, then the other four edge midpoints around it, such that
/// `[end, end, ring[i], ring[i + 1]]` is positive. The numbers are indices of [`EDGES`].
const DIAGONALS: [([usize; 2], [usize; 4]); 3] =
    [([0, 5], [1, 2, 4, 3]), ([1, 4], [2, 0, 3, 5]), ([2, 3], [0, 1, 5, 4])];

/// Cuts every tetrahedron into eight at the midpoints of its edges, `times` times.
///
/// Four children are the corners, half as large in each direction. The octahedron between them is cut into four about its
/// shortest diagonal (S. Zhang, "Successive subdivisions of tetrahedra and multigrid methods on tetrahedral meshes", Houston
/// Journal of Mathematics 21, 1995). The first vertices are those of the coarse mesh; the children of element e are the
/// elements 8 e to 8 e + 7 and have an eighth of its volume each. Named sets keep their part of the body. The mesh must have passed [`check`](super::check).
///
/// Returns an error for more than 50 million elements.
pub fn refine(mesh: TetrahedralMesh, times: u32, source: &Path) -> Result<TetrahedralMesh, MeshError> {
    let elements = mesh.elements.len() as f64 * 8f64.powf(f64::from(times));
    if elements > MOST_ELEMENTS as f64 {
        return Err(MeshError::in_file(source, Problem::RefinedTooFine { times, elements, most: MOST_ELEMENTS }));
    }
    Ok((0..times).fold(mesh, |mesh, _| refine_once(&mesh)))
}

fn refine_once(mesh: &TetrahedralMesh) -> TetrahedralMesh {
    let edges = edges(mesh);
    let coarse = mesh.vertices.len();
    let midpoint = |[a, b]: &[usize; 2]| 0.5 * (mesh.vertices[*a] + mesh.vertices[*b]);
    let vertices: Vec<_> = mesh.vertices.iter().copied().chain(edges.iter().map(midpoint)).collect();
    let number = |edge: [usize; 2]| coarse + edges.binary_search(&edge).expect("every edge is in the list");
    let elements = mesh.elements.iter().flat_map(|element| {
        let midpoints = EDGES.map(|edge| number(sorted(edge.map(|corner| element[corner]))));
        children(element, midpoints, &vertices)
    });
    let elements = elements.collect();
    let refined = |set: &MeshSet| set.refined(|edge| number(sorted(edge)));
    let sets = mesh.sets.iter().map(|(name, set)| (name.clone(), refined(set))).collect();
    TetrahedralMesh { vertices, elements, sets }
}

/// Each edge once, its smaller vertex first, in ascending order.
fn edges(mesh: &TetrahedralMesh) -> Vec<[usize; 2]> {
    let all = mesh.elements.iter().flat_map(|element| EDGES.map(|edge| sorted(edge.map(|corner| element[corner]))));
    let mut edges: Vec<_> = all.collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

fn sorted([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

fn children(&[a, b, c, d]: &[usize; 4], m: [usize; 6], vertices: &[Vector3<f64>]) -> [[usize; 4]; 8] {
    let length = |diagonal: usize| {
        let [p, q] = DIAGONALS[diagonal].0.map(|end| vertices[m[end]]);
        (p - q).norm_squared()
    };
    // The first of equal diagonals, so that the mesh is the same on every machine.
    let shortest = (1..3).fold(0, |best, next| if length(next) < length(best) { next } else { best });
    let (ends, ring) = DIAGONALS[shortest];
    let inner = |i: usize| [m[ends[0]], m[ends[1]], m[ring[i]], m[ring[(i + 1) % 4]]];
    [
        [a, m[0], m[1], m[2]],
        [m[0], b, m[3], m[4]],
        [m[1], m[3], c, m[5]],
        [m[2], m[4], m[5], d],
        inner(0),
        inner(1),
        inner(2),
        inner(3),
    ]
}
