//! The fill-reducing ordering: nested dissection, and minimum degree for small bodies.

use nalgebra::Vector3;

use super::bisection::Bisection;
use super::minimum_degree::minimum_degree;

/// Up to this many nodes minimum degree is tried as well. For larger bodies, rows that are near in memory should belong to
/// nodes that are near in space.
const NODES_FOR_MINIMUM_DEGREE: usize = 4000;

/// Sets of nodes up to this size are not dissected further.
const LEAF: usize = 8;

/// The nodes in the order of nested dissection or, for small bodies, in that of minimum degree where its factor is cheaper.
pub(super) fn fill_reducing<const N: usize>(
    mut nodes: Vec<u32>,
    vertices: &[Vector3<f64>],
    elements: &[[usize; N]],
) -> Vec<u32> {
    let mut bisection = Bisection::new(vertices, elements);
    dissect(&mut nodes, &mut bisection);
    let adjacency = bisection.adjacency;
    if nodes.len() <= NODES_FOR_MINIMUM_DEGREE {
        let mut position = vec![u32::MAX; vertices.len()];
        let by_degree = by_minimum_degree(&nodes, &adjacency, &mut position);
        let mut cost = |nodes: &[u32]| factorisation_cost(nodes, &adjacency, &mut position);
        if cost(&by_degree) < cost(&nodes) {
            return by_degree;
        }
    }
    nodes
}

/// Sets the position of each node in the list.
fn set_positions(nodes: &[u32], position: &mut [u32]) {
    for (i, &node) in nodes.iter().enumerate() {
        position[node as usize] = i as u32;
    }
}

/// These nodes in the order of minimum degree. Nodes that are not in the list have `position` [`u32::MAX`].
fn by_minimum_degree(nodes: &[u32], adjacency: &[Vec<u32>], position: &mut [u32]) -> Vec<u32> {
    set_positions(nodes, position);
    let neighbours = |&node: &u32| {
        let positions = adjacency[node as usize].iter().map(|&other| position[other as usize]);
        positions.filter(|&position| position != u32::MAX).collect()
    };
    let graph = nodes.iter().map(neighbours).collect();
    minimum_degree(graph).into_iter().map(|i| nodes[i as usize]).collect()
}

/// Multiplications of a Cholesky factorisation in this order, up to a constant: the sum of the squares of the column lengths.
fn factorisation_cost(nodes: &[u32], adjacency: &[Vec<u32>], position: &mut [u32]) -> usize {
    set_positions(nodes, position);
    // A column holds its own neighbours below it, and the rows of its children in the elimination tree.
    let mut columns: Vec<Vec<u32>> = vec![Vec::new(); nodes.len()];
    let mut cost = 0;
    for (i, &node) in nodes.iter().enumerate() {
        let mut column = std::mem::take(&mut columns[i]);
        let below = adjacency[node as usize].iter().map(|&other| position[other as usize]);
        column.extend(below.filter(|&position| position != u32::MAX && position as usize > i));
        column.sort_unstable();
        column.dedup();
        cost += (column.len() + 1).pow(2);
        if let Some((&parent, rest)) = column.split_first() {
            columns[parent as usize].extend(rest);
        }
    }
    cost
}

/// Nested dissection by coordinates: first the two halves, then the separator between them. George, Nested Dissection of a
/// Regular Finite Element Mesh (1973).
fn dissect(nodes: &mut [u32], bisection: &mut Bisection) {
    if nodes.len() <= LEAF {
        return;
    }
    // A half with all nodes would be divided in the same way again, in an endless recursion.
    if let Some(halves) = bisection.cut(nodes) {
        dissect(halves.left, bisection);
        dissect(halves.right, bisection);
    }
}
