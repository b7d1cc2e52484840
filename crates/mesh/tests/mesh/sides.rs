//! Nodes on the sides of a mesh.

use fem_mesh::{Pattern, Side, box_mesh, nodes_on_side};

#[test]
fn nodes_within_the_distance_belong_to_a_side_and_those_at_it() {
    let mesh = box_mesh([4.0, 1.0, 1.0], 1, Pattern::Alternating).unwrap();
    assert_eq!(nodes_on_side(&mesh.vertices, 0, Side::Max, 0.0), [4, 9, 14, 19]);
    assert_eq!(nodes_on_side(&mesh.vertices, 0, Side::Max, 1.0), [3, 4, 8, 9, 13, 14, 18, 19]);
    assert_eq!(nodes_on_side(&mesh.vertices, 0, Side::Min, 0.9), [0, 5, 10, 15]);
}
