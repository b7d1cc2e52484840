//! No preconditioner: P = 1.

use crate::{ApproximateInverse, Memoryless};
use fem_elements::Real;
use fem_elements::sparse::Block;
use fem_model::simulation::Breakdown;

/// P = 1.
pub(crate) struct Identity;

impl Memoryless for Identity {}

impl<T: Real> ApproximateInverse<T> for Identity {
    fn prepare(&mut self, _values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        Ok(())
    }

    fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        z.copy_from_slice(r);
    }

    fn bytes(&self) -> usize {
        0
    }
}
