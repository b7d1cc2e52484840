//! Parts of a symmetric matrix that several threads process side by side.

use std::ops::Range;

/// Consecutive rows of a matrix: two halves that no block couples with each other, and after them their separator, which they are
/// coupled with. A part of few rows, or one that does not fall apart, is not divided: all of its rows are its own.
///
/// Parts depend on the matrix alone, so results do not depend on the number of threads.
#[derive(Debug)]
pub struct Part {
    /// Its rows, those of its halves first.
    pub rows: Range<usize>,
    /// Its two halves, if it is divided.
    pub halves: Option<Box<[Part; 2]>>,
    /// Numbers of the parts in it, from 0 in the order of their own rows; its own is the last.
    pub numbers: Range<usize>,
}

/// Smallest number of rows of a half: fewer take less time than it takes to wake a thread.
const HALF: usize = 1000;

/// Smallest share of the rows in a half, so that both halves take about the same time.
const SHARE: f64 = 0.3;

impl Part {
    /// The parts of a matrix of so many rows. `columns` gives the columns of the blocks in a row, ascending; those right of the
    /// diagonal do not matter.
    pub fn new<'a>(rows: usize, columns: impl Fn(usize) -> &'a [u32]) -> Self {
        Self::divide(0..rows, &columns, 0)
    }

    /// All rows of a matrix as one part.
    pub fn whole(rows: usize) -> Self {
        Self { rows: 0..rows, halves: None, numbers: 0..1 }
    }

    fn divide<'a>(rows: Range<usize>, columns: &impl Fn(usize) -> &'a [u32], first: usize) -> Self {
        let Some([middle, end]) = halves(&rows, columns) else {
            return Self { rows, halves: None, numbers: first..first + 1 };
        };
        let left = Self::divide(rows.start..middle, columns, first);
        let right = Self::divide(middle..end, columns, left.numbers.end);
        let numbers = first..right.numbers.end + 1;
        Self { rows, halves: Some(Box::new([left, right])), numbers }
    }

    /// The rows that belong to none of its halves.
    pub fn own(&self) -> Range<usize> {
        self.halves.as_ref().map_or(self.rows.start, |halves| halves[1].rows.end)..self.rows.end
    }

    /// The first row of its second half, or of its own rows if it has no halves.
    pub fn middle(&self) -> usize {
        self.halves.as_ref().map_or(self.rows.start, |halves| halves[1].rows.start)
    }

    /// Calls `visit` for each part, in the order of their numbers.
    pub fn for_each(&self, visit: &mut impl FnMut(&Part)) {
        for half in self.halves.iter().flat_map(|halves| halves.iter()) {
            half.for_each(visit);
        }
        visit(self);
    }
}

/// The ends of the first and the second half of these rows, if they have halves.
fn halves<'a>(rows: &Range<usize>, columns: &impl Fn(usize) -> &'a [u32]) -> Option<[usize; 2]> {
    let least = HALF.max((SHARE * rows.len() as f64) as usize);
    let first = |row: usize| {
        let columns = columns(row);
        columns.get(columns.partition_point(|&column| (column as usize) < rows.start)).map(|&column| column as usize)
    };
    let mut best = None;
    for middle in rows.start + least..(rows.end + 1).saturating_sub(least) {
        // The first row of the second half is coupled with no row before it.
        if first(middle).is_some_and(|column| column < middle) {
            continue;
        }
        let end = (middle..rows.end).find(|&row| first(row).is_some_and(|column| column < middle)).unwrap_or(rows.end);
        let smaller = (middle - rows.start).min(end - middle);
        if smaller >= least && best.is_none_or(|(size, _)| smaller > size) {
            best = Some((smaller, [middle, end]));
        }
    }
    best.map(|(_, ends)| ends)
}
