//! Sizes of the terms that an answer is the sum of: round-off is measured relative to them, not to the sum.

use grader_child::algebra::smallest_singular_value;
use nalgebra::{DVector, Matrix3, Matrix4x3, Vector3};

use super::trial::{Elastic, Mesh};

/// Size of the terms of the energy density, J/m³.
pub fn energy(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    let J = F.determinant();
    if J <= 0.0 {
        return 1.0;
    }
    C * (F.norm_squared() / J.cbrt().powi(2) + 3.0) + D * (J * J + 1.0)
}

/// Size of the terms of the stress, Pa: the energy over the smallest principal stretch.
pub fn stress(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    energy(F, C, D) / smallest_singular_value(F)
}

/// Size of the terms of the derivative of the stress, Pa.
pub fn stiffness(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    stress(F, C, D) / smallest_singular_value(F)
}

/// Length of the longest gradient of a shape function, 1/m: one over the smallest height.
pub fn steepest(dphi: &Matrix4x3<f64>) -> f64 {
    dphi.row_iter().map(|row| row.norm()).fold(0.0, f64::max)
}

/// Gradients of the shape functions of an element.
pub fn gradients(V: &[Vector3<f64>], element: &[usize; 4]) -> Matrix4x3<f64> {
    finite_elements_3d::dphi_linear_tetrahedron_dX(V, element, &Vector3::zeros())
}

/// Deformation gradient of an element.
pub fn deformation(q: &DVector<f64>, V: &[Vector3<f64>], element: &[usize; 4]) -> Matrix3<f64> {
    finite_elements_3d::given::deformation_gradient(q, element, &gradients(V, element))
}

/// Size of the terms of an element's energy (`derivatives` = 0), gradient (1) or Hessian (2).
pub fn elastic(of: &Elastic, derivatives: usize) -> f64 {
    let F = deformation(&of.q, &of.V, &of.element);
    let steepest = steepest(&gradients(&of.V, &of.element));
    of.volume
        * match derivatives {
            0 => energy(&F, of.C, of.D),
            1 => stress(&F, of.C, of.D) * steepest,
            _ => stiffness(&F, of.C, of.D) * steepest * steepest,
        }
}

/// The same for the largest of a mesh's elements.
pub fn mesh(of: &Mesh, derivatives: usize) -> f64 {
    let elements = of.T.iter().zip(&of.v0);
    let sizes = elements.map(|(&element, &volume)| {
        let (q, V) = (of.q.clone(), of.V.clone());
        elastic(&Elastic { q, V, element, volume, C: of.C, D: of.D }, derivatives)
    });
    sizes.fold(0.0, f64::max)
}
