//! The properties of a mesh that computations rely on.

use std::path::Path;

use nalgebra::Vector3;

use super::boundary::FACES;
use super::buckets::Buckets;
use super::{Mesh, MeshError, Problem, SurfaceMesh, TetrahedralMesh, area_vector, sets, signed_volume};

/// A tetrahedron is flat if its volume is below this fraction of its longest edge cubed.
///
/// The triple product has a round-off error of about 1e-15 of that cube, so a smaller volume has no reliable sign. A flat sliver of
/// aspect 1e6 has 2e-7 of it, a needle that is thin in both directions 2e-13.
const FLAT: f64 = 1e-14;

/// A tetrahedron is also flat if its smallest height is below this multiple of the round-off of its coordinates: far from the
/// origin, rounding moves the vertices of a flat tetrahedron out of their plane and gives them an apparent volume.
const ROUNDINGS: f64 = 4.0;

/// Checks that the mesh has an element, coordinates are finite, indices in range, the four vertices of every element different
/// and its volume positive, that no two elements have the same vertices, that every vertex belongs to an element, and that named sets are parts of the mesh.
///
/// Returns the first problem; `source` is the file that its message names.
pub fn check(mesh: &TetrahedralMesh, source: &Path) -> Result<(), MeshError> {
    find_problem(mesh).map_err(|problem| MeshError::in_file(source, problem))
}

/// Checks the triangles of a flat body: as [`check`] does tetrahedra, and that they lie in the plane z = 0, counter-clockwise seen from
/// positive z.
pub fn check_plane(mesh: &SurfaceMesh, source: &Path) -> Result<(), MeshError> {
    find_problem_in_plane(mesh).map_err(|problem| MeshError::in_file(source, problem))
}

fn find_problem_in_plane(mesh: &SurfaceMesh) -> Result<(), Problem> {
    check_contents(mesh, "triangles")?;
    if let Some(vertex) = mesh.vertices.iter().position(|x| x.z != 0.0) {
        return Err(Problem::OutOfPlane { vertex, z: mesh.vertices[vertex].z });
    }
    check_elements(mesh, check_area)
}

fn find_problem(mesh: &TetrahedralMesh) -> Result<(), Problem> {
    check_contents(mesh, "tetrahedra")?;
    check_elements(mesh, check_volume)
}

/// Checks the elements, each by the function of its number and corners, and what names them.
fn check_elements<const N: usize>(
    mesh: &Mesh<3, N>,
    check_size: fn(usize, [Vector3<f64>; N]) -> Result<(), Problem>,
) -> Result<(), Problem> {
    for (element, nodes) in mesh.elements.iter().enumerate() {
        check_indices(element, nodes, mesh.vertices.len())?;
        check_size(element, nodes.map(|i| mesh.vertices[i])).map_err(|problem| counted(problem, mesh))?;
    }
    if let Some(vertex) = used_vertices(mesh).iter().position(|&is_used| !is_used) {
        return Err(Problem::Unreferenced { vertex });
    }
    check_no_duplicates(mesh)?;
    sets::check(mesh)
}

/// The problem of the first inverted element with the number of all of them.
fn counted<const N: usize>(problem: Problem, mesh: &Mesh<3, N>) -> Problem {
    match problem {
        Problem::Inverted { element, volume, .. } => Problem::Inverted { element, volume, count: inverted(mesh) },
        Problem::Clockwise { element, area, .. } => Problem::Clockwise { element, area, count: inverted(mesh) },
        other => other,
    }
}

/// The number of inverted elements of a mesh, whose indices may be wrong behind the first.
fn inverted<const N: usize>(mesh: &Mesh<3, N>) -> usize {
    let count = mesh.vertices.len();
    if mesh.elements.iter().flatten().all(|&node| node < count) { count_inverted(mesh) } else { 1 }
}

pub(crate) fn check_area(element: usize, corners: [Vector3<f64>; 3]) -> Result<(), Problem> {
    let area = area_vector(corners).z;
    let edge = (0..3).map(|i| (corners[i] - corners[(i + 1) % 3]).norm()).fold(0.0, f64::max);
    if !(area.is_finite() && edge.powi(2).is_finite()) {
        return Err(Problem::Huge { element });
    }
    let extent = corners.iter().map(|x| x.amax()).fold(0.0, f64::max);
    let rounding = ROUNDINGS * f64::EPSILON * extent;
    if area.abs() <= FLAT * edge.powi(2) || 2.0 * area.abs() <= rounding * edge {
        return Err(Problem::NoArea { element, area });
    }
    if area < 0.0 { Err(Problem::Clockwise { element, area, count: 1 }) } else { Ok(()) }
}

fn check_contents<const N: usize>(mesh: &Mesh<3, N>, elements: &'static str) -> Result<(), Problem> {
    if mesh.vertices.is_empty() {
        return Err(Problem::Empty { what: "vertices" });
    }
    if mesh.elements.is_empty() {
        return Err(Problem::Empty { what: elements });
    }
    match mesh.vertices.iter().position(|x| !x.iter().all(|coordinate| coordinate.is_finite())) {
        Some(vertex) => Err(Problem::VertexNotFinite { vertex }),
        None => Ok(()),
    }
}

fn check_indices<const N: usize>(element: usize, nodes: &[usize; N], count: usize) -> Result<(), Problem> {
    if let Some(&vertex) = nodes.iter().find(|&&i| i >= count) {
        return Err(Problem::ElementOutOfRange { element, vertex: vertex as i128, count });
    }
    match (1..N).find(|&k| nodes[..k].contains(&nodes[k])) {
        Some(k) => Err(Problem::RepeatedVertex { element, vertex: nodes[k] }),
        None => Ok(()),
    }
}

pub(crate) fn check_volume(element: usize, corners: [Vector3<f64>; 4]) -> Result<(), Problem> {
    let volume = signed_volume(corners);
    let edge = longest_edge(corners);
    let area = largest_face(corners);
    if !(volume.is_finite() && edge.powi(3).is_finite() && area.is_finite()) {
        return Err(Problem::Huge { element });
    }
    let extent = corners.iter().map(|x| x.amax()).fold(0.0, f64::max);
    let rounding = ROUNDINGS * f64::EPSILON * extent;
    if volume.abs() <= FLAT * edge.powi(3) || 3.0 * volume.abs() <= rounding * area {
        return Err(Problem::Flat { element, volume });
    }
    if volume < 0.0 { Err(Problem::Inverted { element, volume, count: 1 }) } else { Ok(()) }
}

fn longest_edge(corners: [Vector3<f64>; 4]) -> f64 {
    let edges = (0..4).flat_map(|i| (0..i).map(move |j| (corners[i] - corners[j]).norm()));
    edges.fold(0.0, f64::max)
}

fn largest_face(corners: [Vector3<f64>; 4]) -> f64 {
    let areas = FACES.map(|face| area_vector(face.map(|i| corners[i])).norm());
    areas.into_iter().fold(0.0, f64::max)
}

fn check_no_duplicates<const N: usize>(mesh: &Mesh<3, N>) -> Result<(), Problem> {
    let keys = mesh.elements.iter().enumerate().map(|(element, nodes)| {
        let mut nodes = *nodes;
        nodes.sort_unstable();
        // A mesh with more than 2³² nodes or elements fits into no memory.
        (nodes[0], [nodes[1] as u32, nodes[2] as u32, nodes[N - 1] as u32, element as u32])
    });
    let (mut count, mut first) = (0, [usize::MAX; 2]);
    for keys in Buckets::new(keys).iter() {
        for pair in keys.windows(2).filter(|pair| pair[0][..3] == pair[1][..3]) {
            count += 1;
            first = first.min([pair[1][3] as usize, pair[0][3] as usize]);
        }
    }
    let [element, original] = first;
    if count == 0 { Ok(()) } else { Err(Problem::DuplicateElement { element, original, count }) }
}

/// True for each vertex that belongs to an element.
pub(crate) fn used_vertices<const N: usize>(mesh: &Mesh<3, N>) -> Vec<bool> {
    let mut is_used = vec![false; mesh.vertices.len()];
    mesh.elements.iter().flatten().for_each(|&vertex| is_used[vertex] = true);
    is_used
}

/// The problem of an element's volume, or of its area in the plane z = 0.
pub(crate) fn problem_of_size<const N: usize>(mesh: &Mesh<3, N>, element: usize) -> Option<Problem> {
    let corners = mesh.elements[element].map(|node| mesh.vertices[node]);
    let found = match corners[..] {
        [a, b, c, d] => check_volume(element, [a, b, c, d]),
        [a, b, c] => check_area(element, [a, b, c]),
        _ => Ok(()),
    };
    found.err()
}

pub(crate) fn is_inverted(problem: &Option<Problem>) -> bool {
    matches!(problem, Some(Problem::Inverted { .. } | Problem::Clockwise { .. }))
}

/// Number of the elements with a negative volume, or a negative area in the plane z = 0.
fn count_inverted<const N: usize>(mesh: &Mesh<3, N>) -> usize {
    (0..mesh.elements.len()).filter(|&element| is_inverted(&problem_of_size(mesh, element))).count()
}
