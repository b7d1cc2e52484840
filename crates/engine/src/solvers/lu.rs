//! Sparse LU factorisation with row exchanges (faer). It asks nothing of the matrix, and takes twice the work of Cholesky's.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::linalg::lu::{LuRef, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::{Conj, MatMut, Par, Spec};

use super::Breakdown;
use super::csc::Columns;
use crate::number::Real;
use crate::sparse::Pattern;

/// A factorisation, and what it is computed in.
pub(super) struct Lu<T> {
    columns: Columns<T>,
    /// Nothing where the factors would not fit into memory.
    symbolic: Option<SymbolicLu<u32>>,
    numeric: NumericLu<u32, T>,
    memory: MemBuffer,
    memory_bytes: usize,
    prepared: bool,
}

impl<T: Real> Lu<T> {
    /// Chooses the order of the columns; `pattern` holds all blocks.
    pub(super) fn new(pattern: &Pattern) -> Self {
        let columns = Columns::new(pattern);
        let symbolic = factorize_symbolic_lu(columns.places(), Default::default()).ok();
        let need = match &symbolic {
            Some(symbolic) => {
                let factor = symbolic.factorize_numeric_lu_scratch::<T>(Par::Seq, Spec::default());
                factor.or(symbolic.solve_in_place_scratch::<T>(1, Par::Seq))
            }
            None => StackReq::EMPTY,
        };
        let memory = MemBuffer::new(need);
        Self { columns, symbolic, numeric: NumericLu::new(), memory, memory_bytes: need.size_bytes(), prepared: false }
    }

    /// Computes the factors.
    pub(super) fn prepare(&mut self, values: &[[[T; 3]; 3]]) -> Result<(), Breakdown> {
        self.prepared = false;
        let symbolic = self.symbolic.as_ref().ok_or(Breakdown::TooLarge)?;
        self.columns.copy(values);
        if !self.columns.finite() {
            return Err(Breakdown::Singular);
        }
        let stack = MemStack::new(&mut self.memory);
        symbolic
            .factorize_numeric_lu(&mut self.numeric, self.columns.matrix(), Par::Seq, stack, Spec::default())
            .map_err(|_| Breakdown::Singular)?;
        self.prepared = true;
        Ok(())
    }

    /// z = A⁻¹ r
    pub(super) fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        z.copy_from_slice(r);
        let Some(symbolic) = self.symbolic.as_ref().filter(|_| self.prepared) else { return };
        let z = z.as_flattened_mut();
        let rows = z.len();
        let z = MatMut::from_column_major_slice_mut(z, rows, 1);
        let stack = MemStack::new(&mut self.memory);
        LuRef::new_unchecked(symbolic, &self.numeric).solve_in_place_with_conj(Conj::No, z, Par::Seq, stack);
    }

    pub(super) fn bytes(&self) -> usize {
        self.columns.bytes() + self.memory_bytes
    }
}
