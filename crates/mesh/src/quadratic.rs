//! Quadratic triangles: six nodes, three of them at the middles of the sides.

use super::connectivity::{edges, quarters, sorted};
use super::{Mesh, SurfaceMesh};

/// Straight-sided triangles with the nodes a, b, c, and those at the middles of the sides a b, b c, c a: VTK's type 22, Gmsh's type 9.
pub type QuadraticMesh = Mesh<3, 6>;

/// A side of a quadratic triangle: its two ends, and the node in its middle.
pub type QuadraticSide = [usize; 3];

/// Puts a node on the middle of every edge. The first nodes are those of the mesh, the others follow in the order of their edges, which
/// [`refine_triangles`](super::refine_triangles) has too. Named sets keep their lists: their edges are named by their ends.
pub fn quadratic(mesh: SurfaceMesh) -> QuadraticMesh {
    let edges = edges(&mesh.elements);
    let corners = mesh.vertices.len();
    let middle = |edge: [usize; 2]| corners + edges.binary_search(&sorted(edge)).expect("every edge is in the list");
    let elements =
        mesh.elements.iter().map(|&[a, b, c]| [a, b, c, middle([a, b]), middle([b, c]), middle([c, a])]).collect();
    let mut vertices = mesh.vertices;
    vertices.extend(edges.iter().map(|&[a, b]| 0.5 * (vertices[a] + vertices[b])).collect::<Vec<_>>());
    QuadraticMesh { vertices, elements, sets: mesh.sets }
}

/// The sides of each triangle, with the triangle on their left.
pub fn sides(triangles: &[[usize; 6]]) -> impl Iterator<Item = QuadraticSide> {
    triangles.iter().flat_map(|&[a, b, c, ab, bc, ca]| [[a, b, ab], [b, c, bc], [c, a, ca]])
}

/// The four linear triangles between the nodes of each quadratic one, with the same orientation.
pub fn quarters_of(triangles: &[[usize; 6]]) -> Vec<[usize; 3]> {
    triangles.iter().flat_map(|&nodes| quarters(nodes)).collect()
}

#[cfg(test)]
mod tests {
    use std::collections::HashMap;

    use super::*;
    use crate::{Pattern, rectangle_mesh};

    #[test]
    fn neighbours_share_the_nodes_of_their_common_edge() {
        let mesh = quadratic(rectangle_mesh([2.0, 1.0], 2, Pattern::Alternating).unwrap());
        // Euler: V − E + T = 1.
        assert_eq!(mesh.vertices.len(), 15 + (15 + 16 - 1));
        let mut middles: HashMap<[usize; 2], usize> = HashMap::new();
        for [a, b, middle] in sides(&mesh.elements) {
            assert_eq!(mesh.vertices[middle], 0.5 * (mesh.vertices[a] + mesh.vertices[b]));
            assert_eq!(*middles.entry(sorted([a, b])).or_insert(middle), middle);
        }
    }

    #[test]
    fn the_quarters_are_the_triangles_of_one_refinement() {
        let linear = rectangle_mesh([2.0, 1.0], 1, Pattern::Alternating).unwrap();
        let refined = crate::refine_triangles(linear.clone(), 1, std::path::Path::new("rectangle")).unwrap();
        let quadratic = quadratic(linear);
        assert_eq!((&refined.vertices, refined.elements), (&quadratic.vertices, quarters_of(&quadratic.elements)));
    }
}
