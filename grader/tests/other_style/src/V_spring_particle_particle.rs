use nalgebra::Vector3;

/// Energy of a spring: half its tension times its elongation.
pub fn V_spring_particle_particle(q0: &Vector3<f64>, q1: &Vector3<f64>, l0: f64, stiffness: f64) -> f64 {
    let length = nalgebra::distance(&(*q0).into(), &(*q1).into());
    let tension = stiffness * (length - l0);
    tension * (length - l0) / 2.0
}
