//! Factorisations of sparse symmetric matrices.

mod csc;
mod faer_cholesky;
mod ldlt;
mod lu;
mod single;
mod supernodal;

#[cfg(test)]
mod tests;

pub(crate) use faer_cholesky::FaerCholesky;
pub(crate) use ldlt::Ldlt;
pub(crate) use lu::Lu;
pub(crate) use supernodal::SupernodalCholesky;

use std::sync::Arc;

use super::ApproximateInverse;
use fem_elements::Real;
use fem_elements::sparse::Pattern;
use single::SingleCholesky;

/// Up to this many rows [`SupernodalCholesky`] is faster. On beams of 8 000 rows faer with two threads takes the same time.
const ROWS_FOR_ONE_THREAD: usize = 5_000;

/// The Cholesky factorisation that suits the size of the matrix; `pattern` stores the lower half.
pub(super) fn cholesky<T: Real>(pattern: &Pattern) -> Box<dyn ApproximateInverse<T>> {
    if pattern.rows() <= ROWS_FOR_ONE_THREAD {
        Box::new(SupernodalCholesky::new(pattern))
    } else {
        Box::new(FaerCholesky::new(pattern))
    }
}

/// The same for directions of an iteration, which need a few digits only: in single precision where the matrix allows it.
pub(super) fn cholesky_for_directions<T: Real>(pattern: &Arc<Pattern>) -> Box<dyn ApproximateInverse<T>> {
    if size_of::<T>() > size_of::<f32>() { Box::new(SingleCholesky::new(pattern)) } else { cholesky(pattern) }
}
