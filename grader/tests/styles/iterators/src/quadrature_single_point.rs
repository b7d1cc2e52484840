use std::ops::Mul;

use nalgebra::Vector3;

/// The value in the middle times the volume.
pub fn quadrature_single_point<R: Mul<f64, Output = R>>(
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    integrand: impl Fn(&Vector3<f64>) -> R,
) -> R {
    integrand(&(element.iter().map(|&vertex| V[vertex]).sum::<Vector3<f64>>() / 4.0)) * volume
}
