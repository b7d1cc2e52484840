//! Linear skinning: a display surface that follows the tetrahedra.

use nalgebra::{Matrix3, Vector3};

use fem_elements::tensor::inverse;

/// Four nodes and their weights for each display vertex.
#[derive(Clone, Debug)]
pub struct Skinning {
    rows: Vec<([u32; 4], [f64; 4])>,
}

/// A vertex belongs to an element if none of its shape functions is smaller than minus this.
const TOLERANCE: f64 = 1e-6;

impl Skinning {
    /// Assigns each vertex to the first element that contains it; a vertex outside all elements, to the one in which its smallest
    /// shape function is largest.
    pub fn new(X: &[Vector3<f64>], tetrahedra: &[[usize; 4]], vertices: &[Vector3<f64>]) -> Self {
        let shapes: Vec<_> = tetrahedra.iter().map(|element| shape(X, element)).collect();
        let weights = |element: usize, x: &Vector3<f64>| {
            let (origin, inverse) = &shapes[element];
            let phi = inverse * (x - origin);
            [1.0 - phi.sum(), phi.x, phi.y, phi.z]
        };
        let row = |x: &Vector3<f64>| {
            let mut best = (f64::NEG_INFINITY, 0, [0.0; 4]);
            for element in 0..shapes.len() {
                let phi = weights(element, x);
                let least = phi.iter().copied().fold(f64::INFINITY, f64::min);
                if least > best.0 {
                    best = (least, element, phi);
                }
                if least >= -TOLERANCE {
                    break;
                }
            }
            (tetrahedra[best.1].map(|node| node as u32), best.2)
        };
        Self { rows: vertices.iter().map(row).collect() }
    }

    /// Number of display vertices.
    pub fn rows(&self) -> usize {
        self.rows.len()
    }

    /// Number of display vertices that lie outside all elements.
    pub fn outside(&self) -> usize {
        self.rows.iter().filter(|(_, weights)| weights.iter().any(|&weight| weight < -TOLERANCE)).count()
    }

    /// Positions of the display vertices for nodes at `x`, m.
    pub fn apply(&self, x: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let position = |(nodes, weights): &([u32; 4], [f64; 4])| {
            nodes.iter().zip(weights).map(|(&node, &weight)| weight * x[node as usize]).sum()
        };
        self.rows.iter().map(position).collect()
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.rows[..])
    }
}

/// First corner, and the inverse of the edge matrix.
fn shape(X: &[Vector3<f64>], element: &[usize; 4]) -> (Vector3<f64>, Matrix3<f64>) {
    let [a, b, c, d] = element.map(|node| X[node]);
    // Meshes are checked: every element has a volume.
    (a, inverse(&Matrix3::from_columns(&[b - a, c - a, d - a])))
}
