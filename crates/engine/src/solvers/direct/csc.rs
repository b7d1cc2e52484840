//! Compressed sparse columns of scalars, the format of faer, of a block matrix.

use faer::sparse::{SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};

use fem_elements::Real;
use fem_elements::sparse::{Block, Pattern, Stored};

/// A matrix of scalars with a fixed sparsity pattern.
pub(super) struct CscMatrix<T> {
    symbolic: SymbolicSparseColMat<u32>,
    values: Vec<T>,
    /// Index in `values` of the first entry of each column of a block.
    targets: Vec<[u32; 3]>,
    /// True for each block on the diagonal.
    is_diagonal: Vec<bool>,
    stored: Stored,
}

impl<T: Real> CscMatrix<T> {
    /// A zero matrix with this pattern, of fewer than 2³² scalars.
    pub(super) fn new(pattern: &Pattern) -> Self {
        let n = 3 * pattern.rows();
        let entries = |block: usize, row: usize, c: usize| {
            let is_half = pattern.stored == Stored::Lower && pattern.columns[block] as usize == row;
            if is_half { 3 - c } else { 3 }
        };
        let blocks = || (0..pattern.rows()).flat_map(|row| pattern.row(row).map(move |block| (row, block)));
        let mut starts = vec![0u32; n + 1];
        for (row, block) in blocks() {
            for c in 0..3 {
                starts[3 * pattern.columns[block] as usize + c + 1] += entries(block, row, c) as u32;
            }
        }
        for column in 0..n {
            starts[column + 1] += starts[column];
        }
        let mut next = starts.clone();
        let mut rows = vec![0u32; starts[n] as usize];
        let mut targets = vec![[0; 3]; pattern.blocks()];
        for (row, block) in blocks() {
            for c in 0..3 {
                let place = &mut next[3 * pattern.columns[block] as usize + c];
                targets[block][c] = *place;
                for r in 3 - entries(block, row, c)..3 {
                    rows[*place as usize] = (3 * row + r) as u32;
                    *place += 1;
                }
            }
        }
        let is_diagonal = blocks().map(|(row, block)| pattern.columns[block] as usize == row).collect();
        let values = vec![T::default(); rows.len()];
        let symbolic = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        Self { symbolic, values, targets, is_diagonal, stored: pattern.stored }
    }

    pub(super) fn set_values<S: Real>(&mut self, values: &[Block<S, 3>], convert: fn(S) -> T) {
        for ((block, targets), &is_diagonal) in values.iter().zip(&self.targets).zip(&self.is_diagonal) {
            for c in 0..3 {
                let first = if is_diagonal && self.stored == Stored::Lower { c } else { 0 };
                for r in first..3 {
                    self.values[targets[c] as usize + r - first] = convert(block[r][c]);
                }
            }
        }
    }

    pub(super) fn is_finite(&self) -> bool {
        self.values.iter().all(|value| value.is_finite())
    }

    pub(super) fn symbolic(&self) -> SymbolicSparseColMatRef<'_, u32> {
        self.symbolic.as_ref()
    }

    pub(super) fn view(&self) -> SparseColMatRef<'_, u32, T> {
        SparseColMatRef::new(self.symbolic.as_ref(), &self.values)
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.symbolic.col_ptr())
            + size_of_val(self.symbolic.row_idx())
            + size_of_val(self.values.as_slice())
            + size_of_val(self.targets.as_slice())
            + size_of_val(self.is_diagonal.as_slice())
    }
}
