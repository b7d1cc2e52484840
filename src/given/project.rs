use std::f64::consts::FRAC_1_SQRT_2;

use nalgebra::SMatrix;

use super::eigen::visit_negative;

/// An eigenvalue counts as negative below this part of the largest one; values nearer to zero are round-off.
const TOLERANCE: f64 = 1e-14;

/// The positive semi-definite matrix nearest to a symmetric one (in the Frobenius norm): negative eigenvalues become zero,
/// zeros and positives stay.
///
/// `H  (12×12)` symmetric, any unit; returned unchanged if it has no negative eigenvalue or is not finite.
pub fn project(H: &SMatrix<f64, 12, 12>) -> SMatrix<f64, 12, 12> {
    let mut projected = *H;
    match without_translations(H) {
        Some(rows) => visit_negative(&rows, TOLERANCE, |eigenvalue, vector| {
            raise(&mut projected, eigenvalue, &with_translations(vector));
        }),
        None => {
            let rows = std::array::from_fn(|i| std::array::from_fn(|j| H[(i, j)]));
            visit_negative(&rows, TOLERANCE, |eigenvalue, vector| raise(&mut projected, eigenvalue, vector));
        }
    }
    projected
}

/// Raises an eigenvalue to zero: `H − λ v vᵀ`.
fn raise(H: &mut SMatrix<f64, 12, 12>, eigenvalue: f64, vector: &[f64; 12]) {
    for j in 0..12 {
        let factor = eigenvalue * vector[j];
        for i in 0..12 {
            H[(i, j)] -= vector[i] * factor;
        }
    }
}

/// Largest force of a translation, relative to the largest stiffness, that counts as zero.
const NO_FORCE: f64 = 1e-14;

/// H in a basis without the three translations, if they lie in its null space (as for any element): nine rows take half the
/// time of twelve.
///
/// The basis is (x0 − x1)/√2, (x2 − x3)/√2 and (x0 + x1 − x2 − x3)/2; it is orthonormal, so eigenvalues are the same.
fn without_translations(H: &SMatrix<f64, 12, 12>) -> Option<[[f64; 9]; 9]> {
    let stiffest = (0..12).fold(0.0, |stiffest: f64, i| stiffest.max(H[(i, i)].abs()));
    let mut columns = [[0.0; 12]; 9];
    let mut force = 0.0_f64;
    for j in 0..3 {
        for i in 0..12 {
            let (h0, h1, h2, h3) = (H[(i, j)], H[(i, j + 3)], H[(i, j + 6)], H[(i, j + 9)]);
            columns[j][i] = (h0 - h1) * FRAC_1_SQRT_2;
            columns[j + 3][i] = (h2 - h3) * FRAC_1_SQRT_2;
            columns[j + 6][i] = (h0 + h1 - h2 - h3) * 0.5;
            force = force.max((h0 + h1 + h2 + h3).abs());
        }
    }
    let rows = columns.map(|h| {
        let mut row = [0.0; 9];
        for i in 0..3 {
            row[i] = (h[i] - h[i + 3]) * FRAC_1_SQRT_2;
            row[i + 3] = (h[i + 6] - h[i + 9]) * FRAC_1_SQRT_2;
            row[i + 6] = (h[i] + h[i + 3] - h[i + 6] - h[i + 9]) * 0.5;
        }
        row
    });
    (force <= NO_FORCE * stiffest).then_some(rows)
}

/// Transforms a vector back from the basis of [`without_translations`].
fn with_translations(v: &[f64; 9]) -> [f64; 12] {
    let mut x = [0.0; 12];
    for i in 0..3 {
        let (front, back, between) = (v[i] * FRAC_1_SQRT_2, v[i + 3] * FRAC_1_SQRT_2, v[i + 6] * 0.5);
        x[i] = between + front;
        x[i + 3] = between - front;
        x[i + 6] = back - between;
        x[i + 9] = -back - between;
    }
    x
}
