//! Compressed columns of scalars, as faer reads them, of a matrix of blocks.

use faer::sparse::{SparseColMatRef, SymbolicSparseColMat, SymbolicSparseColMatRef};

use crate::number::Real;
use crate::sparse::{Pattern, Stored};

/// A matrix of scalars, of which the places are found once and the values copied each time.
pub(super) struct Columns<T> {
    places: SymbolicSparseColMat<u32>,
    values: Vec<T>,
    /// Where each block's columns begin in `values`.
    targets: Vec<[u32; 3]>,
    /// Whether each block stands on the diagonal.
    diagonal: Vec<bool>,
    stored: Stored,
}

impl<T: Real> Columns<T> {
    /// For a pattern with fewer than 2³² scalars.
    pub(super) fn new(pattern: &Pattern) -> Self {
        let n = 3 * pattern.rows();
        let entries = |block: usize, row: usize, c: usize| {
            let diagonal = pattern.stored == Stored::Lower && pattern.columns[block] as usize == row;
            if diagonal { 3 - c } else { 3 }
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
        let mut free = starts.clone();
        let mut rows = vec![0u32; starts[n] as usize];
        let mut targets = vec![[0; 3]; pattern.blocks()];
        for (row, block) in blocks() {
            for c in 0..3 {
                let place = &mut free[3 * pattern.columns[block] as usize + c];
                targets[block][c] = *place;
                for r in 3 - entries(block, row, c)..3 {
                    rows[*place as usize] = (3 * row + r) as u32;
                    *place += 1;
                }
            }
        }
        let diagonal = blocks().map(|(row, block)| pattern.columns[block] as usize == row).collect();
        let values = vec![T::default(); rows.len()];
        let places = SymbolicSparseColMat::new_checked(n, n, starts, None, rows);
        Self { places, values, targets, diagonal, stored: pattern.stored }
    }

    pub(super) fn copy(&mut self, values: &[[[T; 3]; 3]]) {
        for ((block, targets), &diagonal) in values.iter().zip(&self.targets).zip(&self.diagonal) {
            for c in 0..3 {
                let first = if diagonal && self.stored == Stored::Lower { c } else { 0 };
                for r in first..3 {
                    self.values[targets[c] as usize + r - first] = block[r][c];
                }
            }
        }
    }

    /// Whether every value is finite.
    pub(super) fn finite(&self) -> bool {
        self.values.iter().all(|value| value.is_finite())
    }

    pub(super) fn places(&self) -> SymbolicSparseColMatRef<'_, u32> {
        self.places.as_ref()
    }

    pub(super) fn matrix(&self) -> SparseColMatRef<'_, u32, T> {
        SparseColMatRef::new(self.places.as_ref(), &self.values)
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.places.col_ptr())
            + size_of_val(self.places.row_idx())
            + size_of_val(self.values.as_slice())
            + size_of_val(self.targets.as_slice())
            + size_of_val(self.diagonal.as_slice())
    }
}
