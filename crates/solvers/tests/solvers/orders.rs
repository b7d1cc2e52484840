//! Orders of the nodes.

use fem_mesh::{Pattern, box_mesh};
use fem_solvers::numbering::{Numbering, Ordering};

#[test]
fn every_node_has_one_number_and_constrained_nodes_come_last() {
    let mesh = box_mesh([2.0, 1.0, 1.0], 3, Pattern::Alternating).unwrap();
    let constrained: Vec<bool> = mesh.vertices.iter().map(|x| x.x == 0.0).collect();
    let numbering = Numbering::new(Ordering::FillReducing, &mesh.vertices, &mesh.elements, &constrained);
    let mut all = numbering.mesh_node.clone();
    all.sort_unstable();
    assert!(all.iter().enumerate().all(|(i, &node)| i == node as usize));
    for (engine, &node) in numbering.mesh_node.iter().enumerate() {
        assert_eq!(numbering.engine_node[node as usize] as usize, engine);
        assert_eq!(constrained[node as usize], engine >= numbering.free);
    }
}

#[test]
fn nodes_are_sorted_along_the_longest_axis_first() {
    let mesh = box_mesh([1.0, 3.0, 2.0], 2, Pattern::Alternating).unwrap();
    let constrained = vec![false; mesh.vertices.len()];
    let numbering = Numbering::new(Ordering::Parts, &mesh.vertices, &mesh.elements, &constrained);
    let x = numbering.mesh_node.iter().map(|&node| mesh.vertices[node as usize]).collect::<Vec<_>>();
    assert!(x.windows(2).all(|x| (x[0].y, x[0].z, x[0].x) < (x[1].y, x[1].z, x[1].x)));
}

#[test]
fn dissection_ends_where_all_nodes_are_at_one_place() {
    let vertices = vec![nalgebra::Vector3::zeros(); 100];
    let elements: Vec<[usize; 4]> = (0..97).map(|i| [i, i + 1, i + 2, i + 3]).collect();
    assert_eq!(Numbering::new(Ordering::FillReducing, &vertices, &elements, &[false; 100]).mesh_node.len(), 100);
}
