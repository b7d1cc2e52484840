//! In which order the engine numbers nodes: free ones first, so that a factor fills in little; then those that are held.

use nalgebra::Vector3;

use crate::solvers::amd_order;

/// The engine's numbers of a mesh's nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbering {
    /// Number in the mesh of each of the engine's nodes.
    pub mesh_node: Vec<u32>,
    /// Number in the engine of each of the mesh's nodes.
    pub engine_node: Vec<u32>,
    /// The engine's nodes below this are free in at least one direction.
    pub free: usize,
}

/// Bodies of up to so many free nodes are tried with minimum degree too. Beyond, chunks of nodes should be close in space.
const SMALL: usize = 4000;

/// Sets of nodes up to this size are left as they are.
const LEAF: usize = 8;

/// What the order is to be good for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ordering {
    /// A factor: it fills in little.
    Dissected,
    /// Sweeps over the rows, and their neighbours in memory: from one end of the body to the other.
    Swept,
}

impl Numbering {
    /// Numbers the free nodes for a purpose, then the others. `held` says which nodes never move on their own.
    pub fn new<const N: usize>(
        numbering: Ordering,
        vertices: &[Vector3<f64>],
        elements: &[[usize; N]],
        held: &[bool],
    ) -> Self {
        let mut nodes: Vec<u32> = (0..vertices.len() as u32).filter(|&node| !held[node as usize]).collect();
        let free = nodes.len();
        match numbering {
            Ordering::Dissected => nodes = dissected(nodes, vertices, &neighbours(vertices.len(), elements)),
            Ordering::Swept => sweep(&mut nodes, vertices),
        }
        nodes.extend((0..vertices.len() as u32).filter(|&node| held[node as usize]));
        Self::from_nodes(nodes, free)
    }

    /// The order in which `mesh_node` lists the mesh's nodes.
    pub fn from_nodes(mesh_node: Vec<u32>, free: usize) -> Self {
        let mut engine_node = vec![0; mesh_node.len()];
        for (engine, &mesh) in mesh_node.iter().enumerate() {
            engine_node[mesh as usize] = engine as u32;
        }
        Self { mesh_node, engine_node, free }
    }

    /// Elements with the engine's numbers.
    pub fn elements<const N: usize>(&self, elements: &[[usize; N]]) -> Vec<[u32; N]> {
        elements.iter().map(|element| element.map(|node| self.engine_node[node])).collect()
    }

    /// Node values in the mesh's order, from those in the engine's.
    pub fn to_mesh<V: Copy>(&self, values: &[V]) -> Vec<V> {
        self.engine_node.iter().map(|&node| values[node as usize]).collect()
    }
}

/// Nested dissection of these nodes by coordinates, George, Nested Dissection of a Regular Finite Element Mesh (1973): halves
/// first, then the nodes between them; for small bodies minimum degree, where a factor is cheaper then.
fn dissected(mut nodes: Vec<u32>, vertices: &[Vector3<f64>], neighbours: &[Vec<u32>]) -> Vec<u32> {
    dissect(&mut nodes, vertices, neighbours, &mut vec![Side::Away; vertices.len()]);
    if nodes.len() <= SMALL
        && let Some(other) = minimum_degree(&nodes, neighbours)
        && work(&other, neighbours) < work(&nodes, neighbours)
    {
        return other;
    }
    nodes
}

/// Along the longest axis; where that leaves a tie along the next, and at last by number.
fn sweep(nodes: &mut [u32], vertices: &[Vector3<f64>]) {
    if nodes.is_empty() {
        return;
    }
    let extent = extent(nodes, vertices);
    let mut axes = [0, 1, 2];
    axes.sort_by(|&a, &b| extent[b].total_cmp(&extent[a]));
    nodes.sort_unstable_by(|&a, &b| {
        let (x, y) = (&vertices[a as usize], &vertices[b as usize]);
        let along = |axis: usize| x[axis].total_cmp(&y[axis]);
        along(axes[0]).then(along(axes[1])).then(along(axes[2])).then(a.cmp(&b))
    });
}

/// These nodes in the order of minimum degree.
fn minimum_degree(nodes: &[u32], neighbours: &[Vec<u32>]) -> Option<Vec<u32>> {
    let mut place = vec![u32::MAX; neighbours.len()];
    for (i, &node) in nodes.iter().enumerate() {
        place[node as usize] = i as u32;
    }
    let among = |node: &u32| {
        let places = neighbours[*node as usize].iter().map(|&other| place[other as usize]);
        let mut list: Vec<u32> = places.filter(|&place| place != u32::MAX).collect();
        list.sort_unstable();
        list
    };
    let graph: Vec<Vec<u32>> = nodes.iter().map(among).collect();
    Some(amd_order(&graph)?.into_iter().map(|i| nodes[i as usize]).collect())
}

/// Multiplications that a factor in this order takes, up to a constant: the sum of the squares of its columns' lengths.
fn work(nodes: &[u32], neighbours: &[Vec<u32>]) -> usize {
    let mut place = vec![u32::MAX; neighbours.len()];
    for (i, &node) in nodes.iter().enumerate() {
        place[node as usize] = i as u32;
    }
    // Each column is its own neighbours below it, and what its children hand on to it.
    let mut columns: Vec<Vec<u32>> = vec![Vec::new(); nodes.len()];
    let mut work = 0;
    for (i, &node) in nodes.iter().enumerate() {
        let mut column = std::mem::take(&mut columns[i]);
        let below = |place: u32| place != u32::MAX && place as usize > i;
        column
            .extend(neighbours[node as usize].iter().map(|&other| place[other as usize]).filter(|&place| below(place)));
        column.sort_unstable();
        column.dedup();
        work += (column.len() + 1).pow(2);
        if let Some((&parent, rest)) = column.split_first() {
            columns[parent as usize].extend(rest);
        }
    }
    work
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Side {
    Away,
    Left,
    Right,
}

fn neighbours<const N: usize>(nodes: usize, elements: &[[usize; N]]) -> Vec<Vec<u32>> {
    let mut neighbours = vec![Vec::new(); nodes];
    for element in elements {
        for &node in element {
            neighbours[node].extend(element.iter().filter(|&&other| other != node).map(|&other| other as u32));
        }
    }
    for list in &mut neighbours {
        list.sort_unstable();
        list.dedup();
    }
    neighbours
}

fn dissect(nodes: &mut [u32], x: &[Vector3<f64>], neighbours: &[Vec<u32>], side: &mut [Side]) {
    if nodes.len() <= LEAF {
        return;
    }
    let axis = longest_axis(nodes, x);
    let middle = nodes.len() / 2;
    // Ties are broken by number, so that the order depends on nothing but the mesh.
    nodes.select_nth_unstable_by(middle, |&a, &b| x[a as usize][axis].total_cmp(&x[b as usize][axis]).then(a.cmp(&b)));
    for (place, &node) in nodes.iter().enumerate() {
        side[node as usize] = if place < middle { Side::Left } else { Side::Right };
    }
    let between = |node: u32, side: &[Side]| {
        side[node as usize] == Side::Left
            && neighbours[node as usize].iter().any(|&other| side[other as usize] == Side::Right)
    };
    let rank = |node: u32, side: &[Side]| match (between(node, side), side[node as usize]) {
        (true, _) => 2,
        (false, Side::Left) => 0,
        (false, _) => 1,
    };
    let mut ranked: Vec<(u8, u32)> = nodes.iter().map(|&node| (rank(node, side), node)).collect();
    ranked.sort_unstable();
    let left = ranked.iter().filter(|&&(rank, _)| rank == 0).count();
    let halves = ranked.iter().filter(|&&(rank, _)| rank < 2).count();
    for (place, &(_, node)) in nodes.iter_mut().zip(&ranked) {
        *place = node;
        side[node as usize] = Side::Away;
    }
    let (first, rest) = nodes.split_at_mut(left);
    let (second, _) = rest.split_at_mut(halves - left);
    // A half that is everything would be cut the same way for ever.
    if first.len() < ranked.len() && second.len() < ranked.len() {
        dissect(first, x, neighbours, side);
        dissect(second, x, neighbours, side);
    }
}

fn longest_axis(nodes: &[u32], x: &[Vector3<f64>]) -> usize {
    extent(nodes, x).imax()
}

/// Edges of the box around these nodes, of which there is at least one.
fn extent(nodes: &[u32], x: &[Vector3<f64>]) -> Vector3<f64> {
    let first = x[nodes[0] as usize];
    let (least, most) = nodes
        .iter()
        .fold((first, first), |(least, most), &node| (least.inf(&x[node as usize]), most.sup(&x[node as usize])));
    most - least
}

#[cfg(test)]
mod tests {
    use super::{Numbering, Ordering};
    use fem_mesh::box_mesh;

    #[test]
    fn every_node_has_one_number_and_held_ones_come_last() {
        let mesh = box_mesh([2.0, 1.0, 1.0], 3).unwrap();
        let held: Vec<bool> = mesh.vertices.iter().map(|x| x.x == 0.0).collect();
        let order = Numbering::new(Ordering::Dissected, &mesh.vertices, &mesh.elements, &held);
        let mut all = order.mesh_node.clone();
        all.sort_unstable();
        assert!(all.iter().enumerate().all(|(i, &node)| i == node as usize));
        for (engine, &node) in order.mesh_node.iter().enumerate() {
            assert_eq!(order.engine_node[node as usize] as usize, engine);
            assert_eq!(held[node as usize], engine >= order.free);
        }
    }

    #[test]
    fn a_sweep_goes_along_the_longest_axis_first() {
        let mesh = box_mesh([1.0, 3.0, 2.0], 2).unwrap();
        let held = vec![false; mesh.vertices.len()];
        let order = Numbering::new(Ordering::Swept, &mesh.vertices, &mesh.elements, &held);
        let x = order.mesh_node.iter().map(|&node| mesh.vertices[node as usize]).collect::<Vec<_>>();
        assert!(x.windows(2).all(|x| (x[0].y, x[0].z, x[0].x) < (x[1].y, x[1].z, x[1].x)));
    }

    #[test]
    fn nodes_at_one_place_do_not_hang_the_dissection() {
        let vertices = vec![nalgebra::Vector3::zeros(); 100];
        let elements: Vec<[usize; 4]> = (0..97).map(|i| [i, i + 1, i + 2, i + 3]).collect();
        assert_eq!(Numbering::new(Ordering::Dissected, &vertices, &elements, &[false; 100]).mesh_node.len(), 100);
    }
}
