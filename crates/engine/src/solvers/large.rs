//! Sparse Cholesky factorisation A = L Lᵀ of large matrices: dense blocks of columns, in several threads (faer).

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::SparseColMatRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky, supernodal::SupernodalLltRef,
};
use faer::{Conj, MatMut, Par, Side, Spec};

use super::Breakdown;
use super::block_jacobi::root;
use super::csc::Columns;
use crate::number::Real;
use crate::sparse::Pattern;

/// From this many rows on the factorisation is shared out among threads.
const ROWS_FOR_THREADS: usize = 5_000;

/// A factor, and what it is computed in.
pub(super) struct Large<T> {
    columns: Columns<T>,
    /// Nothing where the factor would not fit into memory.
    symbolic: Option<SymbolicCholesky<u32>>,
    L: Vec<T>,
    memory: MemBuffer,
    memory_bytes: usize,
    threads: Par,
}

impl<T: Real> Large<T> {
    /// Finds the entries of L, for the order that the rows are in; `pattern` holds the lower half.
    pub(super) fn new(pattern: &Pattern) -> Self {
        let columns = Columns::new(pattern);
        let threads = if pattern.rows() < ROWS_FOR_THREADS { Par::Seq } else { Par::rayon(0) };
        let symbolic = analyze(&columns);
        let (entries, need) = match &symbolic {
            Some(symbolic) => {
                let factor = symbolic.factorize_numeric_llt_scratch::<T>(threads, Spec::default());
                (symbolic.len_val(), factor.or(symbolic.solve_in_place_scratch::<T>(1, threads)))
            }
            None => (0, faer::dyn_stack::StackReq::EMPTY),
        };
        let memory = MemBuffer::new(need);
        Self { columns, symbolic, L: vec![T::default(); entries], memory, memory_bytes: need.size_bytes(), threads }
    }

    /// Computes L.
    pub(super) fn prepare(&mut self, values: &[[[T; 3]; 3]]) -> Result<(), Breakdown> {
        let symbolic = self.symbolic.as_ref().ok_or(Breakdown::TooLarge)?;
        self.columns.copy(values);
        let matrix = self.columns.matrix();
        let stack = MemStack::new(&mut self.memory);
        let none = LltRegularization::default();
        let done = symbolic.factorize_numeric_llt(
            &mut self.L,
            matrix,
            Side::Lower,
            none,
            self.threads,
            stack,
            Spec::default(),
        );
        match done {
            Ok(_) => check_pivots(symbolic, &self.L, matrix),
            Err(_) if self.columns.finite() => Err(Breakdown::NotPositiveDefinite),
            Err(_) => Err(Breakdown::Singular),
        }
    }

    /// z = A⁻¹ r
    pub(super) fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        z.copy_from_slice(r);
        let Some(symbolic) = &self.symbolic else { return };
        let z = z.as_flattened_mut();
        let rows = z.len();
        let z = MatMut::from_column_major_slice_mut(z, rows, 1);
        let stack = MemStack::new(&mut self.memory);
        LltRef::new(symbolic, &self.L).solve_in_place_with_conj(Conj::No, z, self.threads, stack);
    }

    pub(super) fn bytes(&self) -> usize {
        self.columns.bytes() + size_of_val(self.L.as_slice()) + self.memory_bytes
    }
}

fn analyze<T: Real>(columns: &Columns<T>) -> Option<SymbolicCholesky<u32>> {
    let by_blocks = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..Default::default()
    };
    let upper = columns.places().to_row_major().ok()?;
    factorize_symbolic_cholesky(upper.transpose(), Side::Upper, SymmetricOrdering::Identity, by_blocks).ok()
}

/// A factorisation runs through where rounding makes a pivot of 0 slightly positive, too; what it gives is no factor.
fn check_pivots<T: Real>(
    symbolic: &SymbolicCholesky<u32>,
    L: &[T],
    A: SparseColMatRef<'_, u32, T>,
) -> Result<(), Breakdown> {
    let SymbolicCholeskyRaw::Supernodal(blocks) = symbolic.raw() else { return Ok(()) };
    let L = SupernodalLltRef::new(blocks, L);
    for block in 0..blocks.n_supernodes() {
        let columns = L.supernode(block);
        for j in 0..columns.val().ncols() {
            let pivot = columns.val()[(j, j)];
            root(pivot * pivot, A.val_of_col(columns.start() + j)[0])?;
        }
    }
    Ok(())
}
