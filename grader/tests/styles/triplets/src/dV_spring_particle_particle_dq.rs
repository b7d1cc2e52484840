use nalgebra::{SVector, Vector3};

/// The unit vector along the spring, and zero where there is none.
pub fn dV_spring_particle_particle_dq(
    q0: &Vector3<f64>,
    q1: &Vector3<f64>,
    l0: f64,
    stiffness: f64,
) -> SVector<f64, 6> {
    let apart = q1 - q0;
    let length = apart.norm();
    let mut gradient = SVector::<f64, 6>::zeros();
    if l0 == 0.0 {
        gradient.fixed_rows_mut::<3>(3).copy_from(&(apart * stiffness));
    } else if length > 0.0 {
        gradient.fixed_rows_mut::<3>(3).copy_from(&(apart / length * ((length - l0) * stiffness)));
    }
    let other_end = -gradient.fixed_rows::<3>(3).into_owned();
    gradient.fixed_rows_mut::<3>(0).copy_from(&other_end);
    gradient
}
