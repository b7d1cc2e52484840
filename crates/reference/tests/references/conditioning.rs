//! Extreme eigenvalues of stiffness matrices.

use fem_mesh::TetrahedralMesh;
use fem_reference::space::conditioning::conditioning;
use nalgebra::{DMatrix, Vector3};

/// Part of the longest side of the mesh in which nodes are fixed.
const FIXED: f64 = 0.1;

/// The largest and the smallest eigenvalue of the free nodes' stiffness as a full matrix.
fn dense(mesh: &TetrahedralMesh, axis: usize) -> [f64; 2] {
    let n = 3 * mesh.vertices.len();
    let (mu, lambda) = (0.5 / 1.3, 0.3 / (1.3 * 0.4));
    let mut K = DMatrix::<f64>::zeros(n, n);
    for element in &mesh.elements {
        let [a, b, c, d] = element.map(|i| mesh.vertices[i]);
        let edges = nalgebra::Matrix3::from_columns(&[b - a, c - a, d - a]);
        let inverse = edges.try_inverse().unwrap();
        let volume = edges.determinant() / 6.0;
        let mut gradients: Vec<Vector3<f64>> = (0..3).map(|i| inverse.row(i).transpose()).collect();
        gradients.insert(0, -(gradients[0] + gradients[1] + gradients[2]));
        for (p, g) in gradients.iter().enumerate() {
            for (q, h) in gradients.iter().enumerate() {
                let block =
                    lambda * g * h.transpose() + mu * h * g.transpose() + mu * g.dot(h) * nalgebra::Matrix3::identity();
                let mut target = K.view_mut((3 * element[p], 3 * element[q]), (3, 3));
                target += volume * block;
            }
        }
    }
    let values = mesh.vertices.iter().map(|x| x[axis]);
    let (least, most) = (values.clone().fold(f64::INFINITY, f64::min), values.fold(f64::NEG_INFINITY, f64::max));
    let is_free = |i: &usize| mesh.vertices[i / 3][axis] > least + FIXED * (most - least);
    let free: Vec<usize> = (0..n).filter(is_free).collect();
    let eigenvalues = K.select_rows(&free).select_columns(&free).symmetric_eigenvalues();
    [eigenvalues.max(), eigenvalues.min()]
}

#[test]
fn the_extreme_eigenvalues_are_those_of_the_full_matrix() {
    let mut mesh = fem_mesh::box_mesh([1.0, 0.6, 1.4], 5, fem_mesh::Pattern::Alternating).unwrap();
    for (i, x) in mesh.vertices.iter_mut().enumerate() {
        let shift = Vector3::from_fn(|k, _| 0.02 * ((3 * i + k) as f64 * 12.9898).sin());
        *x += shift;
    }
    let found = conditioning(&mesh).unwrap();
    let [largest, smallest] = dense(&mesh, found.axis);
    assert_eq!(found.axis, 2);
    assert!((found.largest / largest - 1.0).abs() < 1e-4, "{found:?} {largest}");
    assert!((found.smallest / smallest - 1.0).abs() < 1e-4, "{found:?} {smallest}");
}
