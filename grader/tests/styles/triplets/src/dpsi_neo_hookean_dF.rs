use nalgebra::{Matrix3, SVector};

/// The two terms one after the other, each added where it belongs.
pub fn dpsi_neo_hookean_dF(F: &Matrix3<f64>, C: f64, D: f64) -> SVector<f64, 9> {
    let J = F.determinant();
    let cofactors = F.adjugate();
    let mut P = SVector::zeros();
    for (i, j) in pairs() {
        P[3 * i + j] += 2.0 * C * J.powf(-2.0 / 3.0) * F[(i, j)];
        P[3 * i + j] += -2.0 / 3.0 * C * F.norm_squared() * J.powf(-5.0 / 3.0) * cofactors[(j, i)];
        P[3 * i + j] += 2.0 * D * (J - 1.0) * cofactors[(j, i)];
    }
    P
}

fn pairs() -> impl Iterator<Item = (usize, usize)> {
    (0..9).map(|k| (k / 3, k % 3))
}

trait Adjugate {
    fn adjugate(&self) -> Matrix3<f64>;
}

impl Adjugate for Matrix3<f64> {
    /// The transpose of the cofactors.
    fn adjugate(&self) -> Matrix3<f64> {
        let [a, b, c] = [0, 1, 2].map(|row| self.row(row).transpose());
        Matrix3::from_columns(&[b.cross(&c), c.cross(&a), a.cross(&b)])
    }
}
