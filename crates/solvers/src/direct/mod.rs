//! Factorisations of sparse matrices.

mod ldlt;
mod reordered;
mod single;
mod supernodal;

pub use ldlt::Ldlt;
pub(crate) use reordered::Reordered;
pub(crate) use supernodal::{Lu, SupernodalCholesky};

use std::sync::Arc;

use super::ApproximateInverse;
use fem_elements::Real;
use fem_elements::sparse::Pattern;
use single::SingleCholesky;

/// The Cholesky factorisation for directions of an iteration, which need a few digits only: in single precision where the matrix allows it.
pub(super) fn cholesky_for_directions<T: Real>(pattern: &Arc<Pattern>) -> Box<dyn ApproximateInverse<T>> {
    if size_of::<T>() > size_of::<f32>() {
        Box::new(SingleCholesky::new(pattern))
    } else {
        Box::new(SupernodalCholesky::new(pattern))
    }
}
