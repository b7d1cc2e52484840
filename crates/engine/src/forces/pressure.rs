//! Pressure that follows the deformed surface.

use std::collections::HashSet;

use nalgebra::Vector3;

use crate::model::numbering::Numbering;
use crate::number::Real;
use fem_scene::Body;

/// A pressure on triangles of the surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Pressure<T> {
    /// Pa; positive pushes inward.
    pub pressure: T,
    faces: Vec<Face<T>>,
    /// Undeformed corners of each triangle, from a point of the surface, m; `None` where the pressure has no potential.
    ///
    /// A pressure is p times the gradient of the volume behind its surface. Where the surface has an edge that moves, that volume
    /// depends on where one closes it, and the work of the pressure on the way there and back need not be zero.
    corners: Option<Vec<[Vector3<f64>; 3]>>,
}

/// A triangle, outward.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Face<T> {
    /// The engine's numbers of its nodes.
    nodes: [usize; 3],
    /// Edges from the first node to the others at rest, m.
    edges: [[T; 3]; 2],
}

impl<T: Real> Pressure<T> {
    /// Every pressure of a scene.
    pub fn all(body: &Body, order: &Numbering) -> Vec<Self> {
        let vector = |v: Vector3<f64>| [T::of(v.x), T::of(v.y), T::of(v.z)];
        let face = |face: &[usize; 3]| {
            let [a, b, c] = face.map(|node| body.shape.mesh.vertices[node]);
            let nodes = face.map(|node| order.engine_node[node] as usize);
            Face { nodes, edges: [vector(b - a), vector(c - a)] }
        };
        let pressure = |fem_scene::Pressure { faces, pressure }: &fem_scene::Pressure| Self {
            pressure: T::of(*pressure),
            corners: edge_is_fixed(body, faces).then(|| corners(&body.shape.mesh.vertices, faces)),
            faces: faces.iter().map(face).collect(),
        };
        body.pressures.iter().map(pressure).collect()
    }

    /// Adds `factor` times the force on each node, N: −p/6 (x_b − x_a) × (x_c − x_a) at every corner, which is −p n integrated
    /// with its shape function over the deformed triangle.
    pub fn add_force(&self, factor: T, u: &[[T; 3]], force: &mut [[T; 3]]) {
        let sixth = -factor * self.pressure * T::of(1.0 / 6.0);
        for Face { nodes: [a, b, c], edges } in &self.faces {
            let d: [T; 3] = std::array::from_fn(|i| edges[0][i] + (u[*b][i] - u[*a][i]));
            let e: [T; 3] = std::array::from_fn(|i| edges[1][i] + (u[*c][i] - u[*a][i]));
            let normal = [d[1] * e[2] - d[2] * e[1], d[2] * e[0] - d[0] * e[2], d[0] * e[1] - d[1] * e[0]];
            for &node in &[*a, *b, *c] {
                for i in 0..3 {
                    force[node][i] += sixth * normal[i];
                }
            }
        }
    }

    /// Whether it has a potential: its surface is closed, or every node of its edge is fixed.
    pub fn has_potential(&self) -> bool {
        self.corners.is_some()
    }

    /// Its potential, zero at rest: p times what the volume behind the surface has grown by, J. `None` where it has none.
    pub fn potential(&self, u: &[[T; 3]]) -> Option<f64> {
        let at = |node: usize| Vector3::from(u[node].map(T::as_f64));
        let growth = |(face, [A, B, C]): (&Face<T>, &[Vector3<f64>; 3])| {
            let [a, b, c] = face.nodes.map(at);
            // det(A + a, B + b, C + c) − det(A, B, C), without the difference.
            a.dot(&B.cross(C)) + (A + a).dot(&b.cross(C)) + (A + a).dot(&(B + b).cross(&c))
        };
        let sixfold: f64 = self.faces.iter().zip(self.corners.as_ref()?).map(growth).sum();
        Some(self.pressure.as_f64() * sixfold / 6.0)
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.faces[..]) + self.corners.as_ref().map_or(0, |corners| size_of_val(&corners[..]))
    }
}

/// Corners from the first node, m: near the body, so that they keep their digits far from the origin.
fn corners(vertices: &[Vector3<f64>], faces: &[[usize; 3]]) -> Vec<[Vector3<f64>; 3]> {
    faces.iter().map(|face| face.map(|node| vertices[node] - vertices[faces[0][0]])).collect()
}

/// Whether `[fixed]` holds all edges that only one triangle has.
fn edge_is_fixed(body: &Body, faces: &[[usize; 3]]) -> bool {
    let fixed: HashSet<usize> = body.fixed_nodes().into_iter().flatten().copied().collect();
    let edges: HashSet<[usize; 2]> = faces.iter().flat_map(|&[a, b, c]| [[a, b], [b, c], [c, a]]).collect();
    // In two triangles that both look outward a common edge runs there and back.
    edges.iter().all(|&[a, b]| edges.contains(&[b, a]) || (fixed.contains(&a) && fixed.contains(&b)))
}
