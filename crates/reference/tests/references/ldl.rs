//! The factor that references solve with.

use fem_reference::time::Ldl;

/// A grid's Laplacian plus a mass.
fn grid(n: usize) -> Vec<Vec<(usize, f64)>> {
    let column = |k: usize| {
        let (i, j) = (k % n, k / n);
        let mut entries = vec![(k, 4.5 + 0.1 * k as f64)];
        if i > 0 {
            entries.push((k - 1, -1.0));
        }
        if j > 0 {
            entries.push((k - n, -1.25));
        }
        entries
    };
    (0..n * n).map(column).collect()
}

#[test]
fn a_solution_fulfils_its_equations() {
    let (n, matrix) = (49, grid(7));
    let b: Vec<[f64; 2]> = (0..n).map(|i| [(i as f64).sin(), 1.0 + i as f64]).collect();
    let mut x = b.clone();
    Ldl::new(&matrix).unwrap().solve(&mut x);
    let mut product = vec![[0.0; 2]; n];
    for (k, column) in matrix.iter().enumerate() {
        for &(i, value) in column {
            for c in 0..2 {
                product[i][c] += value * x[k][c];
                if i != k {
                    product[k][c] += value * x[i][c];
                }
            }
        }
    }
    for (product, b) in product.iter().zip(&b) {
        assert!((0..2).all(|c| (product[c] - b[c]).abs() < 1e-12), "{product:?} {b:?}");
    }
}

#[test]
fn a_matrix_that_is_not_positive_definite_is_refused() {
    assert!(Ldl::new(&[vec![(0, 1.0)], vec![(0, 2.0), (1, 1.0)]]).is_none());
    assert!(Ldl::new(&[vec![(0, f64::NAN)]]).is_none());
}
