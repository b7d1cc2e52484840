//! The properties of a tetrahedral mesh that computations rely on.

use std::path::Path;

use nalgebra::Vector3;

use super::boundary::FACES;
use super::buckets::Buckets;
use super::{MeshError, Problem, TetrahedralMesh, area_vector, sets, signed_volume};

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

fn find_problem(mesh: &TetrahedralMesh) -> Result<(), Problem> {
    if mesh.vertices.is_empty() {
        return Err(Problem::Empty { what: "vertices" });
    }
    if mesh.elements.is_empty() {
        return Err(Problem::Empty { what: "tetrahedra" });
    }
    if let Some(vertex) = mesh.vertices.iter().position(|x| !x.iter().all(|coordinate| coordinate.is_finite())) {
        return Err(Problem::VertexNotFinite { vertex });
    }
    for (element, nodes) in mesh.elements.iter().enumerate() {
        check_indices(element, nodes, mesh.vertices.len())?;
        check_volume(element, nodes.map(|i| mesh.vertices[i]))?;
    }
    check_all_referenced(mesh)?;
    check_no_duplicates(mesh)?;
    sets::check(mesh)
}

fn check_indices(element: usize, nodes: &[usize; 4], count: usize) -> Result<(), Problem> {
    if let Some(&vertex) = nodes.iter().find(|&&i| i >= count) {
        return Err(Problem::ElementOutOfRange { element, vertex: vertex as i128, count });
    }
    match (1..4).find(|&k| nodes[..k].contains(&nodes[k])) {
        Some(k) => Err(Problem::RepeatedVertex { element, vertex: nodes[k] }),
        None => Ok(()),
    }
}

fn check_volume(element: usize, corners: [Vector3<f64>; 4]) -> Result<(), Problem> {
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
    if volume < 0.0 { Err(Problem::Inverted { element, volume }) } else { Ok(()) }
}

fn longest_edge(corners: [Vector3<f64>; 4]) -> f64 {
    let edges = (0..4).flat_map(|i| (0..i).map(move |j| (corners[i] - corners[j]).norm()));
    edges.fold(0.0, f64::max)
}

fn largest_face(corners: [Vector3<f64>; 4]) -> f64 {
    let areas = FACES.map(|face| area_vector(face.map(|i| corners[i])).norm());
    areas.into_iter().fold(0.0, f64::max)
}

fn check_no_duplicates(mesh: &TetrahedralMesh) -> Result<(), Problem> {
    let keys = mesh.elements.iter().enumerate().map(|(element, nodes)| {
        let mut nodes = *nodes;
        nodes.sort_unstable();
        // A mesh with more than 2³² nodes or elements fits into no memory.
        (nodes[0], [nodes[1] as u32, nodes[2] as u32, nodes[3] as u32, element as u32])
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

fn check_all_referenced(mesh: &TetrahedralMesh) -> Result<(), Problem> {
    let mut referenced = vec![false; mesh.vertices.len()];
    for &vertex in mesh.elements.iter().flatten() {
        referenced[vertex] = true;
    }
    match referenced.iter().position(|&known| !known) {
        Some(vertex) => Err(Problem::Unreferenced { vertex }),
        None => Ok(()),
    }
}
