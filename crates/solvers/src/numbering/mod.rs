//! Node numbering of the engine: free nodes first, then the fully constrained ones, which have no row in any matrix.

mod bisection;
mod fill;
mod fill_reducing;
mod minimum_degree;
mod parts;

use nalgebra::Vector3;

pub use fill::blocks_of_factor;
use fill_reducing::fill_reducing;
pub use minimum_degree::{Ties, minimum_degree};
use parts::by_parts;

/// The engine's numbers of a mesh's nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Numbering {
    /// Number in the mesh of each of the engine's nodes.
    pub mesh_node: Vec<u32>,
    /// Number in the engine of each of the mesh's nodes.
    pub engine_node: Vec<u32>,
    /// Number of nodes that are free in at least one direction. The engine numbers them from 0.
    pub free: usize,
}

/// The ordering of the free nodes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ordering {
    /// Keeps the fill-in of a factor small: for direct solvers.
    FillReducing,
    /// By parts that several threads can sweep over side by side, each along its longest axis, so that neighbours are near in
    /// memory; small bodies are one part.
    Parts,
}

impl Numbering {
    /// Numbers the free nodes by an ordering, then the constrained ones. `constrained` tells which nodes are constrained in all
    /// directions.
    pub fn new<const N: usize>(
        ordering: Ordering,
        vertices: &[Vector3<f64>],
        elements: &[[usize; N]],
        constrained: &[bool],
    ) -> Self {
        let mut mesh_node: Vec<u32> = (0..vertices.len() as u32).filter(|&node| !constrained[node as usize]).collect();
        let free = mesh_node.len();
        match ordering {
            Ordering::FillReducing => mesh_node = fill_reducing(mesh_node, vertices, elements),
            Ordering::Parts => mesh_node = by_parts(mesh_node, vertices, elements),
        }
        mesh_node.extend((0..vertices.len() as u32).filter(|&node| constrained[node as usize]));
        let mut engine_node = vec![0; mesh_node.len()];
        for (engine, &mesh) in mesh_node.iter().enumerate() {
            engine_node[mesh as usize] = engine as u32;
        }
        Self { mesh_node, engine_node, free }
    }

    /// The mesh's own numbers of so many nodes.
    pub fn of_mesh(nodes: usize) -> Self {
        let mesh_node: Vec<u32> = (0..nodes as u32).collect();
        Self { engine_node: mesh_node.clone(), mesh_node, free: nodes }
    }

    /// Elements with the engine's node numbers.
    pub fn elements<'a, const N: usize>(&self, elements: impl IntoIterator<Item = &'a [usize; N]>) -> Vec<[u32; N]> {
        elements.into_iter().map(|element| element.map(|node| self.engine_node[node])).collect()
    }

    /// Nodal values in the mesh's numbering, from those in the engine's.
    pub fn to_mesh<V: Copy>(&self, values: &[V]) -> Vec<V> {
        self.engine_node.iter().map(|&node| values[node as usize]).collect()
    }
}

/// The axes by the extent of these nodes, longest first; `None` without nodes.
fn longest_axes(nodes: &[u32], vertices: &[Vector3<f64>]) -> Option<[usize; 3]> {
    if nodes.is_empty() {
        return None;
    }
    let extent = extent(nodes, vertices);
    let mut axes = [0, 1, 2];
    axes.sort_by(|&a, &b| extent[b].total_cmp(&extent[a]));
    Some(axes)
}

/// Edge lengths of the bounding box of these nodes, of which there is at least one.
fn extent(nodes: &[u32], vertices: &[Vector3<f64>]) -> Vector3<f64> {
    let first = vertices[nodes[0] as usize];
    let (lower, upper) = nodes.iter().fold((first, first), |(lower, upper), &node| {
        (lower.inf(&vertices[node as usize]), upper.sup(&vertices[node as usize]))
    });
    upper - lower
}
