//! Bounds for round-off: errors are measured relative to the terms that were added, not to their sum.

use grader_child::algebra::smallest_singular_value;
use nalgebra::Matrix3;

/// Size of the terms of the energy density, J/m³.
pub fn energy_terms(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    let J = F.determinant();
    let shape = F.norm_squared() / J.cbrt().powi(2);
    C * (shape + 3.0) + D * (J * J + 1.0)
}

/// The smallest singular value of F, its distance from a singular matrix.
pub fn smallest_stretch(F: &Matrix3<f64>) -> f64 {
    smallest_singular_value(F)
}

/// Size of the terms of the stress, Pa.
pub fn stress_terms(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    energy_terms(F, C, D) / smallest_stretch(F)
}

/// Size of the terms of the derivative of the stress, Pa.
pub fn stiffness_terms(F: &Matrix3<f64>, C: f64, D: f64) -> f64 {
    stress_terms(F, C, D) / smallest_stretch(F)
}
