//! The surface of a mesh: the faces that belong to one element alone.

use super::TetrahedralMesh;
use super::buckets::Buckets;

/// Faces of a positive tetrahedron, each counter-clockwise seen from outside; face `i` lies opposite vertex `i`.
pub(crate) const FACES: [[usize; 3]; 4] = [[1, 2, 3], [0, 3, 2], [0, 1, 3], [0, 2, 1]];

/// Faces that belong to exactly one tetrahedron, counter-clockwise seen from outside.
///
/// Their order is that of the elements, and within an element that of the vertex opposite; each face starts with the
/// vertex that its element names first. Faces are sorted into buckets by their smallest vertex: O(m) time and 48 m bytes for m
/// elements. Indices have to be in range, as they are after [`check`](super::check).
pub fn boundary(mesh: &TetrahedralMesh) -> Vec<[usize; 3]> {
    let outer = outer_faces(mesh.elements.len(), |element| &mesh.elements[element], &FACES);
    outer.into_iter().map(|[element, face]| FACES[face].map(|corner| mesh.elements[element][corner])).collect()
}

/// The faces that belong to exactly one of `count` elements, each by the number of its element and its own in it, ascending. `nodes` are those
/// of an element, and `faces` the corners of its faces: three of a triangle, two of an edge.
pub fn outer_faces<'a, const K: usize>(
    count: usize,
    nodes: impl Fn(usize) -> &'a [usize],
    faces: &[[usize; K]],
) -> Vec<[usize; 2]> {
    let mut outside = Vec::new();
    for_each_face(count, nodes, faces, |numbers| {
        if let [face] = numbers {
            outside.push([face / faces.len(), face % faces.len()]);
        }
    });
    outside.sort_unstable();
    outside
}

/// Pairs of elements with a common face, each with the smaller index first.
pub(crate) fn neighbours(mesh: &TetrahedralMesh) -> Vec<[usize; 2]> {
    let mut pairs = Vec::with_capacity(2 * mesh.elements.len());
    for_each_face(
        mesh.elements.len(),
        |element| &mesh.elements[element],
        &FACES,
        |numbers| {
            if let [a, b] = numbers {
                pairs.push([a / 4, b / 4]);
            }
        },
    );
    pairs
}

/// Calls a function with the numbers of each face, ascending: once for every element that has it.
fn for_each_face<'a, const K: usize>(
    count: usize,
    nodes: impl Fn(usize) -> &'a [usize],
    faces: &[[usize; K]],
    mut call: impl FnMut(&[usize]),
) {
    let faces = (0..faces.len() * count).map(|face| {
        let nodes = nodes(face / faces.len());
        let mut key = faces[face % faces.len()].map(|corner| nodes[corner]);
        key.sort_unstable();
        // A mesh with more than 2³² nodes or faces fits into no memory.
        (key[0], [key[1] as u32, key[K - 1] as u32, face as u32])
    });
    let mut numbers = Vec::new();
    for faces in Buckets::new(faces).iter() {
        for equal in faces.chunk_by(|a, b| a[..2] == b[..2]) {
            numbers.clear();
            numbers.extend(equal.iter().map(|face| face[2] as usize));
            call(&numbers);
        }
    }
}
