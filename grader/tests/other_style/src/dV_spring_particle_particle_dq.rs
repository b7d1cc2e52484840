use nalgebra::{SVector, Vector3};

/// Gradient of a spring's energy; the spring of no length has none.
pub fn dV_spring_particle_particle_dq(
    q0: &Vector3<f64>,
    q1: &Vector3<f64>,
    l0: f64,
    stiffness: f64,
) -> SVector<f64, 6> {
    let between = q0 - q1;
    // Without a length there is no direction, and with no rest length there need be none.
    let direction = between.try_normalize(0.0).unwrap_or_default();
    let pull = stiffness * (between - l0 * direction);
    let mut gradient = SVector::<f64, 6>::zeros();
    gradient.fixed_rows_mut::<3>(0).copy_from(&pull);
    gradient.fixed_rows_mut::<3>(3).copy_from(&-pull);
    gradient
}
