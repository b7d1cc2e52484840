//! Matrices of 3×3 blocks in slices of rows: Kreutzer, Hager, Wellein, Fehske and Bishop, A unified sparse matrix data format for
//! efficient general sparse matrix-vector multiplication on modern processors with wide SIMD units (2014).
//!
//! The k-th blocks of the rows of a slice lie side by side, entry by entry, so that invocations of neighbouring rows read
//! neighbouring numbers. Shorter rows are filled with zeros.

/// Rows of a slice.
pub(crate) const SLICE: usize = 32;

/// The blocks of a matrix, row by row.
#[derive(Clone, Debug)]
pub struct BlockPattern {
    /// First block of each row, and the number of blocks.
    pub starts: Vec<u32>,
    /// Column of each block.
    pub columns: Vec<u32>,
}

/// Places of the blocks of a pattern in slices.
pub(crate) struct Slices {
    /// First layer of each slice, and the number of layers. A layer has a block of each row of its slice.
    pub(crate) starts: Vec<u32>,
    /// Column of each block; a row's own for the blocks that fill it.
    pub(crate) columns: Vec<u32>,
    /// The first number of each block of the pattern; its other entries follow at distances of [`SLICE`].
    pub(crate) places: Vec<u32>,
}

impl BlockPattern {
    /// Number of rows.
    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    pub(crate) fn row(&self, row: usize) -> std::ops::Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }
}

impl Slices {
    /// Slices for a pattern.
    pub(crate) fn new(pattern: &BlockPattern) -> Self {
        let rows = pattern.rows();
        let (mut starts, mut columns) = (vec![0], Vec::new());
        let mut places = vec![0; pattern.columns.len()];
        for first in (0..rows).step_by(SLICE) {
            let of_slice = first..rows.min(first + SLICE);
            let layers = of_slice.clone().map(|row| pattern.row(row).len()).max().unwrap_or(0);
            let before = columns.len() / SLICE;
            for layer in 0..layers {
                for row in first..first + SLICE {
                    let block = of_slice.contains(&row).then(|| pattern.row(row).nth(layer)).flatten();
                    if let Some(block) = block {
                        places[block] = ((before + layer) * SLICE * 9 + row - first) as u32;
                    }
                    columns.push(block.map_or(row.min(rows - 1) as u32, |block| pattern.columns[block]));
                }
            }
            starts.push((before + layers) as u32);
        }
        Self { starts, columns, places }
    }

    /// The first number of the diagonal block of each row.
    pub(crate) fn diagonal(&self, pattern: &BlockPattern) -> Vec<u32> {
        let place = |row: usize| {
            let block = pattern.row(row).find(|&block| pattern.columns[block] as usize == row);
            self.places[block.expect("every row has a diagonal block")]
        };
        (0..pattern.rows()).map(place).collect()
    }

    /// Numbers of all slices.
    pub(crate) fn numbers(&self) -> usize {
        9 * self.columns.len()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_block_has_a_place_of_its_own() {
        let starts: Vec<u32> = (0..=70).map(|row: u32| 2 * row + row / 3).collect();
        let columns = (0..starts[70]).map(|block| block % 70).collect();
        let slices = Slices::new(&BlockPattern { starts, columns });
        let entries = slices.places.iter().flat_map(|&place| (0..9).map(move |k| place as usize + k * SLICE));
        let mut entries: Vec<_> = entries.collect();
        entries.sort_unstable();
        assert!(entries.windows(2).all(|pair| pair[0] < pair[1]));
        assert!(entries.last().is_some_and(|last| *last < slices.numbers()));
        assert_eq!(slices.starts.len(), 4, "three slices");
    }
}
