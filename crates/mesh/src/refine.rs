//! Uniform refinement: every tetrahedron becomes eight, every triangle four.

use std::path::Path;

use nalgebra::Vector3;

use super::box_mesh::MOST_ELEMENTS;
use super::connectivity::{EDGES, edges, quarters, sorted};
use super::{Mesh, MeshError, MeshSet, Problem, SurfaceMesh, TetrahedralMesh};

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
    check_size(mesh.elements.len(), 8.0, times, source)?;
    Ok((0..times).fold(mesh, |mesh, _| refine_once(&mesh)))
}

/// Cuts every triangle of a flat body into four at the midpoints of its edges, `times` times: similar ones of half its size. Numbers and
/// sets are as for [`refine`]: the children of triangle t are the triangles 4 t to 4 t + 3.
pub fn refine_triangles(mesh: SurfaceMesh, times: u32, source: &Path) -> Result<SurfaceMesh, MeshError> {
    check_size(mesh.elements.len(), 4.0, times, source)?;
    Ok((0..times).fold(mesh, |mesh, _| {
        refined(&mesh, |&[a, b, c], midpoint, _| {
            quarters([a, b, c, midpoint([a, b]), midpoint([b, c]), midpoint([c, a])])
        })
    }))
}

/// Refuses a refined mesh of too many elements.
fn check_size(elements: usize, children: f64, times: u32, source: &Path) -> Result<(), MeshError> {
    let elements = elements as f64 * children.powf(f64::from(times));
    if elements > MOST_ELEMENTS as f64 {
        return Err(MeshError::in_file(source, Problem::RefinedTooFine { times, elements, most: MOST_ELEMENTS }));
    }
    Ok(())
}

fn refine_once(mesh: &TetrahedralMesh) -> TetrahedralMesh {
    refined(mesh, |element, midpoint, vertices| {
        children(element, EDGES.map(|edge| midpoint(edge.map(|corner| element[corner]))), vertices)
    })
}

/// The mesh with the midpoints of its edges as further vertices, and with `M` elements for each of its own: those that `cut` makes of
/// an element, the vertex at the midpoint of an edge, and all vertices.
fn refined<const N: usize, const M: usize>(
    mesh: &Mesh<3, N>,
    cut: impl Fn(&[usize; N], &dyn Fn([usize; 2]) -> usize, &[Vector3<f64>]) -> [[usize; N]; M],
) -> Mesh<3, N> {
    let edges = edges(&mesh.elements);
    let coarse = mesh.vertices.len();
    let midpoint = |[a, b]: &[usize; 2]| 0.5 * (mesh.vertices[*a] + mesh.vertices[*b]);
    let vertices: Vec<_> = mesh.vertices.iter().copied().chain(edges.iter().map(midpoint)).collect();
    let number = |edge: [usize; 2]| coarse + edges.binary_search(&sorted(edge)).expect("every edge is in the list");
    let elements = mesh.elements.iter().flat_map(|element| cut(element, &number, &vertices)).collect();
    let of_set = |set: &MeshSet| set.refined(M, number);
    let sets = mesh.sets.iter().map(|(name, set)| (name.clone(), of_set(set))).collect();
    Mesh { vertices, elements, sets }
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
