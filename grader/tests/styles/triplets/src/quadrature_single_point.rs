use std::ops::Mul;

use nalgebra::Vector3;

/// Half-way between the middles of two opposite edges.
pub fn quadrature_single_point<R: Mul<f64, Output = R>>(
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    integrand: impl Fn(&Vector3<f64>) -> R,
) -> R {
    let [a, b, c, d] = element.map(|vertex| V[vertex]);
    let (one, other): (Vector3<f64>, Vector3<f64>) = ((a + b) / 2.0, (c + d) / 2.0);
    let value: R = integrand(&((one + other) / 2.0));
    Mul::mul(value, volume)
}
