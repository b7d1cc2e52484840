use nalgebra::{DVector, Vector3};

/// Adds segments to a vector.
pub fn assemble_forces(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> DVector<f64> {
    let mut gradient = DVector::<f64>::zeros(q.len());
    for (element, &volume) in T.iter().zip(v0) {
        let own = crate::dV_linear_tetrahedron_dq(q, V, element, volume, C, D);
        for i in 0..4 {
            let mut segment = gradient.fixed_rows_mut::<3>(3 * element[i]);
            segment += own.fixed_rows::<3>(3 * i);
        }
    }
    -gradient
}
