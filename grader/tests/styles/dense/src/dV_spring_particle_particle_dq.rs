use nalgebra::{SMatrix, SVector, Vector3};

/// A matrix of plus and minus one, times the tension.
pub fn dV_spring_particle_particle_dq(
    q0: &Vector3<f64>,
    q1: &Vector3<f64>,
    l0: f64,
    stiffness: f64,
) -> SVector<f64, 6> {
    let apart = q1 - q0;
    let direction = apart.try_normalize(0.0).unwrap_or_else(Vector3::zeros);
    let tension = if l0 == 0.0 { apart * stiffness } else { direction * (stiffness * (apart.norm() - l0)) };
    let ends = SMatrix::<f64, 2, 1>::new(-1.0, 1.0);
    let both = ends.kronecker(&tension);
    SVector::from_column_slice(both.as_slice())
}
