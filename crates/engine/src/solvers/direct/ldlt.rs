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

/// A symmetric matrix that is a sum of entries at fixed places, and a factor.
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
    /// Vectors of an iteration: an orthonormal basis, and the solutions by the factor with its vectors.
    basis: Vec<f64>,
    solutions: Vec<f64>,
}

/// From this many rows on the factorisation uses several threads.
const ROWS_FOR_THREADS: usize = 15_000;

/// Largest number of iterations: about as many as a factor of a large matrix is worth.
const ITERATIONS: usize = 20;

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
            basis: Vec::new(),
            solutions: Vec::new(),
        }
    }

    /// Sets the entries of the matrix, those of one place added up. The factor stays that of the matrix before.
    pub(crate) fn set(&mut self, entries: impl Iterator<Item = f64>) {
        self.values.fill(0.0);
        self.targets.iter().zip(entries).for_each(|(&target, entry)| self.values[target as usize] += entry);
    }

    /// The values of the matrix that was set last.
    pub(crate) fn values(&self) -> &[f64] {
        &self.values
    }

    /// The same, to be restored.
    pub(crate) fn values_mut(&mut self) -> &mut [f64] {
        &mut self.values
    }

    /// Factors the matrix, and returns the number of its positive eigenvalues.
    pub(crate) fn factor(&mut self) -> Result<usize, Breakdown> {
        let factor = self.factor.as_ref().ok_or(Breakdown::TooLarge)?;
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

    /// Overwrites the right-hand side with the solution, to this relative residual, by GMRES with the factor, of this matrix or of a similar one, as
    /// its preconditioner: Saad and Schultz, GMRES (1986), in the flexible form of Saad (1993). Returns the relative residual.
    pub(crate) fn solve(&mut self, x: &mut [f64], tolerance: f64) -> f64 {
        let size = norm(x);
        if size == 0.0 {
            return 0.0;
        }
        let rows = x.len();
        self.basis.clear();
        self.basis.extend(x.iter().map(|x| x / size));
        self.solutions.clear();
        // The least squares problem of the coefficients, brought to triangular form by rotations.
        let (mut R, mut rotations, mut right) = (Vec::new(), Vec::<[f64; 2]>::new(), vec![size]);
        let mut left = 1.0;
        while left > tolerance && rotations.len() < ITERATIONS {
            let step = rotations.len();
            self.apply(step);
            self.multiply(step);
            let mut column: Vec<f64> = Vec::with_capacity(step + 2);
            let (basis, product) = self.basis.split_at_mut(rows * (step + 1));
            for v in basis.chunks_exact(rows) {
                let part = v.iter().zip(&*product).map(|(v, p)| v * p).sum::<f64>();
                product.iter_mut().zip(v).for_each(|(p, v)| *p -= part * v);
                column.push(part);
            }
            let rest = norm(product);
            product.iter_mut().for_each(|p| *p /= rest);
            for (k, [cosine, sine]) in rotations.iter().enumerate() {
                let [a, b] = [column[k], column[k + 1..].first().copied().unwrap_or(0.0)];
                column[k] = cosine * a + sine * b;
                if let Some(next) = column.get_mut(k + 1) {
                    *next = cosine * b - sine * a;
                }
            }
            let last = column[step];
            let length = last.hypot(rest);
            let [cosine, sine] = [last / length, rest / length];
            column[step] = length;
            rotations.push([cosine, sine]);
            R.push(column);
            right.push(-sine * right[step]);
            right[step] *= cosine;
            let before = left;
            left = right[step + 1].abs() / size;
            // NaN fails the comparison.
            if !(left < before) || rest == 0.0 {
                break;
            }
        }
        for step in (0..R.len()).rev() {
            let known: f64 = (step + 1..R.len()).map(|k| R[k][step] * right[k]).sum();
            right[step] = (right[step] - known) / R[step][step];
        }
        x.fill(0.0);
        for (z, factor) in self.solutions.chunks_exact(rows).zip(&right) {
            x.iter_mut().zip(z).for_each(|(x, z)| *x += factor * z);
        }
        if x.iter().all(|x| x.is_finite()) { left } else { f64::NAN }
    }

    /// Adds the solution by the factor with a vector of the basis as its right-hand side.
    fn apply(&mut self, step: usize) {
        let rows = self.symbolic.nrows();
        self.solutions.extend_from_slice(&self.basis[step * rows..][..rows]);
        let Some(factor) = &self.factor else { return };
        let x = MatMut::from_column_major_slice_mut(&mut self.solutions[step * rows..], rows, 1);
        let stack = MemStack::new(&mut self.workspace);
        LdltRef::new(factor, &self.L).solve_in_place_with_conj(Conj::No, x, self.threads, stack);
    }

    /// Adds A times a solution to the basis.
    fn multiply(&mut self, step: usize) {
        let rows = self.symbolic.nrows();
        let matrix = SparseColMatRef::new(self.symbolic.as_ref(), &self.values);
        let first = self.basis.len();
        self.basis.resize(first + rows, 0.0);
        let (x, y) = (&self.solutions[step * rows..], &mut self.basis[first..]);
        for column in 0..rows {
            let mut of_column = 0.0;
            for (row, value) in matrix.row_idx_of_col(column).zip(matrix.val_of_col(column)) {
                y[row] += value * x[column];
                if row != column {
                    of_column += value * x[row];
                }
            }
            y[column] += of_column;
        }
    }

    /// Allocated bytes.
    pub(crate) fn bytes(&self) -> usize {
        size_of_val(self.symbolic.row_idx())
            + size_of_val(self.symbolic.col_ptr())
            + size_of_val(&self.values[..])
            + size_of_val(&self.targets[..])
            + size_of_val(&self.L[..])
            + size_of_val(&self.basis[..])
            + size_of_val(&self.solutions[..])
            + self.workspace_bytes
    }
}

fn norm(x: &[f64]) -> f64 {
    x.iter().map(|x| x * x).sum::<f64>().sqrt()
}
