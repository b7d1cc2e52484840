//! Approximate minimum degree: Amestoy, Davis and Duff, An Approximate Minimum Degree Ordering Algorithm (1996).
//!
//! Eliminated nodes are elements of a quotient graph, each with the list of the nodes that it couples. Nodes with the same neighbours are
//! eliminated together, and stand for each other until then.

use std::cmp::Reverse;
use std::collections::BinaryHeap;

/// The choice among nodes of the same degree, of which one is eliminated first.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ties {
    /// The node whose degree was found last.
    Last,
    /// The node whose degree was found first.
    First,
}

/// The nodes in an order of approximately minimum degree, which keeps the [fill](super::blocks_of_factor) small, from the lists of each
/// node's neighbours.
pub fn minimum_degree(adjacency: Vec<Vec<u32>>, ties: Ties) -> Vec<u32> {
    let mut graph = QuotientGraph::new(adjacency);
    let mut left = graph.nodes.len();
    let found = graph.degree.iter().zip(0..).map(|(&degree, node)| (Reverse(degree), 0, node));
    let mut heap: BinaryHeap<(Reverse<usize>, i64, u32)> = found.collect();
    let mut time = 0;
    while let Some((Reverse(degree), _, node)) = heap.pop() {
        // Entries of nodes that are gone, or whose degree has changed, stay in the heap.
        if graph.weight[node as usize] == 0 || graph.degree[node as usize] != degree {
            continue;
        }
        left -= graph.weight[node as usize];
        for node in graph.eliminate(node, left) {
            time += match ties {
                Ties::Last => 1,
                Ties::First => -1,
            };
            heap.push((Reverse(graph.degree[node as usize]), time, node));
        }
    }
    graph.postorder()
}

struct QuotientGraph {
    /// Neighbours of each node that no element couples it with.
    nodes: Vec<Vec<u32>>,
    /// Elements of each node.
    elements: Vec<Vec<u32>>,
    /// Nodes of each element; an element has the number of the node that it was.
    of_element: Vec<Vec<u32>>,
    /// Upper bound of the number of neighbours of a node, without those that it stands for.
    degree: Vec<usize>,
    /// Number of nodes that a node stands for; 0 if it is gone.
    weight: Vec<usize>,
    /// The nodes that a node stands for, and itself.
    members: Vec<Vec<u32>>,
    /// The elements in the order of their elimination, each with the number of nodes that it couples, itself included.
    eliminated: Vec<(u32, usize)>,
    /// The later element that holds the nodes of each element.
    parent: Vec<Option<u32>>,
    /// The last number for which a node or an element was marked.
    mark: Vec<usize>,
    marks: usize,
    /// Number of the nodes of each marked element that are not in the newest one.
    outside: Vec<usize>,
}

impl QuotientGraph {
    fn new(adjacency: Vec<Vec<u32>>) -> Self {
        let nodes = adjacency.len();
        let without_itself = |(node, list): (u32, Vec<u32>)| list.into_iter().filter(|&other| other != node).collect();
        let lists: Vec<Vec<u32>> = (0..).zip(adjacency).map(without_itself).collect();
        Self {
            degree: lists.iter().map(Vec::len).collect(),
            nodes: lists,
            elements: vec![Vec::new(); nodes],
            of_element: vec![Vec::new(); nodes],
            weight: vec![1; nodes],
            members: (0..nodes as u32).map(|node| vec![node]).collect(),
            eliminated: Vec::new(),
            parent: vec![None; nodes],
            mark: vec![0; nodes],
            marks: 0,
            outside: vec![0; nodes],
        }
    }

    /// Eliminates a node, with those that it stands for, after which so many are left. Returns its former neighbours.
    fn eliminate(&mut self, pivot: u32, left: usize) -> Vec<u32> {
        let p = pivot as usize;
        let mut neighbours = self.neighbours(pivot);
        self.eliminated.push((pivot, self.degree[p] + self.weight[p]));
        self.weight[p] = 0;
        for element in std::mem::take(&mut self.elements[p]) {
            self.of_element[element as usize] = Vec::new();
            self.parent[element as usize] = Some(pivot);
        }
        self.nodes[p] = Vec::new();
        self.count_outside(&neighbours);
        let size: usize = neighbours.iter().map(|&node| self.weight[node as usize]).sum();
        let is_neighbour = self.next_mark(&neighbours);
        for &node in &neighbours {
            let i = node as usize;
            let Self { nodes, elements, mark, outside, weight, parent, .. } = self;
            // The new element couples it with all of its neighbours in that, and holds those elements that have no other node.
            nodes[i].retain(|&other| weight[other as usize] > 0 && mark[other as usize] != is_neighbour);
            elements[i].retain(|&e| {
                let is_within = outside[e as usize] == 0;
                if is_within {
                    parent[e as usize] = Some(pivot);
                }
                !is_within
            });
            let of_elements: usize = elements[i].iter().map(|&e| outside[e as usize]).sum();
            let of_nodes: usize = nodes[i].iter().map(|&other| weight[other as usize]).sum();
            let new = size - weight[i];
            elements[i].push(pivot);
            let others = left - weight[i];
            self.degree[i] = others.min(self.degree[i] + new).min(of_nodes + of_elements + new);
        }
        self.merge(&neighbours);
        neighbours.retain(|&node| self.weight[node as usize] > 0);
        self.of_element[p].clone_from(&neighbours);
        neighbours
    }

    /// The order of elimination, changed so that elements follow those that they hold, the largest of these last: the fill is the same, and
    /// more nodes with the same neighbours follow each other.
    fn postorder(mut self) -> Vec<u32> {
        let mut children: Vec<Vec<(usize, u32)>> = vec![Vec::new(); self.nodes.len()];
        let mut stack = Vec::new();
        for &(element, size) in &self.eliminated {
            match self.parent[element as usize] {
                Some(parent) => children[parent as usize].push((size, element)),
                None => stack.push(element),
            }
        }
        // A preorder backwards is a postorder.
        let mut order = Vec::with_capacity(self.nodes.len());
        while let Some(element) = stack.pop() {
            order.extend(self.members[element as usize].drain(..).rev());
            children[element as usize].sort_by_key(|&(size, _)| size);
            stack.extend(children[element as usize].iter().map(|&(_, child)| child));
        }
        order.reverse();
        order
    }

    /// The nodes that a node is coupled with.
    fn neighbours(&mut self, pivot: u32) -> Vec<u32> {
        let seen = self.next_mark(&[pivot]);
        let mut neighbours = Vec::new();
        let Self { nodes, elements, of_element, mark, weight, .. } = self;
        let of_elements = elements[pivot as usize].iter().flat_map(|&element| &of_element[element as usize]);
        for &node in nodes[pivot as usize].iter().chain(of_elements) {
            if weight[node as usize] > 0 && mark[node as usize] != seen {
                mark[node as usize] = seen;
                neighbours.push(node);
            }
        }
        neighbours
    }

    /// Counts the nodes of each element of these nodes that are not among them.
    fn count_outside(&mut self, nodes: &[u32]) {
        self.marks += 1;
        for &node in nodes {
            for &element in &self.elements[node as usize] {
                let e = element as usize;
                if self.mark[e] != self.marks {
                    self.mark[e] = self.marks;
                    self.outside[e] = self.of_element[e].iter().map(|&node| self.weight[node as usize]).sum();
                }
                self.outside[e] = self.outside[e].saturating_sub(self.weight[node as usize]);
            }
        }
    }

    /// Marks these nodes with a new number.
    fn next_mark(&mut self, nodes: &[u32]) -> usize {
        self.marks += 1;
        nodes.iter().for_each(|&node| self.mark[node as usize] = self.marks);
        self.marks
    }

    /// Lets one of these nodes stand for others that have the same neighbours.
    fn merge(&mut self, candidates: &[u32]) {
        let mut keys: Vec<(usize, u32)> = candidates.iter().map(|&node| (self.key(node), node)).collect();
        keys.sort_unstable();
        for same_key in keys.chunk_by(|a, b| a.0 == b.0) {
            for (place, &(_, node)) in same_key.iter().enumerate() {
                if self.weight[node as usize] == 0 {
                    continue;
                }
                for &(_, other) in &same_key[place + 1..] {
                    if self.weight[other as usize] > 0 && self.are_alike(node, other) {
                        self.absorb(node, other);
                    }
                }
            }
        }
    }

    /// A number that nodes with the same neighbours share.
    fn key(&self, node: u32) -> usize {
        let lists = self.nodes[node as usize].iter().chain(&self.elements[node as usize]);
        lists.map(|&other| other as usize).fold(0, usize::wrapping_add)
    }

    fn are_alike(&mut self, a: u32, b: u32) -> bool {
        let [lists_a, lists_b] = [a, b].map(|node| [&self.nodes[node as usize], &self.elements[node as usize]]);
        if lists_a.map(Vec::len) != lists_b.map(Vec::len) {
            return false;
        }
        self.marks += 1;
        lists_a.into_iter().flatten().for_each(|&other| self.mark[other as usize] = self.marks);
        lists_b.into_iter().flatten().all(|&other| self.mark[other as usize] == self.marks)
    }

    fn absorb(&mut self, node: u32, other: u32) {
        let (i, j) = (node as usize, other as usize);
        self.degree[i] -= self.weight[j].min(self.degree[i]);
        self.weight[i] += self.weight[j];
        self.weight[j] = 0;
        let mut members = std::mem::take(&mut self.members[j]);
        self.members[i].append(&mut members);
        self.nodes[j] = Vec::new();
        self.elements[j] = Vec::new();
    }
}
