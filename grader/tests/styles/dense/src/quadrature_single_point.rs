use std::ops::Mul;

use nalgebra::{Matrix3x4, Vector3, Vector4};

/// The vertices as a matrix, times a vector of quarters.
pub fn quadrature_single_point<R: Mul<f64, Output = R>>(
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    integrand: impl Fn(&Vector3<f64>) -> R,
) -> R {
    let corners = Matrix3x4::from_columns(&element.map(|vertex| V[vertex]));
    let middle = corners * Vector4::repeat(0.25);
    integrand(&middle) * volume
}
