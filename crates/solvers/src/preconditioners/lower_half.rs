//! The lower half of a block matrix, by rows, with its diagonal apart.

use std::ops::Range;

use fem_elements::sparse::Pattern;

/// Sparsity pattern of the blocks left of the diagonal.
pub(crate) struct LowerHalf {
    starts: Vec<u32>,
    /// Column of each block, row by row.
    pub(crate) columns: Vec<u32>,
    /// Number of each block in the matrix.
    pub(crate) sources: Vec<u32>,
    /// Number of each diagonal block in the matrix.
    pub(crate) diagonal: Vec<u32>,
}

impl LowerHalf {
    /// The lower half of a pattern, which may store all blocks.
    pub(crate) fn new(pattern: &Pattern) -> Self {
        let (mut starts, mut columns, mut sources) = (vec![0], Vec::new(), Vec::new());
        for row in 0..pattern.rows() {
            for block in pattern.row(row).filter(|&block| (pattern.columns[block] as usize) < row) {
                columns.push(pattern.columns[block]);
                sources.push(block as u32);
            }
            starts.push(columns.len() as u32);
        }
        let diagonal = pattern.diagonal().map(|block| block as u32).collect();
        Self { starts, columns, sources, diagonal }
    }

    pub(crate) fn rows(&self) -> usize {
        self.diagonal.len()
    }

    /// The blocks of a row left of the diagonal.
    #[inline(always)]
    pub(crate) fn row(&self, row: usize) -> Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }

    pub(crate) fn bytes(&self) -> usize {
        size_of::<u32>() * (self.starts.len() + 2 * self.columns.len() + self.diagonal.len())
    }
}
