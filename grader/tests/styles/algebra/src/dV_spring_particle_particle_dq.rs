use nalgebra::{SVector, Vector3};

/// The tension along the spring.
pub fn dV_spring_particle_particle_dq(
    q0: &Vector3<f64>,
    q1: &Vector3<f64>,
    l0: f64,
    stiffness: f64,
) -> SVector<f64, 6> {
    let apart = q1 - q0;
    let pull = if l0 == 0.0 { stiffness * apart } else { stiffness * (apart.norm() - l0) * unit(&apart) };
    SVector::from_iterator((-pull).iter().chain(pull.iter()).copied())
}

/// The direction of a vector; zero for the zero vector.
fn unit(vector: &Vector3<f64>) -> Vector3<f64> {
    let length = vector.norm();
    if length == 0.0 { *vector } else { vector / length }
}
