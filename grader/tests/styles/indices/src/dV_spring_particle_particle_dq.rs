use nalgebra::{SVector, Vector3};

/// Both ends at once, with opposite signs.
pub fn dV_spring_particle_particle_dq(
    q0: &Vector3<f64>,
    q1: &Vector3<f64>,
    l0: f64,
    stiffness: f64,
) -> SVector<f64, 6> {
    let length = (q1 - q0).norm();
    let mut gradient = SVector::zeros();
    for axis in 0..3 {
        let apart = q1[axis] - q0[axis];
        let pull = if l0 == 0.0 {
            stiffness * apart
        } else if length == 0.0 {
            0.0
        } else {
            stiffness * (length - l0) * (apart / length)
        };
        gradient[axis] = -pull;
        gradient[axis + 3] = pull;
    }
    gradient
}
