use nalgebra::{DVector, Vector3};
use nalgebra_sparse::{CooMatrix, CsrMatrix};

use crate::d2V_linear_tetrahedron_dq2;
use crate::given::project;

/// Stiffness of the mesh from triplets of projected elements.
pub fn assemble_stiffness(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> CsrMatrix<f64> {
    let (mut rows, mut columns, mut values) = (Vec::new(), Vec::new(), Vec::new());
    for (element, volume) in T.iter().zip(v0) {
        let of_element = -project(&d2V_linear_tetrahedron_dq2(q, V, element, *volume, C, D));
        let places: Vec<usize> = element.iter().flat_map(|vertex| (0..3).map(move |axis| 3 * vertex + axis)).collect();
        for (column, of_column) in of_element.column_iter().enumerate() {
            rows.extend_from_slice(&places);
            columns.extend([places[column]; 12]);
            values.extend(of_column.iter().copied());
        }
    }
    let triplets = CooMatrix::try_from_triplets(q.len(), q.len(), rows, columns, values).expect("indices in range");
    CsrMatrix::from(&triplets)
}
