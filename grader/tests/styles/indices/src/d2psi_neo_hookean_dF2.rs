use nalgebra::{Matrix3, SMatrix};

/// Four nested loops and the permutation symbol.
pub fn d2psi_neo_hookean_dF2(F: &Matrix3<f64>, C: f64, D: f64) -> SMatrix<f64, 9, 9> {
    let J = F.determinant();
    let mut I = 0.0;
    let mut c = [[0.0; 3]; 3];
    for i in 0..3 {
        for j in 0..3 {
            I += F[(i, j)] * F[(i, j)];
            let (i1, i2, j1, j2) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
            c[i][j] = F[(i1, j1)] * F[(i2, j2)] - F[(i1, j2)] * F[(i2, j1)];
        }
    }
    let psi_I = C * J.powf(-2.0 / 3.0);
    let psi_J = -2.0 / 3.0 * C * I * J.powf(-5.0 / 3.0) + 2.0 * D * (J - 1.0);
    let psi_IJ = -2.0 / 3.0 * C * J.powf(-5.0 / 3.0);
    let psi_JJ = 10.0 / 9.0 * C * I * J.powf(-8.0 / 3.0) + 2.0 * D;
    let mut H = SMatrix::zeros();
    for i in 0..3 {
        for j in 0..3 {
            for k in 0..3 {
                for l in 0..3 {
                    let mut curvature = 0.0;
                    for m in 0..3 {
                        for n in 0..3 {
                            curvature += permutation(i, k, m) * permutation(j, l, n) * F[(m, n)];
                        }
                    }
                    let mut entry = psi_J * curvature;
                    if i == k && j == l {
                        entry += 2.0 * psi_I;
                    }
                    entry += 2.0 * psi_IJ * (F[(i, j)] * c[k][l] + c[i][j] * F[(k, l)]);
                    entry += psi_JJ * c[i][j] * c[k][l];
                    H[(3 * i + j, 3 * k + l)] = entry;
                }
            }
        }
    }
    H
}

/// 1 for even orders of 0, 1, 2, −1 for odd ones, 0 where an index repeats.
fn permutation(a: usize, b: usize, c: usize) -> f64 {
    let (a, b, c) = (a as f64, b as f64, c as f64);
    (b - a) * (c - b) * (c - a) / 2.0
}
