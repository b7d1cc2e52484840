//! Symmetric sparse matrices of D×D blocks, one block for each pair of nodes that share an element: compressed sparse rows.

use std::ops::Range;

use crate::number::Real;

/// Which blocks of a symmetric matrix are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stored {
    /// Those with column ≤ row: what a factorisation reads.
    Lower,
    /// All of them: what products with vectors read, row by row.
    Full,
}

/// Places of the blocks, found once.
#[derive(Clone, Debug, PartialEq)]
pub struct Pattern {
    /// Which half is stored.
    pub stored: Stored,
    /// `starts[i]..starts[i + 1]` are the blocks of row i.
    pub starts: Vec<usize>,
    /// Column of each block, ascending within a row.
    pub columns: Vec<u32>,
}

impl Pattern {
    /// The pattern of `nodes` rows for elements that couple each of their corners below `nodes` with each other.
    pub fn new<const N: usize>(nodes: usize, elements: &[[u32; N]], stored: Stored) -> Self {
        Self::joined(nodes, elements, &[], stored)
    }

    /// The same, with pairs of nodes that something else joins.
    pub fn joined<const N: usize>(nodes: usize, elements: &[[u32; N]], joined: &[[u32; 2]], stored: Stored) -> Self {
        let mut pairs: Vec<(u32, u32)> = Vec::with_capacity(elements.len() * N * N + nodes);
        let coupled = |row: u32, column: u32| {
            (row as usize) < nodes && (column as usize) < nodes && (stored == Stored::Full || column <= row)
        };
        for element in elements {
            let all = element.iter().flat_map(|&row| element.iter().map(move |&column| (row, column)));
            pairs.extend(all.filter(|&(row, column)| coupled(row, column)));
        }
        let both = joined.iter().flat_map(|&[a, b]| [(a, b), (b, a)]);
        pairs.extend(both.filter(|&(row, column)| coupled(row, column)));
        pairs.extend((0..nodes as u32).map(|node| (node, node)));
        pairs.sort_unstable();
        pairs.dedup();
        let mut starts = vec![0; nodes + 1];
        for &(row, _) in &pairs {
            starts[row as usize + 1] += 1;
        }
        for row in 0..nodes {
            starts[row + 1] += starts[row];
        }
        Self { stored, starts, columns: pairs.into_iter().map(|(_, column)| column).collect() }
    }

    /// Number of block rows.
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Number of blocks.
    pub fn blocks(&self) -> usize {
        self.columns.len()
    }

    /// The blocks of a row.
    pub fn row(&self, row: usize) -> Range<usize> {
        self.starts[row]..self.starts[row + 1]
    }

    /// The number of the block at (row, column), where there is one.
    pub fn find(&self, row: usize, column: usize) -> Option<usize> {
        if row >= self.rows() {
            return None;
        }
        let blocks = self.row(row);
        let columns = self.columns.get(blocks.clone())?;
        columns.binary_search(&(column as u32)).ok().map(|place| blocks.start + place)
    }

    /// The number of each diagonal block.
    pub fn diagonal(&self) -> impl Iterator<Item = usize> {
        (0..self.rows()).map(|row| match self.find(row, row) {
            Some(block) => block,
            None => unreachable!("a pattern has all of its diagonal"),
        })
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        size_of_val(self.starts.as_slice()) + size_of_val(self.columns.as_slice())
    }
}

/// A D×D block, row by row.
pub type Block<T, const D: usize> = [[T; D]; D];

/// y = A x for a matrix of which all blocks are stored. x and y may be longer: nodes beyond the rows are left alone.
pub fn multiply<T: Real, const D: usize>(pattern: &Pattern, values: &[Block<T, D>], x: &[[T; D]], y: &mut [[T; D]]) {
    debug_assert_eq!(pattern.stored, Stored::Full);
    for (row, sum) in y.iter_mut().enumerate().take(pattern.rows()) {
        *sum = row_product(pattern, values, x, row);
    }
}

/// One row of [`multiply`].
#[inline]
pub fn row_product<T: Real, const D: usize>(
    pattern: &Pattern,
    values: &[Block<T, D>],
    x: &[[T; D]],
    row: usize,
) -> [T; D] {
    let blocks = pattern.row(row);
    let mut sum = [T::default(); D];
    for (block, &column) in values[blocks.clone()].iter().zip(&pattern.columns[blocks]) {
        let x = &x[column as usize];
        for i in 0..D {
            for j in 0..D {
                sum[i] += block[i][j] * x[j];
            }
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::{Pattern, Stored, multiply};

    #[test]
    fn two_triangles_couple_all_but_their_far_corners() {
        let full = Pattern::new(4, &[[0, 1, 2], [1, 3, 2]], Stored::Full);
        assert_eq!(full.blocks(), 14);
        assert_eq!(full.find(0, 3), None);
        assert!(full.find(1, 2).is_some());
        let lower = Pattern::new(4, &[[0, 1, 2], [1, 3, 2]], Stored::Lower);
        assert_eq!(lower.blocks(), 9);
        assert_eq!(lower.find(1, 2), None);
    }

    #[test]
    fn nodes_beyond_the_rows_are_not_coupled() {
        let pattern = Pattern::new(2, &[[0, 1, 2]], Stored::Full);
        assert_eq!(pattern.columns, [0, 1, 0, 1]);
    }

    #[test]
    fn a_product_sums_blocks_times_nodes() {
        let pattern = Pattern::new(2, &[[0, 1]], Stored::Full);
        let values = [[[1.0, 2.0], [3.0, 4.0]], [[0.5, 0.0], [0.0, 0.5]], [[0.0; 2]; 2], [[2.0, 0.0], [0.0, 2.0]]];
        let mut y = [[0.0; 2]; 2];
        multiply(&pattern, &values, &[[1.0, 1.0], [2.0, 4.0]], &mut y);
        assert_eq!(y, [[4.0, 9.0], [4.0, 8.0]]);
    }
}
