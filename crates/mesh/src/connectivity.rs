//! Connectivity of a mesh: its edges and connected parts, and nodes that coincide without being merged.

use nalgebra::Vector3;

use super::Mesh;

/// The first node of each node's connected part. Nodes are connected if an element has both.
pub fn parts<const N: usize>(mesh: &Mesh<3, N>) -> Vec<usize> {
    let mut parent: Vec<usize> = (0..mesh.vertices.len()).collect();
    for element in &mesh.elements {
        for &node in &element[1..] {
            let (a, b) = (root(&mut parent, element[0]), root(&mut parent, node));
            // The first node of a part is its root.
            parent[a.max(b)] = a.min(b);
        }
    }
    (0..parent.len()).map(|node| root(&mut parent, node)).collect()
}

/// Each edge once, its smaller node first, in ascending order.
pub(crate) fn edges<const N: usize>(elements: &[[usize; N]]) -> Vec<[usize; 2]> {
    let of_element = |element: &[usize; N]| {
        let element = *element;
        (1..N).flat_map(move |b| (0..b).map(move |a| sorted([element[a], element[b]])))
    };
    let mut edges: Vec<_> = elements.iter().flat_map(of_element).collect();
    edges.sort_unstable();
    edges.dedup();
    edges
}

pub(crate) fn sorted([a, b]: [usize; 2]) -> [usize; 2] {
    [a.min(b), a.max(b)]
}

/// The four triangles that the corners a, b, c of a triangle and the middles of its sides a b, b c, c a form.
pub(crate) fn quarters([a, b, c, ab, bc, ca]: [usize; 6]) -> [[usize; 3]; 4] {
    [[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]
}

fn root(parent: &mut [usize], mut node: usize) -> usize {
    while parent[node] != node {
        parent[node] = parent[parent[node]];
        node = parent[node];
    }
    node
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
pub fn coincident_nodes<const N: usize>(mesh: &Mesh<3, N>) -> Option<CoincidentNodes> {
    let corner = mesh.vertices.first()?;
    let largest = mesh.vertices.iter().map(|x| (x - corner).amax()).fold(0.0, f64::max);
    let near = NEAR * largest;
    // Few nodes of a mesh have nearly the same coordinate along an oblique direction.
    let direction = Vector3::new(0.537_284, 0.831_947, 0.137_415).normalize();
    let mut along: Vec<(f64, usize)> =
        mesh.vertices.iter().enumerate().map(|(node, x)| (direction.dot(&(x - corner)), node)).collect();
    along.sort_unstable_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
    let mut partner = vec![usize::MAX; mesh.vertices.len()];
    for (i, &(start, a)) in along.iter().enumerate() {
        for &(_, b) in along[i + 1..].iter().take_while(|(end, _)| end - start <= near) {
            if (mesh.vertices[a] - mesh.vertices[b]).norm() <= near {
                let (first, second) = (a.min(b), a.max(b));
                partner[second] = partner[second].min(first);
            }
        }
    }
    let second = partner.iter().position(|&first| first != usize::MAX)?;
    let count = partner.iter().filter(|&&first| first != usize::MAX).count();
    Some(CoincidentNodes { count, first: [partner[second], second] })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::TetrahedralMesh;

    fn boxes(shift: f64) -> TetrahedralMesh {
        let mut mesh = crate::box_mesh([2.0, 1.0, 1.0], 2, crate::Pattern::Alternating).unwrap();
        let (nodes, elements) = (mesh.vertices.len(), mesh.elements.clone());
        let moved: Vec<_> = mesh.vertices.iter().map(|x| x + Vector3::new(2.0 + shift, 0.0, 0.0)).collect();
        mesh.vertices.extend(moved);
        mesh.elements.extend(elements.iter().map(|element| element.map(|node| node + nodes)));
        mesh
    }

    #[test]
    fn two_boxes_are_two_parts_named_by_their_first_nodes() {
        let parts = parts(&boxes(1.0));
        assert_eq!(parts.len(), 90);
        assert!(parts[..45].iter().all(|&part| part == 0) && parts[45..].iter().all(|&part| part == 45));
    }

    #[test]
    fn touching_boxes_have_coincident_nodes_and_separate_ones_do_not() {
        // Nodes 4, 9, … of the first box lie at x = 2, as do nodes 45, 50, … of the second.
        let found = CoincidentNodes { count: 9, first: [4, 45] };
        assert_eq!(coincident_nodes(&boxes(0.0)), Some(found));
        assert_eq!(coincident_nodes(&boxes(1e-9)), Some(found), "within 1e-9 of 4 m");
        assert_eq!(coincident_nodes(&boxes(1e-7)), None);
        assert_eq!(coincident_nodes(&crate::box_mesh([1.0, 1.0, 1.0], 20, crate::Pattern::Alternating).unwrap()), None);
    }
}
