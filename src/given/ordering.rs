//! A fill-reducing order of elimination.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// Minimum degree order of a graph: `order[k]` is the node that is eliminated as the k-th.
///
/// `neighbours[i]` are the nodes that share an entry with node i, which may include i itself; the relation is
/// symmetric. Eliminating a node joins all of its remaining neighbours, which is the fill that the order keeps small.
/// The cliques that arise are kept as lists, never as edges, so memory stays that of the graph
/// (A. George and J. Liu, The evolution of the minimum degree ordering algorithm, SIAM Review 31, 1989, section 4).
pub(super) fn minimum_degree(neighbours: &[Vec<usize>]) -> Vec<usize> {
    let nodes = neighbours.len();
    let mut graph = QuotientGraph::new(neighbours);
    let mut queue: BinaryHeap<_> = (0..nodes).map(|node| Reverse((graph.degree(node), node))).collect();
    let mut order = Vec::with_capacity(nodes);
    while let Some(Reverse((degree, node))) = queue.pop() {
        // Degrees change; an entry that is out of date has been replaced by a later one.
        if graph.eliminated[node] || graph.current_degree[node] != degree {
            continue;
        }
        order.push(node);
        for changed in graph.eliminate(node) {
            queue.push(Reverse((graph.degree(changed), changed)));
        }
    }
    order
}

/// The graph after some eliminations: original edges, and the cliques that eliminations have created.
struct QuotientGraph {
    edges: Vec<Vec<usize>>,
    /// `memberships[i]` are the cliques that node i belongs to.
    memberships: Vec<Vec<usize>>,
    cliques: Vec<Vec<usize>>,
    eliminated: Vec<bool>,
    current_degree: Vec<usize>,
    /// `mark[i] == stamp` if the current traversal has visited node i.
    mark: Vec<usize>,
    stamp: usize,
}

impl QuotientGraph {
    fn new(neighbours: &[Vec<usize>]) -> Self {
        let nodes = neighbours.len();
        let without_self = |(node, list): (usize, &Vec<usize>)| list.iter().copied().filter(|&i| i != node).collect();
        Self {
            edges: neighbours.iter().enumerate().map(without_self).collect(),
            memberships: vec![Vec::new(); nodes],
            cliques: Vec::new(),
            eliminated: vec![false; nodes],
            current_degree: vec![0; nodes],
            mark: vec![0; nodes],
            stamp: 0,
        }
    }

    /// Nodes that share an edge or a clique with `node`, each once.
    fn reachable(&mut self, node: usize) -> Vec<usize> {
        self.stamp += 1;
        self.mark[node] = self.stamp;
        let mut found = Vec::new();
        let in_cliques = self.memberships[node].iter().flat_map(|&clique| &self.cliques[clique]);
        for &other in self.edges[node].iter().chain(in_cliques) {
            if !self.eliminated[other] && self.mark[other] != self.stamp {
                self.mark[other] = self.stamp;
                found.push(other);
            }
        }
        found
    }

    fn degree(&mut self, node: usize) -> usize {
        self.current_degree[node] = self.reachable(node).len();
        self.current_degree[node]
    }

    /// Eliminates `node` and joins its neighbours; returns them, since their degrees have changed.
    fn eliminate(&mut self, node: usize) -> Vec<usize> {
        let joined = self.reachable(node);
        self.eliminated[node] = true;
        let absorbed = std::mem::take(&mut self.memberships[node]);
        let clique = self.cliques.len();
        for &other in &joined {
            // The new clique contains these edges and cliques.
            self.memberships[other].retain(|old| !absorbed.contains(old));
            self.memberships[other].push(clique);
            self.edges[other].retain(|&end| self.mark[end] != self.stamp);
        }
        for old in absorbed {
            self.cliques[old] = Vec::new();
        }
        self.edges[node] = Vec::new();
        self.cliques.push(joined.clone());
        joined
    }
}
