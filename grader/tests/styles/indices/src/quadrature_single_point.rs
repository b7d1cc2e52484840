use std::ops::Mul;

use nalgebra::Vector3;

/// The mean of the vertices, axis by axis.
pub fn quadrature_single_point<R: Mul<f64, Output = R>>(
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    integrand: impl Fn(&Vector3<f64>) -> R,
) -> R {
    let mut middle = Vector3::zeros();
    for axis in 0..3 {
        for i in 0..4 {
            middle[axis] += 0.25 * V[element[i]][axis];
        }
    }
    integrand(&middle) * volume
}
