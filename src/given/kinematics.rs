//! Small quantities that many exercises need.

use nalgebra::{DVector, Matrix3, Matrix4x3, Vector3};

/// Deformation gradient F = Σ q_a ∇φ_aᵀ of one element, dimensionless.
///
/// `q  (3n)` positions, m; `dphi  (4×3)` gradients of the shape functions, 1/m.
///
/// The gradients of the four shape functions add up to zero, so a common offset of all positions may be taken away
/// first: with edges instead of positions no digits are lost far from the origin.
#[inline]
pub fn deformation_gradient(q: &DVector<f64>, element: &[usize; 4], dphi: &Matrix4x3<f64>) -> Matrix3<f64> {
    let x = |a: usize| Vector3::new(q[3 * element[a]], q[3 * element[a] + 1], q[3 * element[a] + 2]);
    let x0 = x(0);
    let (e1, e2, e3) = (x(1) - x0, x(2) - x0, x(3) - x0);
    // Entry by entry, which takes half the time of a product of matrices that are first written to memory.
    Matrix3::from_fn(|i, j| e1[i] * dphi[(1, j)] + e2[i] * dphi[(2, j)] + e3[i] * dphi[(3, j)])
}

/// Undeformed volume of each element, m³; negative for an inverted element.
pub fn volumes(V: &[Vector3<f64>], T: &[[usize; 4]]) -> Vec<f64> {
    let volume = |element: &[usize; 4]| {
        let [a, b, c, d] = element.map(|vertex| V[vertex]);
        (b - a).cross(&(c - a)).dot(&(d - a)) / 6.0
    };
    T.iter().map(volume).collect()
}
