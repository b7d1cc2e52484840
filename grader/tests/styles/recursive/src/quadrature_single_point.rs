use std::ops::Mul;

use nalgebra::Vector3;

/// The centroid of a triangle and a vertex, one quarter of the way.
pub fn quadrature_single_point<R: Mul<f64, Output = R>>(
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    integrand: impl Fn(&Vector3<f64>) -> R,
) -> R {
    fn centroid(points: &[Vector3<f64>]) -> Vector3<f64> {
        match points {
            [] => Vector3::zeros(),
            [last, rest @ ..] => (last + centroid(rest) * rest.len() as f64) / points.len() as f64,
        }
    }
    integrand(&centroid(&element.map(|vertex| V[vertex]))) * volume
}
