use nalgebra::Vector3;

/// Hooke's law.
pub fn V_spring_particle_particle(q0: &Vector3<f64>, q1: &Vector3<f64>, l0: f64, stiffness: f64) -> f64 {
    let squares = q0.iter().zip(q1).map(|(a, b)| (b - a).powi(2));
    0.5 * stiffness * (squares.sum::<f64>().sqrt() - l0).powi(2)
}
