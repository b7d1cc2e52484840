//! Approximate minimum degree, by faer: Amestoy, Davis and Duff, An Approximate Minimum Degree Ordering Algorithm (1996).

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::SymbolicSparseColMatRef;
use faer::sparse::linalg::amd;

/// The nodes in a fill-reducing order, from the lists of each node's neighbours, which ascend. Returns `None` if the graph has
/// too many edges for 32-bit counts.
pub(super) fn minimum_degree(adjacency: &[Vec<u32>]) -> Option<Vec<u32>> {
    let nodes = adjacency.len();
    let mut starts = vec![0u32];
    let mut rows = Vec::with_capacity(adjacency.iter().map(Vec::len).sum());
    for list in adjacency {
        rows.extend(list);
        starts.push(u32::try_from(rows.len()).ok()?);
    }
    let graph = SymbolicSparseColMatRef::new_checked(nodes, nodes, &starts, None, &rows);
    let (mut ordering, mut inverse) = (vec![0; nodes], vec![0; nodes]);
    let mut memory = MemBuffer::new(amd::order_scratch::<u32>(nodes, rows.len()));
    amd::order(&mut ordering, &mut inverse, graph, amd::Control::default(), MemStack::new(&mut memory)).ok()?;
    Some(ordering)
}

#[cfg(test)]
mod tests {
    use super::minimum_degree;

    #[test]
    fn the_centre_of_a_star_comes_late_and_every_node_once() {
        let mut adjacency = vec![vec![0]; 10];
        adjacency[0] = (1..10).collect();
        let mut ordering = minimum_degree(&adjacency).unwrap();
        assert!(ordering[8..].contains(&0), "{ordering:?}");
        ordering.sort_unstable();
        assert!(ordering.into_iter().eq(0..10));
    }
}
