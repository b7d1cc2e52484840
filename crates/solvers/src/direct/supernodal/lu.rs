//! Sparse factorisation A = P L U of a matrix of blocks with a symmetric pattern, by the multifrontal method. Pivots are sought among the rows of
//! a diagonal block of a front, so that fronts stay those of the Cholesky factor: in the matrices of a body, rows elsewhere are no better.
//! Always in double precision: pivots of a matrix that is nearly singular need it.

use super::factorisation::Factorisation;
use super::substitute::Substitute;
use super::symbolic::SymbolicFactor;
use super::tasks::Task;
use super::zeros;
use crate::memory::available_memory;
use crate::{ApproximateInverse, Memoryless};
use fem_elements::Real;
use fem_elements::number::{Float, vectorized};
use fem_elements::sparse::{Block, Pattern, Stored};
use fem_model::simulation::Breakdown;

/// The factors with their workspace. Of each pair the first is about L, the second about Uᵀ, which has the same pattern.
pub(crate) struct Lu {
    symbolic: SymbolicFactor,
    task: Task,
    /// False if the factors do not fit into memory.
    fits: bool,
    /// Numbers of the blocks at (i, j) and (j, i) in the pattern of the matrix, for each block on or below the diagonal.
    blocks: Vec<[u32; 2]>,
    /// The blocks on and below the diagonal, and those on and above it, transposed.
    values: [Vec<Block<f64, 3>>; 2],
    columns: [Vec<f64>; 2],
    /// 1 / diagonal, in postorder.
    inverse: [Vec<f64>; 2],
    /// The row of its supernode with which each row was exchanged, one after the other.
    swaps: Vec<u32>,
    updates: [Vec<f64>; 2],
    /// One entry for each row of the largest front.
    front: Vec<f64>,
    solution: Vec<f64>,
}

impl Lu {
    /// Symbolic factorisation in the order of the rows; `pattern` stores all blocks.
    pub(crate) fn new(pattern: &Pattern) -> Self {
        let rows = 0..pattern.rows();
        let pairs = rows.flat_map(|row| pattern.row(row).map(move |block| [row as u32, pattern.columns[block]]));
        let lower: Vec<[u32; 2]> = pairs.filter(|[row, column]| column <= row).collect();
        let find = |[row, column]: [u32; 2]| match pattern.find(row as usize, column as usize) {
            Some(block) => block as u32,
            None => unreachable!("the pattern of a body is symmetric"),
        };
        let blocks: Vec<[u32; 2]> =
            lower.iter().map(|&[row, column]| [find([row, column]), find([column, row])]).collect();
        let symbolic = SymbolicFactor::new(&Pattern::new(pattern.rows(), &lower, Stored::Lower), 3, f64::MAX_WIDTH);
        let task = Task::new(&symbolic);
        let (rows, len) = (3 * pattern.rows(), task.len_updates);
        let largest = symbolic.supernodes.iter().map(|supernode| supernode.stride).max().unwrap_or(0);
        let sizes = [symbolic.len_L, symbolic.len_L, rows, len, len, largest, rows];
        let memory = zeros(sizes, available_memory());
        let fits = memory.is_some();
        let [L, U, inverse, of_L, of_U, front, solution] = memory.unwrap_or_default();
        Self {
            symbolic,
            task,
            fits,
            values: [(); 2].map(|()| vec![[[0.0; 3]; 3]; blocks.len()]),
            blocks,
            columns: [L, U],
            inverse: [vec![1.0; rows], inverse],
            swaps: vec![0; rows],
            updates: [of_L, of_U],
            front,
            solution,
        }
    }
}

impl Memoryless for Lu {}

impl<T: Real> ApproximateInverse<T> for Lu {
    fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        if !self.fits {
            return Err(Breakdown::TooLarge);
        }
        if !values.as_flattened().as_flattened().iter().all(|value| value.is_finite()) {
            return Err(Breakdown::Singular);
        }
        let [lower, upper] = &mut self.values;
        for (&[below, above], (lower, upper)) in self.blocks.iter().zip(lower.iter_mut().zip(upper)) {
            let (below, above) = (&values[below as usize], &values[above as usize]);
            for i in 0..3 {
                for j in 0..3 {
                    (lower[i][j], upper[i][j]) = (below[i][j].as_f64(), above[j][i].as_f64());
                }
            }
        }
        let Self { symbolic, task, inverse: [_, inverse], swaps, .. } = self;
        let values = self.values.each_ref().map(|values| &values[..]);
        let columns = self.columns.each_mut().map(|columns| &mut columns[..]);
        let updates = self.updates.each_mut().map(|updates| &mut updates[..]);
        let signs = &mut [];
        vectorized(Factorisation::<f64, 3, 2, false> {
            symbolic,
            task,
            values,
            columns,
            inverse,
            signs,
            swaps,
            updates,
        })
    }

    fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        let Self { symbolic, columns: [L, U], inverse: [of_L, of_U], swaps, front, solution, .. } = self;
        if !self.fits {
            return z.copy_from_slice(r);
        }
        for (entry, r) in solution.iter_mut().zip(r.as_flattened()) {
            *entry = r.as_f64();
        }
        let (forward, backward) = ((&L[..], &of_L[..]), (&U[..], &of_U[..]));
        vectorized(Substitute::<f64, 3> { symbolic, forward, backward, signs: &[], swaps, z: solution, front });
        for (z, &entry) in z.as_flattened_mut().iter_mut().zip(&self.solution) {
            *z = T::of(entry);
        }
    }

    fn bytes(&self) -> usize {
        let both = self.columns[0].len() + self.updates[0].len() + self.inverse[0].len();
        let scalars = 2 * both + 18 * self.blocks.len() + self.front.len() + self.solution.len();
        8 * scalars + size_of_val(&self.blocks[..]) + size_of_val(&self.swaps[..]) + self.symbolic.bytes()
    }
}
