use nalgebra::{DVector, Vector3};
use nalgebra_sparse::CsrMatrix;

/// Rows as lists that grow, then the three arrays of compressed rows.
pub fn assemble_stiffness(
    q: &DVector<f64>,
    V: &[Vector3<f64>],
    T: &[[usize; 4]],
    v0: &[f64],
    C: f64,
    D: f64,
) -> CsrMatrix<f64> {
    let n = q.len();
    let mut rows: Vec<Vec<(usize, f64)>> = vec![Vec::new(); n];
    for e in 0..T.len() {
        let H = crate::given::project(&crate::d2V_linear_tetrahedron_dq2(q, V, &T[e], v0[e], C, D));
        for i in 0..12 {
            let row = &mut rows[3 * T[e][i / 3] + i % 3];
            for j in 0..12 {
                let column = 3 * T[e][j / 3] + j % 3;
                let mut place = 0;
                while place < row.len() && row[place].0 < column {
                    place += 1;
                }
                if place == row.len() || row[place].0 != column {
                    row.insert(place, (column, 0.0));
                }
                row[place].1 -= H[(i, j)];
            }
        }
    }
    let (mut offsets, mut indices, mut values) = (vec![0], Vec::new(), Vec::new());
    for row in 0..n {
        for k in 0..rows[row].len() {
            indices.push(rows[row][k].0);
            values.push(rows[row][k].1);
        }
        offsets.push(indices.len());
    }
    CsrMatrix::try_from_csr_data(n, n, offsets, indices, values).unwrap()
}
