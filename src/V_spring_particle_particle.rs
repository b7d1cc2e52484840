use nalgebra::Vector3;

/// Energy of a spring between two particles, J.
pub fn V_spring_particle_particle(q0: &Vector3<f64>, q1: &Vector3<f64>, l0: f64, stiffness: f64) -> f64 {
    let stretch = (q1 - q0).norm() - l0;
    0.5 * stiffness * stretch * stretch
}
