//! A pressure on edges of the outline of a flat body.
//!
//! An edge has the shape functions φ of its nodes, so its deformed positions are x = Σ φ_i x_i, and with D_ij = ∫ φ_i dφ_j the force on
//! node i is −p t Σ_j D_ij R x_j, where t is the thickness and R (x, y) = (y, −x) turns a direction along the edge into its normal.
//! The area behind the edges is ½ Σ_ij D_ij (x_i × x_j). Both are exact on straight edges and on parabolas.

use std::collections::HashMap;

use nalgebra::{Vector2, Vector3};

use fem_solvers::Real;

/// Edges with the body on their left.
#[derive(Clone, Debug, PartialEq)]
pub struct Edges<T> {
    edges: Vec<Edge<T>>,
    /// Undeformed nodes of each edge, relative to a point of the outline, m, so that they are exact far from the origin.
    places: Vec<Vec<Vector2<f64>>>,
    /// m
    thickness: f64,
}

#[derive(Clone, Debug, PartialEq)]
struct Edge<T> {
    /// The engine's numbers of its nodes: the two ends, then the middle of a quadratic edge.
    nodes: Vec<usize>,
    /// Undeformed positions relative to the first node, m.
    places: Vec<[T; 2]>,
}

/// D_ij of a straight edge.
const LINEAR: [&[f64]; 2] = [&[-0.5, 0.5], &[-0.5, 0.5]];

/// D_ij of a quadratic edge.
const QUADRATIC: [&[f64]; 3] =
    [&[-3.0 / 6.0, -1.0 / 6.0, 4.0 / 6.0], &[1.0 / 6.0, 3.0 / 6.0, -4.0 / 6.0], &[-4.0 / 6.0, 4.0 / 6.0, 0.0]];

fn weights(nodes: usize) -> &'static [&'static [f64]] {
    if nodes == 2 { &LINEAR } else { &QUADRATIC }
}

impl<T: Real> Edges<T> {
    /// Edges of a mesh with these vertices (m), the engine's number of each node, and the thickness of the body (m).
    pub fn new(
        vertices: &[Vector3<f64>],
        faces: &[Vec<usize>],
        engine_node: impl Fn(usize) -> usize,
        thickness: f64,
    ) -> Self {
        let from = |origin: usize, node: usize| (vertices[node] - vertices[origin]).xy();
        let edge = |face: &Vec<usize>| Edge {
            nodes: face.iter().map(|&node| engine_node(node)).collect(),
            places: face.iter().map(|&node| <[f64; 2]>::from(from(face[0], node)).map(T::of)).collect(),
        };
        let places = |face: &Vec<usize>| face.iter().map(|&node| from(faces[0][0], node)).collect();
        Self { edges: faces.iter().map(edge).collect(), places: faces.iter().map(places).collect(), thickness }
    }

    /// Adds minus the nodal forces of a pressure (Pa), N.
    pub fn add_gradient(&self, pressure: T, u: &[[T; 3]], gradient: &mut [[T; 3]]) {
        let factor = pressure * T::of(self.thickness);
        for Edge { nodes, places } in &self.edges {
            let first = u[nodes[0]];
            for (&node, row) in nodes.iter().zip(weights(nodes.len())) {
                // Rows add up to zero, so positions relative to the first node are enough.
                let mut along = [T::default(); 2];
                for ((&other, place), &weight) in nodes.iter().zip(places).zip(*row).skip(1) {
                    for i in 0..2 {
                        along[i] += T::of(weight) * (place[i] + (u[other][i] - first[i]));
                    }
                }
                gradient[node][0] += factor * along[1];
                gradient[node][1] -= factor * along[0];
            }
        }
    }

    /// Growth of the volume behind the edges, m³.
    pub fn growth(&self, u: &[[T; 3]]) -> f64 {
        let at = |node: usize| Vector2::new(u[node][0].as_f64(), u[node][1].as_f64());
        let mut twice = 0.0;
        for (Edge { nodes, .. }, places) in self.edges.iter().zip(&self.places) {
            for ((&i, X), row) in nodes.iter().zip(places).zip(weights(nodes.len())) {
                for ((&j, Y), weight) in nodes.iter().zip(places).zip(*row) {
                    let (a, b) = (at(i), at(j));
                    // (X + a) × (Y + b) − X × Y, without the difference.
                    twice += weight * (a.perp(Y) + (X + a).perp(&b));
                }
            }
        }
        0.5 * self.thickness * twice
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        let nodes: usize = self.edges.iter().map(|edge| edge.nodes.len()).sum();
        size_of_val(&self.edges[..]) + nodes * (size_of::<usize>() + size_of::<[T; 2]>() + size_of::<Vector2<f64>>())
    }
}

/// The ends of a line of edges; a closed one has no ends.
pub fn rim(faces: &[Vec<usize>]) -> Vec<usize> {
    let mut surplus: HashMap<usize, i32> = HashMap::new();
    for face in faces {
        *surplus.entry(face[0]).or_default() += 1;
        *surplus.entry(face[1]).or_default() -= 1;
    }
    surplus.into_iter().filter(|(_, surplus)| *surplus != 0).map(|(node, _)| node).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A closed quadratic outline: a triangle with displaced nodes.
    fn outline() -> (Edges<f64>, Vec<[f64; 3]>) {
        let x = [[0.0, 0.0], [2.0, 0.0], [0.0, 1.0], [1.0, 0.0], [1.0, 0.5], [0.0, 0.5]];
        let vertices: Vec<_> = x.iter().map(|&[x, y]| Vector3::new(x, y, 0.0)).collect();
        let faces = [[0, 1, 3], [1, 2, 4], [2, 0, 5]].map(Vec::from);
        let u = (0..6).map(|i| [0.1 * f64::from(i).sin(), 0.2 * f64::from(3 * i).cos(), 0.0]).collect();
        (Edges::new(&vertices, &faces, |node| node, 0.3), u)
    }

    #[test]
    fn forces_are_minus_the_gradient_of_pressure_times_area() {
        let (edges, u) = outline();
        let mut gradient = vec![[0.0; 3]; 6];
        edges.add_gradient(5.0, &u, &mut gradient);
        for node in 0..6 {
            for i in 0..2 {
                let energy = |step: f64| {
                    let mut u = u.clone();
                    u[node][i] += step;
                    5.0 * edges.growth(&u)
                };
                let slope = (energy(1e-5) - energy(-1e-5)) / 2e-5;
                assert!((gradient[node][i] - slope).abs() < 1e-9, "node {node}: {} {slope}", gradient[node][i]);
            }
        }
    }

    #[test]
    fn a_parabola_has_the_area_that_archimedes_found() {
        let (edges, _) = outline();
        let mut u = vec![[0.0; 3]; 6];
        // The middle of the lowest edge moves out: 2/3 of base times height.
        u[3] = [0.0, -0.3, 0.0];
        assert!((edges.growth(&u) - 0.3 * 2.0 / 3.0 * 2.0 * 0.3).abs() < 1e-15);
    }

    #[test]
    fn open_lines_have_two_ends_and_closed_ones_have_none() {
        assert!(rim(&[vec![0, 1], vec![1, 2], vec![2, 0]]).is_empty());
        let mut ends = rim(&[vec![4, 1, 7], vec![1, 2, 8]]);
        ends.sort_unstable();
        assert_eq!(ends, [2, 4]);
    }
}
