//! Approximate minimum degree, Amestoy, Davis and Duff, An Approximate Minimum Degree Ordering Algorithm (1996), by faer.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;

/// Nodes in an order in which a factor fills in little, from the other nodes that each shares an element with (ascending).
///
/// Nothing where the graph is too large for the numbers that count it.
pub fn amd_order(neighbours: &[Vec<u32>]) -> Option<Vec<u32>> {
    let nodes = neighbours.len();
    let mut starts = vec![0u32];
    let mut rows = Vec::with_capacity(neighbours.iter().map(Vec::len).sum());
    for list in neighbours {
        rows.extend(list);
        starts.push(u32::try_from(rows.len()).ok()?);
    }
    let graph = SymbolicSparseColMatRef::new_checked(nodes, nodes, &starts, None, &rows);
    let (mut order, mut place) = (vec![0; nodes], vec![0; nodes]);
    let mut memory = MemBuffer::new(amd::order_scratch::<u32>(nodes, rows.len()));
    amd::order(&mut order, &mut place, graph, amd::Control::default(), MemStack::new(&mut memory)).ok()?;
    Some(order)
}

#[cfg(test)]
mod tests {
    use super::amd_order;

    #[test]
    fn the_middle_of_a_star_comes_late_and_each_node_once() {
        let mut neighbours = vec![vec![0]; 10];
        neighbours[0] = (1..10).collect();
        let mut order = amd_order(&neighbours).unwrap();
        assert!(order[8..].contains(&0), "{order:?}");
        order.sort_unstable();
        assert!(order.into_iter().eq(0..10));
    }
}
