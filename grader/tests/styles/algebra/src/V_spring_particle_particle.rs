use nalgebra::Vector3;

/// Hooke's law.
pub fn V_spring_particle_particle(q0: &Vector3<f64>, q1: &Vector3<f64>, l0: f64, stiffness: f64) -> f64 {
    (q1.metric_distance(q0) - l0).powi(2) * stiffness / 2.0
}
