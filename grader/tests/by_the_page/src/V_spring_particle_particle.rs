use nalgebra::Vector3;

/// ½ k (ℓ − ℓ₀)².
pub fn V_spring_particle_particle(q0: &Vector3<f64>, q1: &Vector3<f64>, l0: f64, stiffness: f64) -> f64 {
    let l = (q1 - q0).norm();
    0.5 * stiffness * (l - l0).powi(2)
}
