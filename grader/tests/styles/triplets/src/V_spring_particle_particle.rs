use nalgebra::Vector3;

/// The square of the elongation, multiplied out.
pub fn V_spring_particle_particle(q0: &Vector3<f64>, q1: &Vector3<f64>, l0: f64, stiffness: f64) -> f64 {
    let length = nalgebra::distance(&(*q0).into(), &(*q1).into());
    0.5 * stiffness * (length - l0) * (length - l0)
}
