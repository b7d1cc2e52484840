//! Points of elements, for integrals of high degree: their shape functions, and gradients of displacements at them.

use nalgebra::{Matrix2, Vector3};

use crate::space::quadrature::Rule;
use fem_engine::elements::quadratic;
use fem_engine::tensor::{Tensor, from_fn};
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
    let linear = |barycentric: &[f64], weight: f64| Point {
        barycentric: barycentric.to_vec(),
        weight,
        values: barycentric.to_vec(),
    };
    match mesh {
        BodyMesh::Solid(_) => Rule::<4>::of_index(RULE).points.iter().map(|(L, weight)| linear(L, *weight)).collect(),
        BodyMesh::Flat { .. } => {
            Rule::<3>::of_index(RULE).points.iter().map(|(L, weight)| linear(L, *weight)).collect()
        }
        BodyMesh::Quadratic { .. } => {
            let quadratic = |(L, weight): &([f64; 3], f64)| Point {
                values: quadratic::shape_functions(L).to_vec(),
                ..linear(L, *weight)
            };
            Rule::<3>::of_index(RULE).points.iter().map(quadratic).collect()
        }
    }
}

/// The displacement gradient in an element.
#[derive(Clone, Debug)]
pub enum LocalGradient {
    /// The same everywhere.
    Constant(Tensor<f64>),
    /// Of a quadratic triangle.
    Linear {
        /// Gradients of the barycentric coordinates of the second and third corner in the rows, 1/m.
        corners: Matrix2<f64>,
        /// Displacements of the nodes, m.
        u: [[f64; 3]; 6],
    },
}

impl LocalGradient {
    /// The gradient in an element, from the displacements of all nodes, m.
    pub fn new(mesh: &BodyMesh, element: usize, u: &[[f64; 3]]) -> Self {
        let BodyMesh::Quadratic { triangles, .. } = mesh else {
            let G = mesh.displacement_gradient(element, |node| Vector3::from(u[node]));
            return Self::Constant(from_fn(|i, j| G[(i, j)]));
        };
        let nodes = triangles.elements[element];
        let edge = |k: usize| (triangles.vertices[nodes[k]] - triangles.vertices[nodes[0]]).xy();
        let inverse = Matrix2::from_columns(&[edge(1), edge(2)]).try_inverse();
        Self::Linear { corners: inverse.unwrap_or_default(), u: nodes.map(|node| u[node]) }
    }

    /// G_ij = ∂u_i/∂X_j at a point.
    pub fn at(&self, point: &Point) -> Tensor<f64> {
        match self {
            Self::Constant(G) => *G,
            Self::Linear { corners, u } => {
                let L = [point.barycentric[0], point.barycentric[1], point.barycentric[2]];
                let gradients = quadratic::gradients(corners, &L);
                let entry = |i: usize, j: usize| (0..6).map(|node| u[node][i] * gradients[node][j]).sum();
                from_fn(|i, j| if j < 2 { entry(i, j) } else { 0.0 })
            }
        }
    }
}
