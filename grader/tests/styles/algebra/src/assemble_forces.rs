use nalgebra::{DVector, Vector3};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

/// The transpose of a sparse selection, times all gradients in one long vector.
pub fn assemble_forces(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> DVector<f64> {
    let mut selection = CooMatrix::new(q.len(), 12 * T.len());
    let mut gradients = DVector::zeros(12 * T.len());
    for (e, (element, &volume)) in T.iter().zip(v0).enumerate() {
        let gradient = crate::dV_linear_tetrahedron_dq(q, V, element, volume, C, D);
        for local in 0..12 {
            selection.push(3 * element[local / 3] + local % 3, 12 * e + local, -1.0);
            gradients[12 * e + local] = gradient[local];
        }
    }
    CsrMatrix::from(&selection) * gradients
}
