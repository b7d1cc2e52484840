use std::ops::Mul;

use nalgebra::{SMatrix, Vector3};

/// The point at which all four shape functions are equal.
pub fn quadrature_single_point<R: Mul<f64, Output = R>>(
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    integrand: impl Fn(&Vector3<f64>) -> R,
) -> R {
    let corners = SMatrix::<f64, 3, 4>::from_columns(&element.map(|vertex| V[vertex]));
    integrand(&Vector3::from(corners.column_mean())) * volume
}
