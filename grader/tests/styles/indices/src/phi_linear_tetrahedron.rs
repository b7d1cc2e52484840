use nalgebra::{Vector3, Vector4};

/// Cramer's rule: each column in turn is replaced by the right-hand side.
pub fn phi_linear_tetrahedron(V: &[Vector3<f64>], element: &[usize; 4], x: &Vector3<f64>) -> Vector4<f64> {
    let mut edges = [[0.0; 3]; 3];
    let mut right = [0.0; 3];
    for row in 0..3 {
        for column in 0..3 {
            edges[row][column] = V[element[column + 1]][row] - V[element[0]][row];
        }
        right[row] = x[row] - V[element[0]][row];
    }
    let whole = determinant(&edges);
    let mut phi = Vector4::zeros();
    phi[0] = 1.0;
    for column in 0..3 {
        let mut replaced = edges;
        for row in 0..3 {
            replaced[row][column] = right[row];
        }
        phi[column + 1] = determinant(&replaced) / whole;
        phi[0] -= phi[column + 1];
    }
    phi
}

fn determinant(a: &[[f64; 3]; 3]) -> f64 {
    a[0][0] * (a[1][1] * a[2][2] - a[1][2] * a[2][1]) - a[0][1] * (a[1][0] * a[2][2] - a[1][2] * a[2][0])
        + a[0][2] * (a[1][0] * a[2][1] - a[1][1] * a[2][0])
}
