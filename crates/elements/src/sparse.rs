//! Sparsity patterns of symmetric matrices in block compressed sparse rows: a block for each pair of nodes that share an
//! element.

use std::ops::Range;

/// The blocks of a symmetric matrix that are stored.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stored {
    /// Those with column ≤ row, for factorisations.
    Lower,
    /// All of them, for products with vectors row by row.
    Full,
}

/// The positions of the blocks.
#[derive(Clone, Debug, PartialEq)]
pub struct Pattern {
    /// The blocks that are stored.
    pub stored: Stored,
    /// `starts[i]..starts[i + 1]` are the blocks of row i.
    pub starts: Vec<usize>,
    /// Column of each block, ascending within a row.
    pub columns: Vec<u32>,
}

impl Pattern {
    /// The pattern of `nodes` rows for elements that couple their nodes with each other. Nodes from `nodes` on have no row.
    pub fn new<const N: usize>(nodes: usize, elements: &[[u32; N]], stored: Stored) -> Self {
        Self::joined(nodes, elements, &[], stored)
    }

    /// The same, with pairs of nodes that are coupled by other forces.
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

    /// The pattern of a matrix that is never assembled: no rows.
    pub fn none() -> Self {
        Self { stored: Stored::Lower, starts: vec![0], columns: Vec::new() }
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

    /// The number of the block at (row, column), if it is stored.
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

    /// Allocated bytes.
    pub fn bytes(&self) -> usize {
        size_of_val(self.starts.as_slice()) + size_of_val(self.columns.as_slice())
    }
}

/// A D×D block, row by row.
pub type Block<T, const D: usize> = [[T; D]; D];
