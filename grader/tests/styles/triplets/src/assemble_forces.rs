use nalgebra::{DVector, Vector3};

/// A list of entries, added up in the end, in the opposite order of the elements.
pub fn assemble_forces(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> DVector<f64> {
    let mut entries = Vec::new();
    for (element, volume) in T.iter().zip(v0).rev() {
        let gradient = crate::dV_linear_tetrahedron_dq(q, V, element, *volume, C, D);
        entries.extend((0..12).map(|local| (3 * element[local / 3] + local % 3, -gradient[local])));
    }
    entries.sort_by_key(|(row, _)| *row);
    let mut f = DVector::zeros(q.len());
    entries.into_iter().for_each(|(row, value)| f[row] += value);
    f
}
