//! Restriction to the coarse grid: Pᵀ r, part by part of the matrix.

use super::super::coarse::{Grid, Row};
use crate::parts::Part;

/// Each part sums the contributions of its own rows to the corners of their cells, so that every thread writes to its own memory. Then
/// the sums of the parts are added, in the same order with any number of threads.
pub struct Shares {
    /// The cell of each row, among `cells`.
    cell_of_row: Vec<u32>,
    /// Places in `sums` of the corners of a cell, once for each part with rows in it.
    cells: Vec<[u32; 8]>,
    /// The corner of each sum.
    corners: Vec<u32>,
    /// The sums of part i are `starts[i]..starts[i + 1]`.
    starts: Vec<usize>,
    pub sums: Vec<Row>,
}

/// The sums of some parts.
pub struct Sums<'a> {
    pub sums: &'a mut [Row],
    /// Place of the first of them.
    first: usize,
}

impl Shares {
    pub fn new(part: &Part, grid: &Grid) -> Self {
        let mut shares = Self {
            cell_of_row: vec![0; grid.nodes.len()],
            cells: Vec::new(),
            corners: Vec::new(),
            starts: vec![0],
            sums: Vec::new(),
        };
        part.for_each(&mut |part| shares.push(part, grid));
        shares.sums = vec![[0.0; 4]; shares.corners.len()];
        shares
    }

    fn push(&mut self, part: &Part, grid: &Grid) {
        let cell = |row: usize| grid.nodes[row].cell;
        let mut cells: Vec<u32> = part.own().map(cell).collect();
        cells.sort_unstable();
        cells.dedup();
        let mut corners: Vec<u32> = cells.iter().flat_map(|&cell| grid.cells[cell as usize]).collect();
        corners.sort_unstable();
        corners.dedup();
        let (first_cell, first) = (self.cells.len(), self.corners.len());
        for row in part.own() {
            self.cell_of_row[row] = (first_cell + cells.binary_search(&cell(row)).unwrap_or_default()) as u32;
        }
        let place = |corner: u32| (first + corners.binary_search(&corner).unwrap_or_default()) as u32;
        self.cells.extend(cells.iter().map(|&cell| grid.cells[cell as usize].map(place)));
        self.corners.extend(&corners);
        self.starts.push(self.corners.len());
    }

    /// All sums, and where rows add to them.
    pub fn all(&mut self) -> (Sums<'_>, Places<'_>) {
        let Self { cell_of_row, cells, starts, sums, .. } = self;
        (Sums { sums, first: 0 }, Places { cell_of_row, cells, starts })
    }

    /// Writes the sums over all parts.
    pub fn collect(&self, totals: &mut [Row]) {
        totals.fill([0.0; 4]);
        for (&corner, sum) in self.corners.iter().zip(&self.sums) {
            let total = &mut totals[corner as usize];
            (0..4).for_each(|k| total[k] += sum[k]);
        }
    }

    pub fn bytes(&self) -> usize {
        let numbers = size_of_val(self.cell_of_row.as_slice()) + size_of_val(self.corners.as_slice());
        numbers + size_of_val(self.cells.as_slice()) + size_of_val(self.sums.as_slice())
    }
}

/// The place to which each row adds in the sums of its part.
#[derive(Clone, Copy)]
pub struct Places<'a> {
    cell_of_row: &'a [u32],
    cells: &'a [[u32; 8]],
    starts: &'a [usize],
}

impl Sums<'_> {
    /// The sums of the halves of a part, and its own.
    pub fn split(&mut self, part: &Part, places: &Places) -> [Sums<'_>; 3] {
        let first = self.first;
        let [middle, end] = match part.halves.as_deref() {
            Some([left, right]) => [left, right].map(|half| places.starts[half.numbers.end]),
            None => [first, first],
        };
        let (left, rest) = self.sums.split_at_mut(middle - first);
        let (right, own) = rest.split_at_mut(end - middle);
        [Sums { sums: left, first }, Sums { sums: right, first: middle }, Sums { sums: own, first: end }]
    }

    /// Adds the values of a row, times the weights of the corners of its cell.
    #[inline(always)]
    pub fn add(&mut self, places: &Places, row: usize, values: Row, weights: [f32; 8]) {
        let corners = &places.cells[places.cell_of_row[row] as usize];
        for (&corner, weight) in corners.iter().zip(weights) {
            let sum = &mut self.sums[corner as usize - self.first];
            (0..4).for_each(|k| sum[k] += weight * values[k]);
        }
    }
}
