//! A pressure on triangles of the surface of a solid body.

use std::collections::HashMap;

use nalgebra::Vector3;

use fem_elements::vector::triple;
use fem_solvers::Real;

/// Triangles whose normals point outward.
#[derive(Clone, Debug, PartialEq)]
pub struct Triangles<T> {
    triangles: Vec<Triangle<T>>,
    /// Undeformed corners of each triangle, relative to a point of the surface, m, so that they are exact far from the origin.
    corners: Vec<[Vector3<f64>; 3]>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Triangle<T> {
    /// The engine's numbers of its nodes.
    nodes: [usize; 3],
    /// Undeformed edges from the first node to the others, m.
    edges: [[T; 3]; 2],
}

impl<T: Real> Triangles<T> {
    /// Triangles of a mesh with these vertices (m), and the engine's number of each node.
    pub fn new(vertices: &[Vector3<f64>], faces: &[Vec<usize>], engine_node: impl Fn(usize) -> usize) -> Self {
        let vector = |v: Vector3<f64>| [T::of(v.x), T::of(v.y), T::of(v.z)];
        let triangle = |face: &Vec<usize>| {
            let [a, b, c] = [0, 1, 2].map(|k| vertices[face[k]]);
            Triangle { nodes: [0, 1, 2].map(|k| engine_node(face[k])), edges: [vector(b - a), vector(c - a)] }
        };
        let corners = |face: &Vec<usize>| [0, 1, 2].map(|k| vertices[face[k]] - vertices[faces[0][0]]);
        Self { triangles: faces.iter().map(triangle).collect(), corners: faces.iter().map(corners).collect() }
    }

    /// Adds minus the nodal forces of a pressure (Pa), N: p/6 (x_b − x_a) × (x_c − x_a) at every corner, which is p n integrated with the
    /// corner's shape function over the deformed triangle.
    pub fn add_gradient(&self, pressure: T, u: &[[T; 3]], gradient: &mut [[T; 3]]) {
        let sixth = pressure * T::of(1.0 / 6.0);
        for Triangle { nodes: [a, b, c], edges } in &self.triangles {
            let d: [T; 3] = triple(|i| edges[0][i] + (u[*b][i] - u[*a][i]));
            let e: [T; 3] = triple(|i| edges[1][i] + (u[*c][i] - u[*a][i]));
            let normal = [d[1] * e[2] - d[2] * e[1], d[2] * e[0] - d[0] * e[2], d[0] * e[1] - d[1] * e[0]];
            for &node in &[*a, *b, *c] {
                for i in 0..3 {
                    gradient[node][i] += sixth * normal[i];
                }
            }
        }
    }

    /// Growth of the volume behind the surface, m³.
    pub fn growth(&self, u: &[[T; 3]]) -> f64 {
        let at = |node: usize| Vector3::from(u[node].map(T::as_f64));
        let growth = |(triangle, [A, B, C]): (&Triangle<T>, &[Vector3<f64>; 3])| {
            let [a, b, c] = triangle.nodes.map(at);
            // det(A + a, B + b, C + c) − det(A, B, C), without the difference.
            a.dot(&B.cross(C)) + (A + a).dot(&b.cross(C)) + (A + a).dot(&(B + b).cross(&c))
        };
        self.triangles.iter().zip(&self.corners).map(growth).sum::<f64>() / 6.0
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.triangles[..]) + size_of_val(&self.corners[..])
    }
}

/// The nodes on the edge of a surface, those at the middles of its sides too; a closed one has no edge.
pub fn rim(faces: &[Vec<usize>]) -> Vec<usize> {
    let sides = |face: &Vec<usize>| [0, 1, 2].map(|k| ([face[k], face[(k + 1) % 3]], face.get(3 + k).copied()));
    let edges: HashMap<[usize; 2], Option<usize>> = faces.iter().flat_map(sides).collect();
    // Two outward triangles run along a common edge in opposite directions.
    let free = edges.iter().filter(|&(&[a, b], _)| !edges.contains_key(&[b, a]));
    free.flat_map(|(ends, middle)| ends.iter().chain(middle)).copied().collect()
}
