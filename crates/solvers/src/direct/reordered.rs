//! The Cholesky factor of a matrix whose rows are in another order than one that reduces fill.

use super::SupernodalCholesky;
use crate::ApproximateInverse;
use crate::numbering::{Ties, minimum_degree};
use fem_elements::Real;
use fem_elements::sparse::{Block, Pattern, Stored};
use fem_model::simulation::Breakdown;

/// A factor of P A Pᵀ.
pub(crate) struct Reordered<T: Real> {
    factor: SupernodalCholesky<T>,
    /// The factor's row of each row.
    place: Vec<u32>,
    /// The factor's block of each block, and whether that is the transposed one.
    blocks: Vec<(u32, bool)>,
    values: Vec<Block<T, 3>>,
    vector: Vec<[T; 3]>,
}

impl<T: Real> Reordered<T> {
    /// Symbolic factorisation in the order of minimum degree; `pattern` stores the lower half. Where the factor would take more than `limit`
    /// bytes, every factorisation returns [`Breakdown::TooLarge`].
    pub(crate) fn within(pattern: &Pattern, limit: Option<usize>) -> Self {
        let rows = pattern.rows();
        let pairs =
            || (0..rows).flat_map(|row| pattern.row(row).map(move |block| [row as u32, pattern.columns[block]]));
        let mut adjacency: Vec<Vec<u32>> = vec![Vec::new(); rows];
        for [row, column] in pairs().filter(|[row, column]| row != column) {
            adjacency[row as usize].push(column);
            adjacency[column as usize].push(row);
        }
        let mut place = vec![0; rows];
        for (new, old) in minimum_degree(adjacency, Ties::Last).into_iter().enumerate() {
            place[old as usize] = new as u32;
        }
        let moved: Vec<[u32; 2]> = pairs().map(|pair| pair.map(|row| place[row as usize])).collect();
        let reordered = Pattern::new(rows, &moved, Stored::Lower);
        let block = |[row, column]: [u32; 2]| {
            let block = reordered.find(row.max(column) as usize, row.min(column) as usize);
            block.map(|block| (block as u32, row < column))
        };
        Self {
            factor: SupernodalCholesky::within(&reordered, limit),
            blocks: moved.into_iter().filter_map(block).collect(),
            place,
            values: vec![[[T::default(); 3]; 3]; reordered.blocks()],
            vector: vec![[T::default(); 3]; rows],
        }
    }

    /// Factors the matrix with these values.
    pub(crate) fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        for (value, &(block, is_transposed)) in values.iter().zip(&self.blocks) {
            let of = |i: usize, j: usize| if is_transposed { value[j][i] } else { value[i][j] };
            self.values[block as usize] = [0, 1, 2].map(|i| [0, 1, 2].map(|j| of(i, j)));
        }
        self.factor.prepare(&self.values)
    }

    /// z = A⁻¹ r
    pub(crate) fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        for (r, &place) in r.iter().zip(&self.place) {
            self.vector[place as usize] = *r;
        }
        self.factor.solve(self.vector.as_flattened_mut());
        for (z, &place) in z.iter_mut().zip(&self.place) {
            *z = self.vector[place as usize];
        }
    }

    /// Allocated bytes.
    pub(crate) fn bytes(&self) -> usize {
        self.factor.bytes()
            + size_of_val(&self.place[..])
            + size_of_val(&self.blocks[..])
            + size_of_val(&self.values[..])
            + size_of_val(&self.vector[..])
    }
}
