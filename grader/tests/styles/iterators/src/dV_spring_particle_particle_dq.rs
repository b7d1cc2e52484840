use nalgebra::{SVector, Vector3};

/// The tension along the spring, at both ends.
pub fn dV_spring_particle_particle_dq(
    q0: &Vector3<f64>,
    q1: &Vector3<f64>,
    l0: f64,
    stiffness: f64,
) -> SVector<f64, 6> {
    let apart = q1 - q0;
    let tension = match apart.norm() {
        _ if l0 == 0.0 => apart * stiffness,
        0.0 => apart,
        length => apart * (stiffness * (1.0 - l0 / length)),
    };
    SVector::from_iterator(tension.iter().map(|t| -t).chain(tension.iter().copied()))
}
