//! Sparse LU factorisation with partial pivoting, by faer. The matrix need not be positive definite; it takes twice the
//! operations of a Cholesky factorisation. Always in double precision: pivots of a matrix that is nearly singular need it.

use faer::dyn_stack::{MemBuffer, MemStack, StackReq};
use faer::sparse::linalg::lu::{LuRef, NumericLu, SymbolicLu, factorize_symbolic_lu};
use faer::{Conj, MatMut, Par, Spec};

use super::csc::CscMatrix;
use crate::solvers::{ApproximateInverse, Memoryless};
use fem_elements::Real;
use fem_elements::sparse::{Block, Pattern};
use fem_model::simulation::Breakdown;

/// The factors with their workspace.
pub(crate) struct Lu {
    matrix: CscMatrix<f64>,
    /// `None` if the factors would not fit into memory.
    symbolic: Option<SymbolicLu<u32>>,
    numeric: NumericLu<u32, f64>,
    solution: Vec<f64>,
    workspace: MemBuffer,
    workspace_bytes: usize,
    is_factorised: bool,
}

impl Lu {
    /// Symbolic factorisation with a column ordering by faer; `pattern` stores all blocks.
    pub(crate) fn new(pattern: &Pattern) -> Self {
        let matrix = CscMatrix::new(pattern);
        let symbolic = factorize_symbolic_lu(matrix.symbolic(), Default::default()).ok();
        let need = match &symbolic {
            Some(symbolic) => {
                let factor = symbolic.factorize_numeric_lu_scratch::<f64>(Par::Seq, Spec::default());
                factor.or(symbolic.solve_in_place_scratch::<f64>(1, Par::Seq))
            }
            None => StackReq::EMPTY,
        };
        let (numeric, workspace) = (NumericLu::new(), MemBuffer::new(need));
        let solution = vec![0.0; 3 * pattern.rows()];
        Self {
            matrix,
            symbolic,
            numeric,
            solution,
            workspace,
            workspace_bytes: need.size_bytes(),
            is_factorised: false,
        }
    }
}

impl Memoryless for Lu {}

impl<T: Real> ApproximateInverse<T> for Lu {
    fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        self.is_factorised = false;
        let symbolic = self.symbolic.as_ref().ok_or(Breakdown::TooLarge)?;
        self.matrix.set_values(values, T::as_f64);
        if !self.matrix.is_finite() {
            return Err(Breakdown::Singular);
        }
        let stack = MemStack::new(&mut self.workspace);
        symbolic
            .factorize_numeric_lu(&mut self.numeric, self.matrix.view(), Par::Seq, stack, Spec::default())
            .map_err(|_| Breakdown::Singular)?;
        self.is_factorised = true;
        Ok(())
    }

    fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        let Some(symbolic) = self.symbolic.as_ref().filter(|_| self.is_factorised) else { return z.copy_from_slice(r) };
        for (entry, r) in self.solution.iter_mut().zip(r.as_flattened()) {
            *entry = r.as_f64();
        }
        let rows = self.solution.len();
        let solution = MatMut::from_column_major_slice_mut(&mut self.solution, rows, 1);
        let stack = MemStack::new(&mut self.workspace);
        LuRef::new_unchecked(symbolic, &self.numeric).solve_in_place_with_conj(Conj::No, solution, Par::Seq, stack);
        for (z, &entry) in z.as_flattened_mut().iter_mut().zip(&self.solution) {
            *z = T::of(entry);
        }
    }

    /// Bytes without the numeric factors, whose size faer does not report.
    fn bytes(&self) -> usize {
        self.matrix.bytes() + size_of_val(self.solution.as_slice()) + self.workspace_bytes
    }
}
