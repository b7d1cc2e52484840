use nalgebra::{SVector, Vector3};

/// Gradient of a spring's energy, N: first with respect to `q0`, then to `q1`.
pub fn dV_spring_particle_particle_dq(
    q0: &Vector3<f64>,
    q1: &Vector3<f64>,
    l0: f64,
    stiffness: f64,
) -> SVector<f64, 6> {
    let d = q1 - q0;
    let length = d.norm();
    // A spring of zero length has no direction; the mean over all directions is zero.
    let direction = if length > 0.0 { d / length } else { Vector3::zeros() };

    let on_q1 = (d - direction * l0) * stiffness;
    SVector::<f64, 6>::from_fn(|row, _| if row < 3 { -on_q1[row] } else { on_q1[row - 3] })
}
