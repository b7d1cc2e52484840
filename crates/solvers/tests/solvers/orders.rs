//! Orders of the nodes.

use fem_mesh::{Pattern, box_mesh};
use fem_solvers::numbering::{Numbering, Ordering, Ties, blocks_of_factor, minimum_degree};

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

#[test]
fn the_centre_of_a_star_comes_late_and_every_node_once() {
    let mut adjacency = vec![vec![0]; 10];
    adjacency[0] = (1..10).collect();
    for ties in [Ties::Last, Ties::First] {
        let mut ordering = minimum_degree(adjacency.clone(), ties);
        assert!(ordering[8..].contains(&0), "{ordering:?}");
        ordering.sort_unstable();
        assert!(ordering.into_iter().eq(0..10));
    }
}

/// Blocks of the factor of a matrix with these columns in each row.
fn blocks(rows: &[&[u32]]) -> usize {
    blocks_of_factor(rows.len(), |row| rows[row])
}

#[test]
fn the_factor_of_a_chain_has_no_fill() {
    assert_eq!(blocks(&[&[0, 1], &[0, 1, 2], &[1, 2, 3], &[2, 3]]), 7);
}

#[test]
fn the_factor_of_a_star_is_full_if_its_centre_comes_first_and_has_no_fill_if_it_comes_last() {
    assert_eq!(blocks(&[&[0, 1, 2, 3], &[0, 1], &[0, 2], &[0, 3]]), 10);
    assert_eq!(blocks(&[&[0, 3], &[1, 3], &[2, 3], &[0, 1, 2, 3]]), 7);
}

#[test]
fn the_factor_of_a_ring_couples_its_last_node_with_all_after_the_first() {
    assert_eq!(blocks(&[&[0, 1, 3], &[0, 1, 2], &[1, 2, 3], &[0, 2, 3]]), 9);
}
