//! Repairs of meshes: what belongs to no element is left out, elements are turned, elements without a size or that repeat others go.

use super::check::{is_inverted, problem_of_size, used_vertices};
use super::connectivity::sorted;
use super::sets::parts_of_elements;
use super::{Mesh, MeshSet, Problem, SurfaceMesh, area_vector};

/// Leaves out the nodes of no element, with those that sets name. Returns their number.
pub(crate) fn leave_out_unreferenced<const N: usize>(mesh: &mut Mesh<3, N>) -> usize {
    let is_used = used_vertices(mesh);
    let count = is_used.iter().filter(|is_used| !**is_used).count();
    if count == 0 {
        return 0;
    }
    let mut number = Vec::with_capacity(is_used.len());
    let mut next = 0;
    for &is_used in &is_used {
        number.push(next);
        next += usize::from(is_used);
    }
    let mut used = is_used.iter();
    mesh.vertices.retain(|_| *used.next().unwrap_or(&true));
    mesh.elements.iter_mut().flatten().for_each(|node| *node = number[*node]);
    for set in mesh.sets.values_mut() {
        set.points.retain(|&node| is_used[node]);
        set.points.iter_mut().for_each(|node| *node = number[*node]);
        set.faces.iter_mut().flatten().for_each(|node| *node = number[*node]);
        set.edges.iter_mut().flatten().for_each(|node| *node = number[*node]);
    }
    count
}

/// Leaves out the faces and edges of sets that belong to no element, the nodes that do not, and the sets that have nothing else.
/// Returns a line for each set that loses some.
pub(crate) fn leave_out_strays<const N: usize>(mesh: &mut Mesh<3, N>) -> Vec<String> {
    let mut lines = Vec::new();
    if mesh.sets.is_empty() {
        return lines;
    }
    let (faces, edges) = parts_of_elements(mesh);
    let is_used = used_vertices(mesh);
    let elements = mesh.elements.len();
    for (name, set) in &mut mesh.sets {
        let before = [set.elements.len(), set.faces.len(), set.edges.len(), set.points.len()];
        set.elements.retain(|&element| element < elements);
        set.faces.retain(|face| faces.get(face) == Some(&true));
        set.edges.retain(|edge| edges.get(edge) == Some(&true));
        set.points.retain(|&node| is_used.get(node) == Some(&true));
        let after = [set.elements.len(), set.faces.len(), set.edges.len(), set.points.len()];
        for ((before, after), what) in before.into_iter().zip(after).zip(["elements", "triangles", "edges", "nodes"]) {
            if after < before {
                lines.push(format!(
                    "set {name:?}: {} of its {before} {what} belong to no element and are left out",
                    before - after
                ));
            }
        }
    }
    mesh.sets.retain(|_, set| *set != MeshSet::default());
    lines
}

/// Turns all elements of a mesh of which none has a positive size and some a negative one. Returns their number.
///
/// Elements are tetrahedra, or triangles in the plane z = 0.
pub(crate) fn turn_if_all_inverted<const N: usize>(mesh: &mut Mesh<3, N>) -> Option<usize> {
    let mut has_inverted = false;
    for element in 0..mesh.elements.len() {
        let problem = problem_of_size(mesh, element);
        has_inverted |= is_inverted(&problem);
        problem.as_ref()?;
    }
    has_inverted.then(|| turn_inverted(mesh))
}

/// Turns the elements with a negative volume, or with a negative area in the plane z = 0, by swapping two of their nodes. Returns their
/// number.
pub fn turn_inverted<const N: usize>(mesh: &mut Mesh<3, N>) -> usize {
    let mut count = 0;
    for element in 0..mesh.elements.len() {
        if is_inverted(&problem_of_size(mesh, element)) {
            mesh.elements[element].swap(N - 2, N - 1);
            count += 1;
        }
    }
    count
}

/// Leaves out the elements that have a node twice or no size within rounding, and those that repeat the nodes of an earlier one. Returns
/// a line for each of the two kinds that occurs.
///
/// Around a flat element that goes, its neighbours may no longer share a face.
pub fn without_faulty_elements<const N: usize>(mesh: Mesh<3, N>) -> (Mesh<3, N>, Vec<String>) {
    let is_flat = |element: usize| {
        let nodes = mesh.elements[element];
        let is_repeated = (1..N).any(|k| nodes[..k].contains(&nodes[k]));
        is_repeated || matches!(problem_of_size(&mesh, element), Some(Problem::Flat { .. } | Problem::NoArea { .. }))
    };
    let flat: Vec<bool> = (0..mesh.elements.len()).map(is_flat).collect();
    without(mesh, &flat, sorted, "elements without a size")
}

/// A surface without the triangles that have no area, and those that repeat the corners of an earlier one in the same order. Returns a line
/// for each of the two kinds that occurs.
pub(crate) fn without_empty_triangles(mesh: SurfaceMesh) -> (SurfaceMesh, Vec<String>) {
    let is_empty = |&[a, b, c]: &[usize; 3]| {
        a == b || b == c || c == a || area_vector([a, b, c].map(|i| mesh.vertices[i])).amax() == 0.0
    };
    let empty: Vec<bool> = mesh.elements.iter().map(is_empty).collect();
    let from_least = |[a, b, c]: [usize; 3]| {
        if a < b && a < c {
            [a, b, c]
        } else if b < c {
            [b, c, a]
        } else {
            [c, a, b]
        }
    };
    without(mesh, &empty, from_least, "triangles without an area")
}

/// Leaves out the elements that are marked, and those whose key an earlier one has.
fn without<const N: usize>(
    mut mesh: Mesh<3, N>,
    is_out: &[bool],
    key: impl Fn([usize; N]) -> [usize; N],
    what: &str,
) -> (Mesh<3, N>, Vec<String>) {
    let mut keys: Vec<([usize; N], usize)> =
        mesh.elements.iter().enumerate().map(|(element, &nodes)| (key(nodes), element)).collect();
    keys.sort_unstable();
    let repeats = keys.chunk_by(|a, b| a.0 == b.0).flat_map(|equal| &equal[1..]).map(|(_, element)| *element);
    let mut is_repeat = vec![false; mesh.elements.len()];
    repeats.for_each(|element| is_repeat[element] = !is_out[element]);
    drop(keys);
    let counts = [is_out, &is_repeat[..]].map(|list| list.iter().filter(|is_out| **is_out).count());
    if counts == [0, 0] {
        return (mesh, Vec::new());
    }
    let mut next = 0;
    let number: Vec<Option<usize>> = std::iter::zip(is_out, &is_repeat)
        .map(|(&is_out, &is_repeat)| {
            next += usize::from(!is_out && !is_repeat);
            (!is_out && !is_repeat).then(|| next - 1)
        })
        .collect();
    let mut kept = number.iter().map(Option::is_some);
    mesh.elements.retain(|_| kept.next().unwrap_or(true));
    for set in mesh.sets.values_mut() {
        set.elements = set.elements.iter().filter_map(|&element| number[element]).collect();
    }
    let lines = [what, "elements that repeat an earlier one"].into_iter().zip(counts).filter(|(_, count)| *count > 0);
    (mesh, lines.map(|(what, count)| format!("{count} {what} are left out")).collect())
}
