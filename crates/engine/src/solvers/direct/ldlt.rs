//! Sparse factorisation A = L D Lᵀ of a symmetric matrix of scalars, by faer, without pivoting: it exists for every positive definite and
//! every quasi-definite matrix, Vanderbei, Symmetric Quasidefinite Matrices (1995). The signs of D are those of the eigenvalues.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::sparse::linalg::cholesky::{
    LdltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering, supernodal::SupernodalLdltRef,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMat};
use faer::{Conj, MatMut, Par, Side, Spec};

use super::faer_cholesky::symbolic_factor;
use fem_model::simulation::Breakdown;

/// A symmetric matrix that is a sum of entries at fixed places, and its factor. Nothing is allocated after [`new`](Self::new).
pub(crate) struct Ldlt {
    symbolic: SymbolicSparseColMat<u32>,
    values: Vec<f64>,
    /// Place in `values` of each entry.
    targets: Vec<u32>,
    /// `None` if the factor would not fit into memory.
    factor: Option<SymbolicCholesky<u32>>,
    L: Vec<f64>,
    workspace: MemBuffer,
    workspace_bytes: usize,
    threads: Par,
    residual: Vec<f64>,
    right: Vec<f64>,
}

/// From this many rows on the factorisation uses several threads.
const ROWS_FOR_THREADS: usize = 15_000;

/// Largest number of corrections of a solution, and the relative residual that ends them.
const CORRECTIONS: usize = 4;
const ROUNDING: f64 = 1e-13;

impl Ldlt {
    /// Analyses a matrix of `rows` rows, to be factored in their order, whose entries are at these rows and columns; of each pair of places
    /// that mirror each other one is given.
    pub(crate) fn new(rows: usize, entries: &[[u32; 2]]) -> Self {
        let of_lower_half = |&[row, column]: &[u32; 2]| [row.min(column), row.max(column)];
        let mut places: Vec<[u32; 2]> = entries.iter().map(of_lower_half).collect();
        places.sort_unstable();
        places.dedup();
        let place = |entry| places.partition_point(|other| *other < of_lower_half(entry)) as u32;
        let targets = entries.iter().map(place).collect();
        let mut starts = vec![0u32; rows + 1];
        places.iter().for_each(|&[column, _]| starts[column as usize + 1] += 1);
        (0..rows).for_each(|column| starts[column + 1] += starts[column]);
        let values = vec![0.0; places.len()];
        let of_rows = places.into_iter().map(|[_, row]| row).collect();
        let symbolic = SymbolicSparseColMat::new_checked(rows, rows, starts, None, of_rows);
        let factor = symbolic_factor(symbolic.as_ref(), SymmetricOrdering::Identity);
        let threads = if rows < ROWS_FOR_THREADS { Par::Seq } else { Par::rayon(0) };
        let need = factor.as_ref().map(|factor| {
            let numeric = factor.factorize_numeric_ldlt_scratch::<f64>(threads, Spec::default());
            numeric.or(factor.solve_in_place_scratch::<f64>(1, threads))
        });
        let need = need.unwrap_or(faer::dyn_stack::StackReq::EMPTY);
        Self {
            L: vec![0.0; factor.as_ref().map_or(0, |factor| factor.len_val())],
            factor,
            symbolic,
            values,
            targets,
            workspace: MemBuffer::new(need),
            workspace_bytes: need.size_bytes(),
            threads,
            residual: vec![0.0; rows],
            right: vec![0.0; rows],
        }
    }

    /// Factors the matrix with these entries, those of one place added up, and returns the number of its positive eigenvalues.
    pub(crate) fn prepare(&mut self, entries: impl Iterator<Item = f64>) -> Result<usize, Breakdown> {
        let factor = self.factor.as_ref().ok_or(Breakdown::TooLarge)?;
        self.values.fill(0.0);
        self.targets.iter().zip(entries).for_each(|(&target, entry)| self.values[target as usize] += entry);
        if !self.values.iter().all(|value| value.is_finite()) {
            return Err(Breakdown::Singular);
        }
        let matrix = SparseColMatRef::new(self.symbolic.as_ref(), &self.values);
        let stack = MemStack::new(&mut self.workspace);
        let (threads, none) = (self.threads, Default::default());
        factor
            .factorize_numeric_ldlt(&mut self.L, matrix, Side::Lower, none, threads, stack, Spec::default())
            .map_err(|_| Breakdown::Singular)?;
        let SymbolicCholeskyRaw::Supernodal(symbolic) = factor.raw() else { return Err(Breakdown::Singular) };
        let L = SupernodalLdltRef::new(symbolic, &self.L);
        let pivots = (0..symbolic.n_supernodes()).flat_map(|supernode| {
            let columns = L.supernode(supernode).val();
            (0..columns.ncols()).map(move |j| columns[(j, j)])
        });
        Ok(pivots.filter(|&pivot| pivot > 0.0).count())
    }

    /// Overwrites the right-hand side with the solution, which is corrected until its residual is rounding error. Returns the relative
    /// residual.
    pub(crate) fn solve(&mut self, x: &mut [f64]) -> f64 {
        let size = max_norm(x);
        if size == 0.0 {
            return 0.0;
        }
        self.right.copy_from_slice(x);
        self.residual.copy_from_slice(x);
        x.fill(0.0);
        let mut left = 1.0;
        for _ in 0..=CORRECTIONS {
            self.apply();
            x.iter_mut().zip(&self.residual).for_each(|(x, correction)| *x += correction);
            self.residual.copy_from_slice(&self.right);
            self.subtract_product(x);
            let before = left;
            left = max_norm(&self.residual) / size;
            // NaN fails the comparison.
            if left <= ROUNDING || !(left < 0.5 * before) {
                break;
            }
        }
        left
    }

    /// Replaces the residual by the solution with it as the right-hand side.
    fn apply(&mut self) {
        let Some(factor) = &self.factor else { return };
        let rows = self.residual.len();
        let x = MatMut::from_column_major_slice_mut(&mut self.residual, rows, 1);
        let stack = MemStack::new(&mut self.workspace);
        LdltRef::new(factor, &self.L).solve_in_place_with_conj(Conj::No, x, self.threads, stack);
    }

    /// residual −= A x
    fn subtract_product(&mut self, x: &[f64]) {
        let matrix = SparseColMatRef::new(self.symbolic.as_ref(), &self.values);
        for column in 0..x.len() {
            for (row, value) in matrix.row_idx_of_col(column).zip(matrix.val_of_col(column)) {
                self.residual[row] -= value * x[column];
                if row != column {
                    self.residual[column] -= value * x[row];
                }
            }
        }
    }

    /// Allocated bytes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.symbolic.row_idx())
            + size_of_val(self.symbolic.col_ptr())
            + size_of_val(&self.values[..])
            + size_of_val(&self.targets[..])
            + size_of_val(&self.L[..])
            + size_of_val(&self.residual[..])
            + size_of_val(&self.right[..])
            + self.workspace_bytes
    }
}

fn max_norm(x: &[f64]) -> f64 {
    x.iter().fold(0.0, |largest, x| f64::max(largest, x.abs()))
}
