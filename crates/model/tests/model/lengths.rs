//! Lengths of bodies.

use fem_mesh::{SurfaceMesh, TetrahedralMesh};
use fem_model::BodyMesh;
use nalgebra::{Rotation3, Vector3};

fn bar() -> TetrahedralMesh {
    fem_mesh::box_mesh([3.0, 1.0, 0.5], 2, fem_mesh::Pattern::Alternating).unwrap()
}

#[test]
fn a_box_is_as_long_as_its_longest_edge_wherever_it_points() {
    let length = BodyMesh::solid(bar()).length();
    assert!((length - 3.0).abs() < 1e-14, "{length}");
    let mut turned = bar();
    let turn = Rotation3::from_euler_angles(0.3, -0.7, 1.9);
    turned.vertices.iter_mut().for_each(|x| *x = turn * *x + Vector3::new(5.0, -2.0, 1.0));
    assert!((BodyMesh::solid(turned).length() - length).abs() < 1e-13);
}

#[test]
fn lengths_far_from_one_metre_keep_their_digits() {
    for scale in [1e-100, 1e100] {
        let corners = [[0.0, 0.0], [2.0, 0.0], [2.0, 1.0], [0.0, 1.0]];
        let vertices = corners.map(|[x, y]| scale * Vector3::new(x, y, 0.0)).to_vec();
        let length = BodyMesh::flat(SurfaceMesh::new(vertices, vec![[0, 1, 2], [0, 2, 3]]), 1.0).length();
        assert!((length / scale - 2.0).abs() < 1e-14, "{scale:e}: {length:e}");
    }
}
