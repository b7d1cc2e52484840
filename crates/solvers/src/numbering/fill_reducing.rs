//! The fill-reducing ordering: nested dissection, and minimum degree for small bodies.

use nalgebra::Vector3;

use super::bisection::Bisection;
use super::minimum_degree::{Ties, minimum_degree};

/// Up to this many nodes minimum degree is tried as well. For larger bodies, rows that are near in memory should belong to
/// nodes that are near in space.
const NODES_FOR_MINIMUM_DEGREE: usize = 4000;

/// Sets of nodes up to this size are not dissected further.
const LEAF: usize = 8;

/// The nodes in the order of nested dissection or, for small bodies, in one of minimum degree where its factor is cheaper. Ties decide a tenth of
/// the cost by accident, so two ways are tried.
pub(super) fn fill_reducing<const N: usize>(
    mut nodes: Vec<u32>,
    vertices: &[Vector3<f64>],
    elements: &[[usize; N]],
) -> Vec<u32> {
    let mut bisection = Bisection::new(vertices, elements);
    dissect(&mut nodes, &mut bisection);
    let adjacency = bisection.adjacency;
    if nodes.len() > NODES_FOR_MINIMUM_DEGREE {
        return nodes;
    }
    let mut position = vec![u32::MAX; vertices.len()];
    let mut least = factorisation_cost(&nodes, &adjacency, &mut position);
    let neighbours = |&node: &u32| {
        let positions = adjacency[node as usize].iter().map(|&other| position[other as usize]);
        positions.filter(|&position| position != u32::MAX).collect()
    };
    let graph: Vec<Vec<u32>> = nodes.iter().map(neighbours).collect();
    let dissected = nodes.clone();
    let orders = [Ties::Last, Ties::First].map(|ties| minimum_degree(graph.clone(), ties));
    for order in orders.map(|order| order.into_iter().map(|place| dissected[place as usize]).collect::<Vec<u32>>()) {
        let cost = factorisation_cost(&order, &adjacency, &mut position);
        if cost < least {
            (least, nodes) = (cost, order);
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

/// Multiplications of a Cholesky factorisation in this order, up to a constant: the sum of the squares of the column lengths.
fn factorisation_cost(nodes: &[u32], adjacency: &[Vec<u32>], position: &mut [u32]) -> f64 {
    set_positions(nodes, position);
    // A column holds its own neighbours below it, and the rows of its children in the elimination tree.
    let mut columns: Vec<Vec<u32>> = vec![Vec::new(); nodes.len()];
    let mut cost = 0.0;
    for (i, &node) in nodes.iter().enumerate() {
        let mut column = std::mem::take(&mut columns[i]);
        let below = adjacency[node as usize].iter().map(|&other| position[other as usize]);
        column.extend(below.filter(|&position| position != u32::MAX && position as usize > i));
        column.sort_unstable();
        column.dedup();
        cost += (column.len() as f64 + 1.0).powi(2);
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
