//! Sparse Cholesky factorisation A = L Lᵀ of large matrices, by faer: supernodal, in several threads.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky, supernodal::SupernodalLltRef,
};
use faer::sparse::{SparseColMatRef, SymbolicSparseColMatRef};
use faer::{Conj, MatMut, Par, Side, Spec};

use super::csc::CscMatrix;
use crate::solvers::block::sqrt_pivot;
use crate::solvers::{ApproximateInverse, Memoryless};
use fem_elements::Real;
use fem_elements::sparse::{Block, Pattern};
use fem_model::simulation::Breakdown;

/// From this many rows on the factorisation uses several threads.
const ROWS_FOR_THREADS: usize = 5_000;

/// A factor with its workspace.
pub(crate) struct FaerCholesky<T> {
    matrix: CscMatrix<T>,
    /// `None` if the factor would not fit into memory.
    symbolic: Option<SymbolicCholesky<u32>>,
    L: Vec<T>,
    workspace: MemBuffer,
    workspace_bytes: usize,
    threads: Par,
}

impl<T: Real> FaerCholesky<T> {
    /// Symbolic factorisation in the order of the rows; `pattern` stores the lower half.
    pub(super) fn new(pattern: &Pattern) -> Self {
        let matrix = CscMatrix::new(pattern);
        let symbolic = symbolic_factor(matrix.symbolic(), SymmetricOrdering::Identity);
        Self::with_symbolic(matrix, symbolic, threads(pattern))
    }

    /// The same in a fill-reducing order, for rows in another one. Returns an error if the factor would take more than `limit` bytes.
    pub(crate) fn reordered(pattern: &Pattern, limit: Option<usize>) -> Result<Self, Breakdown> {
        let matrix = CscMatrix::new(pattern);
        let symbolic = symbolic_factor(matrix.symbolic(), SymmetricOrdering::Amd).ok_or(Breakdown::TooLarge)?;
        let threads = threads(pattern);
        let bytes = symbolic.len_val() * size_of::<T>() + scratch::<T>(&symbolic, threads).size_bytes();
        if limit.is_some_and(|limit| bytes > limit) {
            return Err(Breakdown::TooLarge);
        }
        Ok(Self::with_symbolic(matrix, Some(symbolic), threads))
    }

    fn with_symbolic(matrix: CscMatrix<T>, symbolic: Option<SymbolicCholesky<u32>>, threads: Par) -> Self {
        let (entries, need) = match &symbolic {
            Some(symbolic) => (symbolic.len_val(), scratch::<T>(symbolic, threads)),
            None => (0, StackReq::EMPTY),
        };
        let (L, workspace) = (vec![T::default(); entries], MemBuffer::new(need));
        Self { matrix, symbolic, L, workspace, workspace_bytes: need.size_bytes(), threads }
    }
}

fn threads(pattern: &Pattern) -> Par {
    if pattern.rows() < ROWS_FOR_THREADS { Par::Seq } else { Par::rayon(0) }
}

/// Workspace of a factorisation and a substitution.
fn scratch<T: Real>(symbolic: &SymbolicCholesky<u32>, threads: Par) -> StackReq {
    let factor = symbolic.factorize_numeric_llt_scratch::<T>(threads, Spec::default());
    factor.or(symbolic.solve_in_place_scratch::<T>(1, threads))
}

impl<T: Real> Memoryless for FaerCholesky<T> {}

impl<T: Real> ApproximateInverse<T> for FaerCholesky<T> {
    fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        let symbolic = self.symbolic.as_ref().ok_or(Breakdown::TooLarge)?;
        self.matrix.set_values(values, |value| value);
        let matrix = self.matrix.view();
        let stack = MemStack::new(&mut self.workspace);
        let no_regularization = LltRegularization::default();
        let outcome = symbolic.factorize_numeric_llt(
            &mut self.L,
            matrix,
            Side::Lower,
            no_regularization,
            self.threads,
            stack,
            Spec::default(),
        );
        match outcome {
            Ok(_) => check_pivots(symbolic, &self.L, matrix),
            Err(_) if self.matrix.is_finite() => Err(Breakdown::NotPositiveDefinite),
            Err(_) => Err(Breakdown::Singular),
        }
    }

    fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        z.copy_from_slice(r);
        let Some(symbolic) = &self.symbolic else { return };
        let z = z.as_flattened_mut();
        let rows = z.len();
        let z = MatMut::from_column_major_slice_mut(z, rows, 1);
        let stack = MemStack::new(&mut self.workspace);
        LltRef::new(symbolic, &self.L).solve_in_place_with_conj(Conj::No, z, self.threads, stack);
    }

    fn bytes(&self) -> usize {
        self.matrix.bytes() + size_of_val(self.L.as_slice()) + self.workspace_bytes
    }
}

/// Analyses the lower half of a matrix; `None` if the factor would not fit into memory.
pub(super) fn symbolic_factor(
    lower: SymbolicSparseColMatRef<'_, u32>,
    ordering: SymmetricOrdering<'_, u32>,
) -> Option<SymbolicCholesky<u32>> {
    let supernodal = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..Default::default()
    };
    let upper = lower.to_row_major().ok()?;
    factorize_symbolic_cholesky(upper.transpose(), Side::Upper, ordering, supernodal).ok()
}

/// Refuses a factor with a pivot that round-off alone has made positive: faer accepts it, and the matrix is singular.
fn check_pivots<T: Real>(
    symbolic: &SymbolicCholesky<u32>,
    L: &[T],
    A: SparseColMatRef<'_, u32, T>,
) -> Result<(), Breakdown> {
    let order = symbolic.perm().map(|order| order.arrays().0);
    let SymbolicCholeskyRaw::Supernodal(symbolic) = symbolic.raw() else { return Ok(()) };
    let L = SupernodalLltRef::new(symbolic, L);
    for supernode in 0..symbolic.n_supernodes() {
        let columns = L.supernode(supernode);
        for j in 0..columns.val().ncols() {
            let pivot = columns.val()[(j, j)];
            let column = columns.start() + j;
            let column = order.map_or(column, |order| order[column] as usize);
            sqrt_pivot(pivot * pivot, A.val_of_col(column)[0])?;
        }
    }
    Ok(())
}
