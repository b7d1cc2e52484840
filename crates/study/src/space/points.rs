//! Points of elements, for integrals of high degree: their shape functions, and gradients of displacements at them.

use nalgebra::{Matrix3, Vector3};

use crate::space::quadrature::Rule;
use fem_engine::tensor::{Tensor, from_fn};
use fem_model::BodyMesh;
use fem_model::element::Element;

/// Index of the quadrature rule: exact for polynomials of degree 7.
const RULE: u32 = 3;

/// A point of every element of a mesh.
#[derive(Clone, Debug, PartialEq)]
pub struct Point {
    /// Barycentric coordinates.
    pub barycentric: Vec<f64>,
    /// Part of the element's volume.
    pub weight: f64,
    /// Shape functions of the element's nodes.
    pub values: Vec<f64>,
}

impl Point {
    /// Undeformed position in an element with these nodes, whose corners come first, m.
    pub fn place(&self, mesh: &BodyMesh, nodes: &[usize]) -> Vector3<f64> {
        nodes.iter().zip(&self.barycentric).map(|(&node, &weight)| mesh.vertices()[node] * weight).sum()
    }
}

/// The points of a rule of degree 7 in the elements of a mesh.
pub fn points(mesh: &BodyMesh) -> Vec<Point> {
    let element = mesh.element();
    let point = |(L, weight): (Vec<f64>, f64)| Point { values: element.values(&L), barycentric: L, weight };
    Rule::of_index(element.dimension, RULE).points.into_iter().map(point).collect()
}

/// The displacement gradient in an element.
#[derive(Clone, Debug)]
pub struct LocalGradient {
    element: &'static Element,
    /// Gradients of the barycentric coordinates, 1/m.
    corners: Vec<[f64; 3]>,
    /// Displacements of the nodes, m.
    u: Vec<[f64; 3]>,
}

impl LocalGradient {
    /// The gradient in an element, from the displacements of all nodes, m.
    pub fn new(mesh: &BodyMesh, element: usize, u: &[[f64; 3]]) -> Self {
        let nodes = mesh.nodes_of(element);
        let edge = |k: usize| match mesh.corners_of(element).get(k) {
            Some(&corner) => mesh.vertices()[corner] - mesh.vertices()[nodes[0]],
            None => Vector3::z(),
        };
        let inverse = Matrix3::from_columns(&[edge(1), edge(2), edge(3)]).try_inverse().unwrap_or_default();
        let others: Vec<[f64; 3]> = (0..mesh.dimension()).map(|k| std::array::from_fn(|j| inverse[(k, j)])).collect();
        let first = std::array::from_fn(|j| -others.iter().map(|other| other[j]).sum::<f64>());
        let corners = std::iter::once(first).chain(others).collect();
        Self { element: mesh.element(), corners, u: nodes.iter().map(|&node| u[node]).collect() }
    }

    /// G_ij = ∂u_i/∂X_j at a point.
    pub fn at(&self, point: &Point) -> Tensor<f64> {
        let gradients = self.element.gradients(&self.corners, &point.barycentric);
        from_fn(|i, j| self.u.iter().zip(&gradients).map(|(u, gradient)| u[i] * gradient[j]).sum())
    }
}
