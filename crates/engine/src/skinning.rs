//! Skinning: a display surface that follows the elements of a solid body by their shape functions.

use fem_model::BodyMesh;
use nalgebra::{Matrix3, Vector3};

use fem_elements::tensor::inverse;

/// The nodes of an element and their weights for each display vertex.
#[derive(Clone, Debug)]
pub struct Skinning {
    /// Number of nodes of an element.
    nodes: usize,
    /// Those of the first vertex, then those of the next.
    rows: Vec<(u32, f64)>,
    /// Number of display vertices that lie outside all elements.
    outside: usize,
}

/// A vertex belongs to an element if none of its barycentric coordinates is smaller than minus this.
const TOLERANCE: f64 = 1e-6;

impl Skinning {
    /// Assigns each vertex to the first element that contains it; a vertex outside all elements, to the one in which its smallest
    /// barycentric coordinate is largest.
    pub fn new(mesh: &BodyMesh, vertices: &[Vector3<f64>]) -> Self {
        let shapes: Vec<_> = mesh.corners().map(|nodes| shape(mesh.vertices(), nodes)).collect();
        let weights = |element: usize, x: &Vector3<f64>| {
            let (origin, inverse) = &shapes[element];
            let phi = inverse * (x - origin);
            [1.0 - phi.sum(), phi.x, phi.y, phi.z]
        };
        let (mut rows, mut outside) = (Vec::new(), 0);
        for x in vertices {
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
            let (least, element, phi) = best;
            let weights = mesh.element().values(&phi);
            rows.extend(mesh.nodes_of(element).iter().map(|&node| node as u32).zip(weights));
            outside += usize::from(least < -TOLERANCE);
        }
        Self { nodes: mesh.element().nodes(), rows, outside }
    }

    /// Number of display vertices.
    pub fn rows(&self) -> usize {
        self.rows.len() / self.nodes
    }

    /// Number of display vertices that lie outside all elements.
    pub fn outside(&self) -> usize {
        self.outside
    }

    /// Positions of the display vertices for nodes at `x`, m.
    pub fn apply(&self, x: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let position = |row: &[(u32, f64)]| row.iter().map(|&(node, weight)| weight * x[node as usize]).sum();
        self.rows.chunks_exact(self.nodes).map(position).collect()
    }

    /// Memory, bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.rows[..])
    }
}

/// First corner, and the inverse of the edge matrix.
fn shape(X: &[Vector3<f64>], nodes: &[usize]) -> (Vector3<f64>, Matrix3<f64>) {
    let [a, b, c, d] = [0, 1, 2, 3].map(|corner| X[nodes[corner]]);
    // Meshes are checked: every element has a volume.
    (a, inverse(&Matrix3::from_columns(&[b - a, c - a, d - a])))
}
