//! Bisection of a set of nodes by coordinates, with the separator between the halves.

use nalgebra::Vector3;

use super::extent;

/// The nodes' positions and neighbours, and workspace.
pub(super) struct Bisection<'a> {
    pub vertices: &'a [Vector3<f64>],
    /// The other nodes of each node's elements, ascending.
    pub adjacency: Vec<Vec<u32>>,
    side: Vec<Side>,
}

/// The half in which a node is.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Outside,
    Left,
    Right,
}

/// A set of nodes after a cut across its longest axis. No element joins the halves.
pub(super) struct Halves<'a> {
    pub left: &'a mut [u32],
    pub right: &'a mut [u32],
    pub separator: &'a mut [u32],
    pub axis: usize,
}

impl<'a> Bisection<'a> {
    pub fn new<const N: usize>(vertices: &'a [Vector3<f64>], elements: &[[usize; N]]) -> Self {
        Self { vertices, adjacency: adjacency(vertices.len(), elements), side: vec![Side::Outside; vertices.len()] }
    }

    /// Reorders the nodes: left half, right half, separator. Returns `None` if one half would hold all of them.
    pub fn cut<'b>(&mut self, nodes: &'b mut [u32]) -> Option<Halves<'b>> {
        let Self { vertices: x, adjacency, side } = self;
        let axis = extent(nodes, x).imax();
        let middle = nodes.len() / 2;
        // Ties are broken by number, so that the ordering depends on the mesh alone.
        nodes.select_nth_unstable_by(middle, |&a, &b| {
            x[a as usize][axis].total_cmp(&x[b as usize][axis]).then(a.cmp(&b))
        });
        for (place, &node) in nodes.iter().enumerate() {
            side[node as usize] = if place < middle { Side::Left } else { Side::Right };
        }
        let is_separator = |node: u32| {
            side[node as usize] == Side::Left
                && adjacency[node as usize].iter().any(|&other| side[other as usize] == Side::Right)
        };
        let rank = |node: u32| match (is_separator(node), side[node as usize]) {
            (true, _) => 2,
            (false, Side::Left) => 0,
            (false, _) => 1,
        };
        let mut ranked: Vec<(u8, u32)> = nodes.iter().map(|&node| (rank(node), node)).collect();
        ranked.sort_unstable();
        let left = ranked.iter().filter(|&&(rank, _)| rank == 0).count();
        let halves = ranked.iter().filter(|&&(rank, _)| rank < 2).count();
        for (place, &(_, node)) in nodes.iter_mut().zip(&ranked) {
            *place = node;
            side[node as usize] = Side::Outside;
        }
        let (left, rest) = nodes.split_at_mut(left);
        let (right, separator) = rest.split_at_mut(halves - left.len());
        (left.len().max(right.len()) < ranked.len()).then_some(Halves { left, right, separator, axis })
    }
}

/// The other nodes of each node's elements, ascending.
fn adjacency<const N: usize>(nodes: usize, elements: &[[usize; N]]) -> Vec<Vec<u32>> {
    let mut adjacency = vec![Vec::new(); nodes];
    for element in elements {
        for &node in element {
            adjacency[node].extend(element.iter().filter(|&&other| other != node).map(|&other| other as u32));
        }
    }
    for list in &mut adjacency {
        list.sort_unstable();
        list.dedup();
    }
    adjacency
}
