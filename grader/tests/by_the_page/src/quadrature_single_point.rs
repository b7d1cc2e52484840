use std::ops::Mul;

use nalgebra::Vector3;

/// The value at the centroid times the volume.
pub fn quadrature_single_point<R: Mul<f64, Output = R>>(
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    integrand: impl Fn(&Vector3<f64>) -> R,
) -> R {
    let sum = V[element[0]] + V[element[1]] + V[element[2]] + V[element[3]];
    integrand(&(sum / 4.0)) * volume
}
