use nalgebra::{Matrix3, SVector};

/// With the inverse transpose.
pub fn dpsi_neo_hookean_dF(F: &Matrix3<f64>, C: f64, D: f64) -> SVector<f64, 9> {
    let J = F.determinant();
    let turned = F.try_inverse().expect("J > 0").transpose();
    let shape = (F - turned * (F.norm_squared() / 3.0)) * (2.0 * C * J.powf(-2.0 / 3.0));
    let P = shape + turned * (2.0 * D * J * (J - 1.0));
    SVector::<f64, 9>::from_column_slice(P.transpose().as_slice())
}
