//! Connectivity of a mesh: its edges and connected parts, and nodes that coincide without being merged.

use std::collections::{BTreeMap, HashMap};

use nalgebra::{SVector, Vector3};

/// The edges of a tetrahedron, by its corners.
pub(crate) const EDGES: [[usize; 2]; 6] = [[0, 1], [0, 2], [0, 3], [1, 2], [1, 3], [2, 3]];

/// The first node of the connected part of each of so many nodes. Nodes are connected if an element has both.
pub fn parts<E: AsRef<[usize]>>(nodes: usize, elements: impl IntoIterator<Item = E>) -> Vec<usize> {
    let mut parent: Vec<usize> = (0..nodes).collect();
    for element in elements {
        let element = element.as_ref();
        for &node in &element[1..] {
            connect(&mut parent, element[0], node);
        }
    }
    (0..parent.len()).map(|node| root(&mut parent, node)).collect()
}

/// Each edge once, its smaller node first, in ascending order.
pub(crate) fn edges<const N: usize>(elements: &[[usize; N]]) -> Vec<[usize; 2]> {
    let of_element = |element: &[usize; N]| {
        let element = *element;
        (1..N).flat_map(move |b| (0..b).map(move |a| [element[a], element[b]]))
    };
    distinct_edges(elements.iter().flat_map(of_element))
}

/// Each edge once, its smaller node first, in ascending order.
pub fn distinct_edges(edges: impl Iterator<Item = [usize; 2]>) -> Vec<[usize; 2]> {
    let mut edges: Vec<_> = edges.map(sorted).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

pub(crate) fn sorted<T: Ord, const N: usize>(mut nodes: [T; N]) -> [T; N] {
    nodes.sort_unstable();
    nodes
}

/// The four triangles that the corners a, b, c of a triangle and the middles of its sides a b, b c, c a form.
pub(crate) fn quarters([a, b, c, ab, bc, ca]: [usize; 6]) -> [[usize; 3]; 4] {
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

/// The sides of triangles, sorted by their edge, whose smaller node stands first: 3 · triangle + the corner at which the side begins.
pub(crate) fn sides_by_edge(triangles: &[[usize; 3]]) -> Vec<([usize; 2], usize)> {
    let of_triangle =
        |(i, &[a, b, c]): (usize, &[usize; 3])| [([a, b], 3 * i), ([b, c], 3 * i + 1), ([c, a], 3 * i + 2)];
    let sides = triangles.iter().enumerate().flat_map(of_triangle);
    let mut sides: Vec<_> = sides.map(|(edge, side)| (sorted(edge), side)).collect();
    sides.sort_unstable();
    sides
}

/// Root of an entry in a forest of sets, the first of its set: Tarjan, Efficiency of a Good But Not Linear Set Union Algorithm (1975).
pub(crate) fn root(parent: &mut [usize], mut at: usize) -> usize {
    while parent[at] != at {
        parent[at] = parent[parent[at]];
        at = parent[at];
    }
    at
}

/// Joins the sets of two entries.
pub(crate) fn connect(parent: &mut [usize], a: usize, b: usize) {
    let (a, b) = (root(parent, a), root(parent, b));
    parent[a.max(b)] = a.min(b);
}

/// The groups of so many things that pairs connect, by their first members.
pub(crate) fn groups(count: usize, pairs: impl Iterator<Item = [usize; 2]>) -> Vec<Vec<usize>> {
    let mut parent: Vec<usize> = (0..count).collect();
    pairs.for_each(|[a, b]| connect(&mut parent, a, b));
    let mut groups: BTreeMap<usize, Vec<usize>> = BTreeMap::new();
    (0..count).for_each(|at| groups.entry(root(&mut parent, at)).or_default().push(at));
    groups.into_values().collect()
}

/// Index of the first point at the place of each point.
pub(crate) fn first_at_each_place<const D: usize>(points: &[SVector<f64, D>]) -> Vec<usize> {
    let mut first = HashMap::with_capacity(points.len());
    points.iter().enumerate().map(|(point, x)| *first.entry(bits(x)).or_insert(point)).collect()
}

/// A place to look up. Adding zero turns −0 into 0.
pub(crate) fn bits<const D: usize>(x: &SVector<f64, D>) -> [u64; D] {
    x.map(|x| (x + 0.0).to_bits()).into()
}

/// Nodes nearer to each other than this part of the mesh's size coincide.
const NEAR: f64 = 1e-9;

/// Nodes at the place of another node, to which they are not connected.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct CoincidentNodes {
    /// Number of nodes at the place of a node with a smaller index.
    pub count: usize,
    /// The first of them, after the node that it coincides with.
    pub first: [usize; 2],
}

/// Nodes that coincide within 1e-9 of the mesh's size; `None` if there are none.
pub fn coincident_nodes(vertices: &[Vector3<f64>]) -> Option<CoincidentNodes> {
    let corner = vertices.first()?;
    let largest = vertices.iter().map(|x| (x - corner).amax()).fold(0.0, f64::max);
    let near = NEAR * largest;
    // Few nodes of a mesh have nearly the same coordinate along an oblique direction.
    let direction = Vector3::new(0.537_284, 0.831_947, 0.137_415).normalize();
    let mut along: Vec<(f64, usize)> =
        vertices.iter().enumerate().map(|(node, x)| (direction.dot(&(x - corner)), node)).collect();
    along.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut partner = vec![usize::MAX; vertices.len()];
    for (i, &(start, a)) in along.iter().enumerate() {
        for &(_, b) in along[i + 1..].iter().take_while(|(end, _)| end - start <= near) {
            if (vertices[a] - vertices[b]).norm() <= near {
                let (first, second) = (a.min(b), a.max(b));
                partner[second] = partner[second].min(first);
            }
        }
    }
    let second = partner.iter().position(|&first| first != usize::MAX)?;
    let count = partner.iter().filter(|&&first| first != usize::MAX).count();
    Some(CoincidentNodes { count, first: [partner[second], second] })
}
