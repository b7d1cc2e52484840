//! Points of elements, for integrals of high degree, and shape functions at them.

use nalgebra::Vector3;

use crate::space::quadrature::Rule;
use fem_model::BodyMesh;

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
