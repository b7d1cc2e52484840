use std::ops::Mul;

use nalgebra::Vector3;

/// Integral over an undeformed element by its value at the centroid times the volume.
pub fn quadrature_single_point<R: Mul<f64, Output = R>>(
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    integrand: impl Fn(&Vector3<f64>) -> R,
) -> R {
    let centroid = element.iter().map(|&vertex| V[vertex]).sum::<Vector3<f64>>() / 4.0;
    integrand(&centroid) * volume
}
