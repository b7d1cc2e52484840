use nalgebra::{DVector, Matrix3, SMatrix, SVector, Vector3};

/// Column by column: how the gradient changes as one coordinate moves.
pub fn d2V_linear_tetrahedron_dq2(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    element: &[usize; 4],
    volume: f64,
    C: f64,
    D: f64,
) -> SMatrix<f64, 12, 12> {
    let dphi = crate::dphi_linear_tetrahedron_dX(V, element, &V[element[0]]);
    let mut positions = SMatrix::<f64, 3, 4>::from_fn(|axis, i| q[3 * element[i] + axis]);
    let mean = positions.column_mean();
    positions.column_iter_mut().for_each(|mut position| position -= mean);
    let material = crate::d2psi_neo_hookean_dF2(&(positions * dphi), C, D) * volume;
    let column = |moved: usize| {
        let mut change = SVector::<f64, 9>::zeros();
        change.fixed_rows_mut::<3>(3 * (moved % 3)).copy_from(&dphi.row(moved / 3).transpose());
        let P = Matrix3::from_row_slice((material * change).as_slice());
        SVector::<f64, 12>::from_column_slice((P * dphi.transpose()).as_slice())
    };
    let columns: Vec<_> = (0..12).map(column).collect();
    SMatrix::from_columns(&columns)
}
