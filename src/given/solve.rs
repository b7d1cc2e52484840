use nalgebra::DVector;
use nalgebra_sparse::CsrMatrix;

use super::Cholesky;

/// Solves `A x = b` by sparse Cholesky factorisation; where A is not positive definite, a multiple of the identity is
/// added, ten times more each time, until it is. See [`Solver`] for many systems of the same pattern.
///
/// `A  (n×n)` symmetric, `b  (n)`; returns `x  (n)`, NaN where A or b is not finite or too large to compute with.
pub fn solve(A: &CsrMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
    Solver::default().solve(A, b)
}

/// [`solve`](fn@solve) for a sequence of systems: one symbolic factorisation serves all matrices of the same pattern, and an
/// unchanged matrix is factorised once.
#[derive(Default)]
pub struct Solver {
    cholesky: Option<Cholesky>,
    /// Values of the matrix that was factorised, if there is a factor.
    factored: Option<Vec<f64>>,
    /// Number of symbolic factorisations.
    pub symbolic_factorizations: usize,
    /// Number of numeric factorisations, shifted attempts included.
    pub factorizations: usize,
}

/// First diagonal shift, relative to the largest entry of the diagonal.
const FIRST_SHIFT: f64 = 1e-10;

impl Solver {
    /// Memory of the factor, bytes.
    pub fn bytes(&self) -> usize {
        self.cholesky.as_ref().map_or(0, |cholesky| 8 * cholesky.nnz())
    }

    /// Solves `A x = b`; see [`solve`](fn@solve).
    pub fn solve(&mut self, A: &CsrMatrix<f64>, b: &DVector<f64>) -> DVector<f64> {
        assert_eq!(A.nrows(), b.len(), "a matrix of {} rows, but a right-hand side of {}", A.nrows(), b.len());
        let is_factored = self.factored.as_deref() == Some(A.values());
        // What has been factorised is finite.
        let is_finite = |values: &[f64]| values.iter().all(|value| value.is_finite());
        if !is_finite(b.as_slice()) || !(is_factored || is_finite(A.values())) {
            return DVector::from_element(b.len(), f64::NAN);
        }
        let mut cholesky = match self.cholesky.take() {
            Some(cholesky) if cholesky.fits(A.pattern()) => cholesky,
            _ => {
                self.symbolic_factorizations += 1;
                self.factored = None;
                Cholesky::analyze(A.pattern())
            }
        };
        if self.factored.is_none() || !is_factored {
            self.factor(&mut cholesky, A);
        }
        let cholesky = self.cholesky.insert(cholesky);
        match self.factored {
            Some(_) => cholesky.solve(b),
            None => DVector::from_element(b.len(), f64::NAN),
        }
    }

    fn factor(&mut self, cholesky: &mut Cholesky, A: &CsrMatrix<f64>) {
        let largest = A.values().iter().fold(0.0, |largest: f64, value| value.abs().max(largest));
        let first_shift = FIRST_SHIFT * if largest > 0.0 { largest } else { 1.0 };
        let mut shift = 0.0;
        self.factored = None;
        // A shift above the sum of a row makes any matrix positive definite; past that, numbers are too large to compute with.
        while f64::is_finite(shift) {
            self.factorizations += 1;
            if cholesky.factor(A, shift).is_ok() {
                self.factored = Some(A.values().to_vec());
                return;
            }
            shift = if shift == 0.0 { first_shift } else { 10.0 * shift };
        }
    }
}
