use nalgebra::{DVector, Vector3};

/// Kinetic energy without a matrix: ∫ φ_a φ_b adds the squares of the velocities and the square of their sum.
pub fn T_linear_tetrahedron(qdot: &DVector<f64>, element: &[usize; 4], density: f64, volume: f64) -> f64 {
    let velocities = element.map(|vertex| Vector3::from_iterator(qdot.iter().skip(3 * vertex).take(3).copied()));
    let of_each: f64 = velocities.iter().map(|v| v.norm_squared()).sum();
    let of_all = velocities.iter().fold(Vector3::zeros(), |sum, v| sum + v).norm_squared();
    density * volume * (of_each + of_all) / 40.0
}
