//! The direct factorisation that takes over where an iterative solver breaks down.
//!
//! Round-off in a preconditioner, or an iteration that stagnates, says little about the matrix: the factor decides whether that is positive
//! definite.

use super::direct::Reordered;
use fem_elements::Real;
use fem_elements::sparse::{Block, Pattern};
use fem_model::simulation::Breakdown;

/// The factor of a matrix with which the iterative solver has broken down.
pub(super) struct DirectFallback<T: Real> {
    /// Bytes that the factor may take, where that is known.
    limit: Option<usize>,
    factor: Option<Reordered<T>>,
    /// True if the factor is that of the matrix in use.
    pub(super) is_in_use: bool,
}

impl<T: Real> DirectFallback<T> {
    /// A factor that may take so many bytes, if there is a limit.
    pub(super) fn within(limit: Option<usize>) -> Self {
        Self { limit, factor: None, is_in_use: false }
    }

    /// Factors a matrix after this breakdown. Returns an error if the matrix is not positive definite, or if its factor does not fit into
    /// memory.
    pub(super) fn prepare(
        &mut self,
        pattern: &Pattern,
        values: &[Block<T, 3>],
        breakdown: Breakdown,
    ) -> Result<(), Breakdown> {
        let factor = self.factor.get_or_insert_with(|| Reordered::within(pattern, self.limit));
        let outcome = match factor.prepare(values) {
            Err(Breakdown::TooLarge) => Err(without_verdict(breakdown)),
            outcome => outcome,
        };
        self.is_in_use = outcome.is_ok();
        outcome
    }

    /// z = A⁻¹ r
    pub(super) fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        if let Some(factor) = &mut self.factor {
            factor.apply(r, z);
        }
    }

    pub(super) fn bytes(&self) -> usize {
        self.factor.as_ref().map_or(0, |factor| factor.bytes())
    }
}

/// Without a factor the matrix may well be positive definite: what is known is that the iteration has not converged.
fn without_verdict(breakdown: Breakdown) -> Breakdown {
    match breakdown {
        Breakdown::NotPositiveDefinite => Breakdown::NotConverged { residual: 1.0 },
        other => other,
    }
}
