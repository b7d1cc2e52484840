//! Nodes and triangles on the sides of a mesh.

use approx::assert_relative_eq;
use fem_mesh::{Pattern, Side, area_vector, boundary, box_mesh, faces_on_side, nodes_on_side};
use nalgebra::Vector3;

#[test]
fn the_side_of_a_box_has_its_triangles_and_its_area() {
    let mesh = box_mesh([2.0, 1.0, 0.5], 2, Pattern::Alternating).unwrap();
    let faces = boundary(&mesh);
    for (axis, area, triangles) in [(0, 0.5, 2 * 2), (1, 1.0, 2 * 4), (2, 2.0, 2 * 8)] {
        for (side, sign) in [(Side::Min, -1.0), (Side::Max, 1.0)] {
            let found = faces_on_side(&mesh.vertices, &faces, axis, side, 1e-9);
            assert_eq!(found.len(), triangles);
            let sum: Vector3<f64> = found.iter().map(|face| area_vector(face.map(|i| mesh.vertices[i]))).sum();
            let mut expected = Vector3::zeros();
            expected[axis] = sign * area;
            assert_relative_eq!(sum, expected, epsilon = 1e-15);
        }
    }
}

#[test]
fn nodes_within_the_distance_belong_to_a_side_and_those_at_it() {
    let mesh = box_mesh([4.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    assert_eq!(nodes_on_side(&mesh.vertices, 0, Side::Max, 0.0), [4, 9, 14, 19]);
    assert_eq!(nodes_on_side(&mesh.vertices, 0, Side::Max, 1.0), [3, 4, 8, 9, 13, 14, 18, 19]);
    assert_eq!(nodes_on_side(&mesh.vertices, 0, Side::Min, 0.9), [0, 5, 10, 15]);
}
