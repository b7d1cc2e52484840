use nalgebra::{DVector, Vector3};

/// A fold over the elements.
pub fn assemble_forces(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> DVector<f64> {
    T.iter().zip(v0).fold(DVector::zeros(q.len()), |mut f, (element, &volume)| {
        let gradient = crate::dV_linear_tetrahedron_dq(q, V, element, volume, C, D);
        element.iter().zip(gradient.as_slice().chunks(3)).for_each(|(&vertex, pull)| {
            f.rows_mut(3 * vertex, 3).iter_mut().zip(pull).for_each(|(entry, pull)| *entry -= pull);
        });
        f
    })
}
