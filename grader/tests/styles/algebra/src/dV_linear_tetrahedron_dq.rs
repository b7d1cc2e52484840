use nalgebra::{DVector, Matrix3, SMatrix, SVector, Vector3};

/// All four vectors at once, as the columns of a matrix.
pub fn dV_linear_tetrahedron_dq(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SVector<f64, 12> {
    let dphi = crate::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
    let mut positions = SMatrix::<f64, 3, 4>::from_fn(|axis, i| q[3 * element[i] + axis]);
    let mean = positions.column_mean();
    positions.column_iter_mut().for_each(|mut position| position -= mean);
    let P = Matrix3::from_row_slice(crate::dpsi_neo_hookean_dF(&(positions * dphi), C, D).as_slice());
    let forces = P * dphi.transpose() * volume;
    SVector::from_column_slice(forces.as_slice())
}
