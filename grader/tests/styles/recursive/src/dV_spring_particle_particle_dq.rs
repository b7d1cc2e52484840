use nalgebra::{SVector, Vector3};

/// The second half is that of the spring with its ends exchanged.
pub fn dV_spring_particle_particle_dq(
    q0: &Vector3<f64>,
    q1: &Vector3<f64>,
    l0: f64,
    stiffness: f64,
) -> SVector<f64, 6> {
    let first = at_first_end(q0, q1, l0, stiffness);
    let second = at_first_end(q1, q0, l0, stiffness);
    SVector::from_fn(|k, _| if k < 3 { first[k] } else { second[k - 3] })
}

fn at_first_end(own: &Vector3<f64>, other: &Vector3<f64>, l0: f64, stiffness: f64) -> Vector3<f64> {
    let apart = own - other;
    if l0 == 0.0 {
        return stiffness * apart;
    }
    apart.try_normalize(0.0).map_or(Vector3::zeros(), |direction| stiffness * (apart.norm() - l0) * direction)
}
