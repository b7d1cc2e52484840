//! A display surface that follows the tetrahedra.

use nalgebra::{Matrix3, Vector3};

use fem_mesh::TetrahedralMesh;

/// Four nodes and their weights for each display vertex.
#[derive(Clone, Debug)]
pub struct Skinning {
    rows: Vec<([u32; 4], [f64; 4])>,
}

/// How far outside an element, as a shape function's value, a vertex still counts as inside.
const TOLERANCE: f64 = 1e-6;

impl Skinning {
    /// Each vertex goes to the first element that holds it; one that lies in none to the element from whose inside it is least
    /// far, as its smallest shape function tells.
    pub fn new(mesh: &TetrahedralMesh, vertices: &[Vector3<f64>]) -> Self {
        let shapes: Vec<_> = mesh.elements.iter().map(|element| shape(mesh, element)).collect();
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
            (mesh.elements[best.1].map(|node| node as u32), best.2)
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

    /// Where the display vertices are when the nodes are at `x`, m.
    pub fn apply(&self, x: &[Vector3<f64>]) -> Vec<Vector3<f64>> {
        let position = |(nodes, weights): &([u32; 4], [f64; 4])| {
            nodes.iter().zip(weights).map(|(&node, &weight)| weight * x[node as usize]).sum()
        };
        self.rows.iter().map(position).collect()
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of_val(&self.rows[..])
    }
}

/// First corner, and the inverse of the edge matrix.
fn shape(mesh: &TetrahedralMesh, element: &[usize; 4]) -> (Vector3<f64>, Matrix3<f64>) {
    let [a, b, c, d] = element.map(|node| mesh.vertices[node]);
    // Meshes are checked: no element is without volume.
    (a, Matrix3::from_columns(&[b - a, c - a, d - a]).try_inverse().unwrap_or_default())
}
