use nalgebra::{Vector3, Vector4};

/// Gaussian elimination that calls itself for the smaller system.
pub fn phi_linear_tetrahedron(V: &[Vector3<f64>], element: &[usize; 4], x: &Vector3<f64>) -> Vector4<f64> {
    let corners = element.map(|vertex| V[vertex]);
    let size = (corners[1] - corners[0]).norm();
    let row = |axis: usize| [0, 1, 2, 3].map(|i| (corners[i][axis] - x[axis]) / size).to_vec();
    let weights = eliminated(vec![row(0), row(1), row(2), vec![1.0; 4]], vec![0.0, 0.0, 0.0, 1.0]);
    Vector4::from_vec(weights)
}

/// The solution of A x = b, with the largest pivot of the first column.
fn eliminated(mut A: Vec<Vec<f64>>, mut b: Vec<f64>) -> Vec<f64> {
    if b.is_empty() {
        return b;
    }
    let pivot = (0..b.len()).max_by(|&i, &j| A[i][0].abs().total_cmp(&A[j][0].abs())).unwrap_or(0);
    let (first, right) = (A.swap_remove(pivot), b.swap_remove(pivot));
    for (row, entry) in A.iter_mut().zip(b.iter_mut()) {
        let factor = row.remove(0) / first[0];
        row.iter_mut().zip(&first[1..]).for_each(|(a, p)| *a -= factor * p);
        *entry -= factor * right;
    }
    let mut x = eliminated(A, b);
    let known: f64 = x.iter().zip(&first[1..]).map(|(x, a)| x * a).sum();
    x.insert(0, (right - known) / first[0]);
    x
}
