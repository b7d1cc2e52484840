use nalgebra::{DVector, Vector3};

use crate::dV_linear_tetrahedron_dq;

/// Elastic forces, the last element first.
pub fn assemble_forces(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> DVector<f64> {
    (0..T.len()).rev().fold(DVector::zeros(q.len()), |mut forces, index| {
        let gradient = dV_linear_tetrahedron_dq(q, V, &T[index], v0[index], C, D);
        for (local, vertex) in T[index].into_iter().enumerate() {
            let mut force = forces.fixed_rows_mut::<3>(3 * vertex);
            force -= gradient.fixed_rows::<3>(3 * local);
        }
        forces
    })
}
