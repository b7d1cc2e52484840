//! The block Jacobi preconditioner: the inverse of each diagonal block.

use crate::block::invert;
use crate::{ApproximateInverse, Memory};
use fem_elements::Real;
use fem_elements::history::{put, take};
use fem_elements::sparse::{Block, Pattern};
use fem_model::simulation::{Breakdown, History};

/// The inverse of each diagonal block.
pub(crate) struct BlockJacobi<T> {
    /// Number of each diagonal block in the matrix.
    diagonal: Vec<u32>,
    inverses: Vec<Block<T, 3>>,
}

impl<T: Real> BlockJacobi<T> {
    pub(crate) fn new(pattern: &Pattern) -> Self {
        let diagonal: Vec<u32> = pattern.diagonal().map(|block| block as u32).collect();
        Self { inverses: vec![Default::default(); diagonal.len()], diagonal }
    }
}

impl<T: Real> Memory<T> for BlockJacobi<T> {
    fn save(&self, is_kept: bool, history: &mut History) {
        if !is_kept {
            return;
        }
        put(history, "block_jacobi.inverses", self.inverses.as_flattened().as_flattened());
    }

    fn restore(&mut self, is_kept: bool, history: &History) -> Result<(), String> {
        if !is_kept {
            return Ok(());
        }
        take(history, "block_jacobi.inverses", self.inverses.as_flattened_mut().as_flattened_mut())
    }

    /// The inverses may be those of an earlier matrix; they are restored.
    fn prepare_again(&mut self, _values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        Ok(())
    }
}

impl<T: Real> ApproximateInverse<T> for BlockJacobi<T> {
    fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        for (inverse, &block) in self.inverses.iter_mut().zip(&self.diagonal) {
            *inverse = invert(&values[block as usize])?;
        }
        Ok(())
    }

    fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        for ((z, r), inverse) in z.iter_mut().zip(r).zip(&self.inverses) {
            *z = inverse.map(|row| row[0] * r[0] + row[1] * r[1] + row[2] * r[2]);
        }
    }

    fn bytes(&self) -> usize {
        size_of_val(self.diagonal.as_slice()) + size_of_val(self.inverses.as_slice())
    }
}
