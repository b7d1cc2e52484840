//! Preconditioners of conjugate gradients.

mod block_jacobi;
mod coarse;
mod identity;
mod lower_half;
mod multigrid;
mod ssor;

pub(super) use block_jacobi::BlockJacobi;
pub(super) use identity::Identity;
pub(super) use multigrid::Multigrid;
pub(super) use ssor::Ssor;
#[cfg(feature = "gpu")]
pub(super) use {coarse::Coarse, lower_half::LowerHalf};

use fem_elements::Real;
use fem_elements::sparse::Block;
use fem_model::simulation::Breakdown;

/// The factor that scales the largest diagonal entry of a positive definite matrix to 1, into the range of single precision.
/// `diagonal` holds the number of each diagonal block.
pub(super) fn single_precision_scale<T: Real>(values: &[Block<T, 3>], diagonal: &[u32]) -> Result<f64, Breakdown> {
    let entries = diagonal.iter().flat_map(|&block| (0..3).map(move |i| values[block as usize][i][i].as_f64()));
    let largest = entries.fold(0.0, f64::max);
    if largest > 0.0 && largest.is_finite() { Ok(1.0 / largest) } else { Err(Breakdown::Singular) }
}
