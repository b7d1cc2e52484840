use nalgebra::{DVector, Vector3};

/// Kinetic energy of one element, J.
pub fn T_linear_tetrahedron(qdot: &DVector<f64>, element: &[usize; 4], density: f64, volume: f64) -> f64 {
    let v = element.map(|vertex| Vector3::new(qdot[3 * vertex], qdot[3 * vertex + 1], qdot[3 * vertex + 2]));

    // ∫ φ_a φ_b = volume (1 + δ_ab) / 20, so ∫ |v|² is the sum of all v_a · v_b and once more those with a = b.
    let sum: Vector3<f64> = v.iter().sum();
    let squares: f64 = v.iter().map(Vector3::norm_squared).sum();
    0.5 * density * volume / 20.0 * (sum.norm_squared() + squares)
}
