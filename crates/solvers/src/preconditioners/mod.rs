//! Preconditioners of conjugate gradients.

mod block_jacobi;
mod coarse;
mod identity;
mod lower_half;
mod multigrid;
mod ssor;

use block_jacobi::BlockJacobi;
pub(super) use identity::Identity;
use multigrid::Multigrid;
use ssor::Ssor;
#[cfg(feature = "gpu")]
pub(super) use {coarse::Coarse, lower_half::LowerHalf};

use std::sync::Arc;

use super::ApproximateInverse;
use fem_elements::Real;
use fem_elements::sparse::{Block, Pattern};
use fem_model::Preconditioner;
use fem_model::simulation::Breakdown;

/// The preconditioner of that name for matrices of a pattern. `rest` holds the undeformed positions of the rows' nodes, m.
pub(super) fn build<T: Real>(
    kind: Preconditioner,
    pattern: &Arc<Pattern>,
    rest: &[[f64; 3]],
) -> Box<dyn ApproximateInverse<T>> {
    match kind {
        Preconditioner::BlockJacobi => Box::new(BlockJacobi::new(pattern)),
        Preconditioner::Multigrid => Box::new(Multigrid::new(pattern, rest)),
        Preconditioner::Ssor => Box::new(Ssor::new(pattern, rest)),
    }
}

/// The factor that scales the largest diagonal entry of a positive definite matrix to 1, into the range of single precision.
/// `diagonal` holds the number of each diagonal block.
pub(super) fn single_precision_scale<T: Real>(values: &[Block<T, 3>], diagonal: &[u32]) -> Result<f64, Breakdown> {
    let entries = diagonal.iter().flat_map(|&block| (0..3).map(move |i| values[block as usize][i][i].as_f64()));
    let largest = entries.fold(0.0, f64::max);
    if largest > 0.0 && largest.is_finite() { Ok(1.0 / largest) } else { Err(Breakdown::Singular) }
}
