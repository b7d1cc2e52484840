use nalgebra::Vector3;

/// Hooke's law.
pub fn V_spring_particle_particle(q0: &Vector3<f64>, q1: &Vector3<f64>, l0: f64, stiffness: f64) -> f64 {
    let longer = (q1 - q0).norm() - l0;
    (longer * longer) * stiffness * 0.5
}
