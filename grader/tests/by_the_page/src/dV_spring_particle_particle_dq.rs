use nalgebra::{SVector, Vector3};

/// k (ℓ − ℓ₀) ∂ℓ/∂q; zero at zero length.
pub fn dV_spring_particle_particle_dq(
    q0: &Vector3<f64>,
    q1: &Vector3<f64>,
    l0: f64,
    stiffness: f64,
) -> SVector<f64, 6> {
    let l = (q1 - q0).norm();
    let mut gradient = SVector::zeros();
    if l == 0.0 {
        return gradient;
    }
    let by_q1 = (q1 - q0) / l * (stiffness * (l - l0));
    for k in 0..3 {
        gradient[k] = -by_q1[k];
        gradient[3 + k] = by_q1[k];
    }
    gradient
}
