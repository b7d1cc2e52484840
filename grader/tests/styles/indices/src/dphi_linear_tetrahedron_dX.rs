use nalgebra::{Matrix4x3, Vector3};

/// The inverse of the edges by cofactors, entry by entry.
pub fn dphi_linear_tetrahedron_dX(V: &[Vector3<f64>], element: &[usize; 4], X: &Vector3<f64>) -> Matrix4x3<f64> {
    let _ = X;
    let mut edges = [[0.0; 3]; 3];
    for row in 0..3 {
        for column in 0..3 {
            edges[row][column] = V[element[column + 1]][row] - V[element[0]][row];
        }
    }
    let mut determinant = 0.0;
    for k in 0..3 {
        determinant += edges[0][k] * cofactor(&edges, 0, k);
    }
    let mut dphi = Matrix4x3::zeros();
    for i in 0..3 {
        for j in 0..3 {
            let entry = cofactor(&edges, j, i) / determinant;
            dphi[(i + 1, j)] = entry;
            dphi[(0, j)] -= entry;
        }
    }
    dphi
}

fn cofactor(a: &[[f64; 3]; 3], row: usize, column: usize) -> f64 {
    let (r1, r2) = ((row + 1) % 3, (row + 2) % 3);
    let (c1, c2) = ((column + 1) % 3, (column + 2) % 3);
    a[r1][c1] * a[r2][c2] - a[r1][c2] * a[r2][c1]
}
