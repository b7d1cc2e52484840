//! Pressure that follows the deformed surface.

use nalgebra::Vector3;

use crate::number::Real;
use crate::order::Order;
use crate::scene::{Body, Scene};

/// A pressure on triangles of the surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Pressure<T> {
    /// Pa; positive pushes inward.
    pub pressure: T,
    faces: Vec<Face<T>>,
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
    pub fn all(scene: &Scene, body: &Body, order: &Order) -> Vec<Self> {
        let vector = |v: Vector3<f64>| [T::of(v.x), T::of(v.y), T::of(v.z)];
        let face = |face: &[usize; 3]| {
            let [a, b, c] = face.map(|node| body.shape.mesh.vertices[node]);
            let nodes = face.map(|node| order.engine_node[node] as usize);
            Face { nodes, edges: [vector(b - a), vector(c - a)] }
        };
        let tables = scene.traction.iter().zip(&body.loaded_faces);
        let pressure = |pressure, faces: &[[usize; 3]]| Self {
            pressure: T::of(pressure),
            faces: faces.iter().map(face).collect(),
        };
        tables.filter_map(|(traction, faces)| Some(pressure(traction.pressure?, faces))).collect()
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

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.faces[..])
    }
}
