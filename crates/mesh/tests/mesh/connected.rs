//! Parts of meshes, and nodes at one place.

use fem_mesh::{CoincidentNodes, Pattern, TetrahedralMesh, box_mesh, coincident_nodes};
use nalgebra::Vector3;

fn boxes(shift: f64) -> TetrahedralMesh {
    let mut mesh = box_mesh([2.0, 1.0, 1.0], 2, Pattern::Alternating).unwrap();
    let (nodes, elements) = (mesh.vertices.len(), mesh.elements.clone());
    let moved: Vec<_> = mesh.vertices.iter().map(|x| x + Vector3::new(2.0 + shift, 0.0, 0.0)).collect();
    mesh.vertices.extend(moved);
    mesh.elements.extend(elements.iter().map(|element| element.map(|node| node + nodes)));
    mesh
}

#[test]
fn two_boxes_are_two_parts_named_by_their_first_nodes() {
    let mesh = boxes(1.0);
    let parts = fem_mesh::parts(mesh.vertices.len(), &mesh.elements);
    assert_eq!(parts.len(), 90);
    assert!(parts[..45].iter().all(|&part| part == 0) && parts[45..].iter().all(|&part| part == 45));
}

#[test]
fn touching_boxes_have_coincident_nodes_and_separate_ones_do_not() {
    // Nodes 4, 9, … of the first box lie at x = 2, as do nodes 45, 50, … of the second.
    let found = CoincidentNodes { count: 9, first: [4, 45] };
    assert_eq!(coincident_nodes(&boxes(0.0).vertices), Some(found));
    assert_eq!(coincident_nodes(&boxes(1e-9).vertices), Some(found), "within 1e-9 of 4 m");
    assert_eq!(coincident_nodes(&boxes(1e-7).vertices), None);
    assert_eq!(coincident_nodes(&box_mesh([1.0, 1.0, 1.0], 20, Pattern::Alternating).unwrap().vertices), None);
}
