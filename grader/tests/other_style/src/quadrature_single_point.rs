use std::ops::Mul;

use nalgebra::Vector3;

/// One point, a quarter of each vertex.
pub fn quadrature_single_point<R: Mul<f64, Output = R>>(
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    integrand: impl Fn(&Vector3<f64>) -> R,
) -> R {
    let mut middle = Vector3::zeros();
    for &vertex in element {
        middle += 0.25 * V[vertex];
    }
    integrand(&middle) * volume
}
