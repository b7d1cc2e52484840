//! Boundaries.

use fem_mesh::{TetrahedralMesh, boundary};
use nalgebra::Vector3;

#[test]
fn the_faces_of_one_tetrahedron_look_outward() {
    let vertices = vec![Vector3::zeros(), Vector3::x(), Vector3::y(), Vector3::z()];
    let centre = Vector3::repeat(0.25);
    for face in boundary(&TetrahedralMesh::new(vertices.clone(), vec![[0, 1, 2, 3]])) {
        let [a, b, c] = face.map(|i| vertices[i]);
        assert!((b - a).cross(&(c - a)).dot(&(a - centre)) > 0.0, "{face:?}");
    }
}

#[test]
fn a_face_between_two_tetrahedra_is_not_on_the_boundary() {
    let mesh = TetrahedralMesh::new(vec![], vec![[0, 1, 2, 3], [0, 2, 1, 4]]);
    let faces = boundary(&mesh);
    assert_eq!(faces.len(), 6);
    assert!(faces.iter().all(|face| face.contains(&3) || face.contains(&4)));
}
