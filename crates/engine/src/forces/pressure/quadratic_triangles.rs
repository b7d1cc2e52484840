//! A pressure on quadratic triangles of the surface of a solid body.
//!
//! A triangle has the shape functions φ of its nodes over the reference triangle (ξ, η), so its deformed positions are x = Σ φ_i x_i and the
//! force on node i is −p ∫ φ_i ∂x/∂ξ × ∂x/∂η dξ dη. The volume behind the surface is ⅓ ∫ x · (∂x/∂ξ × ∂x/∂η). Both integrands are of degree 4,
//! for which a rule of six points is exact: D. A. Dunavant, High Degree Efficient Symmetrical Gaussian Quadrature Rules for the Triangle (1985).

use fem_model::element::Element;
use nalgebra::Vector3;

use fem_elements::vector::triple;
use fem_solvers::Real;

/// Distance of three points from the nearest sides, as a barycentric coordinate, and the part of the area of each of them.
const RULE: [(f64, f64); 2] =
    [(0.445_948_490_915_964_9, 0.223_381_589_678_011_47), (0.091_576_213_509_770_74, 0.109_951_743_655_321_87)];

/// Nodes of a triangle.
const NODES: usize = 6;

/// Triangles whose normals point outward.
#[derive(Clone, Debug, PartialEq)]
pub struct QuadraticTriangles<T> {
    triangles: Vec<Triangle<T>>,
    /// Undeformed nodes of each triangle, relative to a point of the surface, m, so that they are exact far from the origin.
    places: Vec<[Vector3<f64>; NODES]>,
    points: Vec<Point>,
}

#[derive(Clone, Copy, Debug, PartialEq)]
struct Triangle<T> {
    /// The engine's numbers of its nodes: the corners, then the middles of its sides.
    nodes: [usize; NODES],
    /// Undeformed positions relative to the first node, m.
    places: [[T; 3]; NODES],
}

/// A quadrature point.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Point {
    /// Its part of the area of the reference triangle, ½.
    weight: f64,
    /// Shape functions of the nodes.
    values: [f64; NODES],
    /// Their derivatives by ξ and η.
    derivatives: [[f64; NODES]; 2],
}

impl<T: Real> QuadraticTriangles<T> {
    /// Triangles of a mesh with these vertices (m), and the engine's number of each node.
    pub fn new(vertices: &[Vector3<f64>], faces: &[Vec<usize>], engine_node: impl Fn(usize) -> usize) -> Self {
        let from = |origin: usize, node: usize| vertices[node] - vertices[origin];
        let triangle = |face: &Vec<usize>| Triangle {
            nodes: std::array::from_fn(|i| engine_node(face[i])),
            places: std::array::from_fn(|i| <[f64; 3]>::from(from(face[0], face[i])).map(T::of)),
        };
        let places = |face: &Vec<usize>| std::array::from_fn(|i| from(faces[0][0], face[i]));
        Self {
            triangles: faces.iter().map(triangle).collect(),
            places: faces.iter().map(places).collect(),
            points: points(),
        }
    }

    /// Adds minus the nodal forces of a pressure (Pa), N.
    pub fn add_gradient(&self, pressure: T, u: &[[T; 3]], gradient: &mut [[T; 3]]) {
        for Triangle { nodes, places } in &self.triangles {
            let first = u[nodes[0]];
            for Point { weight, values, derivatives } in &self.points {
                // Derivatives add up to zero, so positions relative to the first node are enough.
                let [d, e] = derivatives.map(|derivative| {
                    let mut sum = [T::default(); 3];
                    for (k, &node) in nodes.iter().enumerate().skip(1) {
                        for i in 0..3 {
                            sum[i] += T::of(derivative[k]) * (places[k][i] + (u[node][i] - first[i]));
                        }
                    }
                    sum
                });
                let normal = [d[1] * e[2] - d[2] * e[1], d[2] * e[0] - d[0] * e[2], d[0] * e[1] - d[1] * e[0]];
                let load: [T; 3] = triple(|i| pressure * T::of(*weight) * normal[i]);
                for (&node, &value) in nodes.iter().zip(values) {
                    (0..3).for_each(|i| gradient[node][i] += T::of(value) * load[i]);
                }
            }
        }
    }

    /// Growth of the volume behind the surface, m³.
    pub fn growth(&self, u: &[[T; 3]]) -> f64 {
        let mut sum = 0.0;
        for (triangle, places) in self.triangles.iter().zip(&self.places) {
            let moved = triangle.nodes.map(|node| Vector3::from(u[node].map(T::as_f64)));
            let at = |of: &[f64; NODES], x: &[Vector3<f64>; NODES]| -> Vector3<f64> {
                of.iter().zip(x).map(|(factor, x)| x * *factor).sum()
            };
            for Point { weight, values, derivatives: [by_xi, by_eta] } in &self.points {
                let [[A, a], [B, b], [C, c]] = [values, by_xi, by_eta].map(|of| [at(of, places), at(of, &moved)]);
                // det(A + a, B + b, C + c) − det(A, B, C), without the difference.
                sum += weight * (a.dot(&B.cross(&C)) + (A + a).dot(&b.cross(&C)) + (A + a).dot(&(B + b).cross(&c)));
            }
        }
        sum / 3.0
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.triangles[..]) + size_of_val(&self.places[..]) + size_of_val(&self.points[..])
    }
}

/// The quadrature points. A face has the nodes of the flat element of its order, in the same order.
fn points() -> Vec<Point> {
    let flat = |element: &&Element| (element.dimension, element.nodes()) == (2, NODES);
    let functions = Element::ALL.into_iter().find(flat).map_or(&[][..], |element| element.shape_functions);
    let point = |(L, area): ([f64; 3], f64)| {
        let along = |by: usize| {
            let slope = |i: usize, by: usize| functions[i].derivative(by, &L).unwrap_or(0.0);
            std::array::from_fn(|i| slope(i, by) - slope(i, 0))
        };
        Point {
            weight: 0.5 * area,
            values: std::array::from_fn(|i| functions[i].value(&L)),
            derivatives: [along(1), along(2)],
        }
    };
    let three = |(near, area): (f64, f64)| {
        (0..3).map(move |far| (std::array::from_fn(|i| if i == far { 1.0 - 2.0 * near } else { near }), area))
    };
    RULE.into_iter().flat_map(three).map(point).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use fem_mesh::{Pattern, box_mesh};
    use fem_model::BodyMesh;

    /// The surface of a bent cube, and displacements of its nodes.
    fn surface() -> (QuadraticTriangles<f64>, BodyMesh, Vec<[f64; 3]>) {
        let mesh = box_mesh([1.0; 3], 1, Pattern::Alternating).unwrap();
        let mesh = BodyMesh::solid(mesh).of_order(2).unwrap();
        let wave = |i: usize, k: usize| 0.05 * ((5 * i + 3 * k) as f64).sin();
        let u = (0..mesh.vertices().len()).map(|i| [wave(i, 0), wave(i, 1), wave(i, 2)]).collect();
        (QuadraticTriangles::new(mesh.vertices(), &mesh.faces(), |node| node), mesh, u)
    }

    #[test]
    fn forces_are_minus_the_gradient_of_pressure_times_volume_and_balance() {
        let (triangles, mesh, u) = surface();
        let mut gradient = vec![[0.0; 3]; u.len()];
        triangles.add_gradient(5.0, &u, &mut gradient);
        for node in 0..mesh.vertices().len() {
            for i in 0..3 {
                let energy = |step: f64| {
                    let mut u = u.clone();
                    u[node][i] += step;
                    5.0 * triangles.growth(&u)
                };
                let slope = (energy(1e-5) - energy(-1e-5)) / 2e-5;
                assert!((gradient[node][i] - slope).abs() < 1e-9, "node {node}: {} {slope}", gradient[node][i]);
            }
        }
        for i in 0..3 {
            assert!(gradient.iter().map(|force| force[i]).sum::<f64>().abs() < 1e-14);
        }
    }

    #[test]
    fn a_stretched_cube_grows_by_its_volume() {
        let (triangles, mesh, _) = surface();
        let u: Vec<[f64; 3]> = mesh.vertices().iter().map(|x| [0.5 * x.x, 0.2 * x.x * x.x, -0.1 * x.z]).collect();
        assert!((triangles.growth(&u) - (1.5 * 0.9 - 1.0)).abs() < 1e-14);
    }

    #[test]
    fn a_flat_triangle_is_pressed_at_the_middles_of_its_sides() {
        let corners = [[0.0, 0.0, 0.0], [2.0, 0.0, 0.0], [0.0, 1.0, 0.0]].map(Vector3::from);
        let middles = [[0, 1], [1, 2], [2, 0]].map(|[a, b]: [usize; 2]| 0.5 * (corners[a] + corners[b]));
        let triangles = QuadraticTriangles::new(&[corners, middles].concat(), &[vec![0, 1, 2, 3, 4, 5]], |node| node);
        let mut gradient = vec![[0.0_f64; 3]; 6];
        triangles.add_gradient(6.0, &[[0.0; 3]; 6], &mut gradient);
        for (node, force) in gradient.iter().enumerate() {
            let expected = if node < 3 { 0.0 } else { 2.0 };
            assert!((force[2] - expected).abs() < 1e-14 && force[0].abs() + force[1].abs() == 0.0, "{gradient:?}");
        }
    }
}
