//! Sparse Cholesky factorisation A = L Lᵀ of large matrices, by faer: supernodal, in several threads.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor::LltRegularization;
use faer::sparse::SparseColMatRef;
use faer::sparse::linalg::SupernodalThreshold;
use faer::sparse::linalg::cholesky::{
    CholeskySymbolicParams, LltRef, SymbolicCholesky, SymbolicCholeskyRaw, SymmetricOrdering,
    factorize_symbolic_cholesky, supernodal::SupernodalLltRef,
};
use faer::{Conj, MatMut, Par, Side, Spec};

use super::csc::CscMatrix;
use crate::solvers::ApproximateInverse;
use crate::solvers::block::sqrt_pivot;
use fem_elements::Real;
use fem_elements::sparse::{Block, Pattern};
use fem_scene::simulation::Breakdown;

/// From this many rows on the factorisation uses several threads.
const ROWS_FOR_THREADS: usize = 5_000;

/// A factor with its workspace.
pub(super) struct FaerCholesky<T> {
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
        let threads = if pattern.rows() < ROWS_FOR_THREADS { Par::Seq } else { Par::rayon(0) };
        let symbolic = symbolic_factor(&matrix);
        let (entries, need) = match &symbolic {
            Some(symbolic) => {
                let factor = symbolic.factorize_numeric_llt_scratch::<T>(threads, Spec::default());
                (symbolic.len_val(), factor.or(symbolic.solve_in_place_scratch::<T>(1, threads)))
            }
            None => (0, faer::dyn_stack::StackReq::EMPTY),
        };
        let (L, workspace) = (vec![T::default(); entries], MemBuffer::new(need));
        Self { matrix, symbolic, L, workspace, workspace_bytes: need.size_bytes(), threads }
    }
}

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

fn symbolic_factor<T: Real>(matrix: &CscMatrix<T>) -> Option<SymbolicCholesky<u32>> {
    let supernodal = CholeskySymbolicParams {
        supernodal_flop_ratio_threshold: SupernodalThreshold::FORCE_SUPERNODAL,
        ..Default::default()
    };
    let upper = matrix.symbolic().to_row_major().ok()?;
    factorize_symbolic_cholesky(upper.transpose(), Side::Upper, SymmetricOrdering::Identity, supernodal).ok()
}

/// Refuses a factor with a pivot that round-off alone has made positive: faer accepts it, and the matrix is singular.
fn check_pivots<T: Real>(
    symbolic: &SymbolicCholesky<u32>,
    L: &[T],
    A: SparseColMatRef<'_, u32, T>,
) -> Result<(), Breakdown> {
    let SymbolicCholeskyRaw::Supernodal(symbolic) = symbolic.raw() else { return Ok(()) };
    let L = SupernodalLltRef::new(symbolic, L);
    for supernode in 0..symbolic.n_supernodes() {
        let columns = L.supernode(supernode);
        for j in 0..columns.val().ncols() {
            let pivot = columns.val()[(j, j)];
            sqrt_pivot(pivot * pivot, A.val_of_col(columns.start() + j)[0])?;
        }
    }
    Ok(())
}
