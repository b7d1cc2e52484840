//! Linear algebra for the process that judges. It is in this crate because builds for development optimise this one: without that,
//! eigenvalues alone take a third of the time of the checks. No submission needs it.

use nalgebra::{Const, DMatrix, DVector, Matrix3, SMatrix, SVector, SymmetricEigen};
use nalgebra_sparse::CsrMatrix;

/// The smallest singular value.
pub fn smallest_singular_value(F: &Matrix3<f64>) -> f64 {
    F.singular_values().min()
}

/// Eigenvalues and eigenvectors of an element's symmetric matrix, which must be finite.
pub fn eigen(H: &SMatrix<f64, 12, 12>) -> SymmetricEigen<f64, Const<12>> {
    H.symmetric_eigen()
}

/// Eigenvalues of a symmetric matrix; `None` where this number of iterations does not find them.
pub fn eigenvalues(matrix: DMatrix<f64>, most: usize) -> Option<DVector<f64>> {
    SymmetricEigen::try_new(matrix, f64::EPSILON, most).map(|eigen| eigen.eigenvalues)
}

/// Gaussian elimination with pivots; `None` where the matrix is singular.
pub fn by_elimination(A: &CsrMatrix<f64>, b: &DVector<f64>) -> Option<DVector<f64>> {
    DMatrix::from(A).lu().solve(b)
}

/// Eigenvalues of an element's symmetric matrix, which must be finite.
pub fn eigenvalues_of_element(H: &SMatrix<f64, 12, 12>) -> SVector<f64, 12> {
    H.symmetric_eigenvalues()
}

/// Small beside the ones on the diagonal, and no smaller than their round-off.
const SMALL: f64 = 1e-14;

/// The x with the smallest |A x − b|; a coefficient that belongs to a column of zeros is zero.
pub fn least_squares(A: &DMatrix<f64>, b: &DVector<f64>) -> Option<DVector<f64>> {
    // Columns of the same length, so that small ones are not lost.
    let n = A.ncols();
    let lengths: Vec<f64> = A.column_iter().map(|column| column.norm().max(f64::MIN_POSITIVE)).collect();
    let scaled = DMatrix::from_fn(A.nrows(), n, |i, j| A[(i, j)] / lengths[j]);
    // A column of zeros has no coefficient, which must not spoil those of the others.
    let normal = scaled.transpose() * &scaled + DMatrix::identity(n, n) * SMALL;
    let x = normal.cholesky()?.solve(&(scaled.transpose() * b));
    Some(DVector::from_fn(n, |j, _| x[j] / lengths[j]))
}

/// The largest entry of |A x − b|.
pub fn misfit(A: &DMatrix<f64>, x: &DVector<f64>, b: &DVector<f64>) -> f64 {
    (A * x - b).amax()
}
