//! Incomplete Cholesky factorisation without fill-in, by 3×3 blocks: Meijerink and van der Vorst, An Iterative Solution Method
//! for Linear Systems of Which the Coefficient Matrix is a Symmetric M-Matrix (1977). If it breaks down, the diagonal is
//! enlarged: Manteuffel, An Incomplete Factorization Technique for Positive Definite Linear Systems (1980).

use super::lower_half::LowerHalf;
use crate::solvers::block::{factor, invert_lower};
use crate::solvers::{ApproximateInverse, Memory};
use fem_elements::Real;
use fem_elements::history::{put, take};
use fem_elements::sparse::{Block, Pattern};
use fem_elements::vector::triple;
use fem_model::simulation::{Breakdown, History};

/// Relative shifts of the diagonal, tried one after the other until the factorisation succeeds.
const SHIFTS: [f64; 7] = [0.0, 1e-3, 4e-3, 1.6e-2, 6.4e-2, 0.25, 1.0];

/// Marks a column without a block in the current row.
const NONE: u32 = u32::MAX;

/// L with the sparsity pattern of the lower half of A.
pub(crate) struct IncompleteCholesky<T> {
    pattern: LowerHalf,
    /// Blocks of L left of the diagonal.
    L: Vec<Block<T, 3>>,
    /// Inverses of the diagonal blocks of L.
    inverses: Vec<Block<T, 3>>,
    /// Block of each column in the current row, or [`NONE`].
    block_of: Vec<u32>,
}

impl<T: Real> IncompleteCholesky<T> {
    /// Takes the lower half of a pattern, which may store all blocks.
    pub(crate) fn new(pattern: &Pattern) -> Self {
        let lower = LowerHalf::new(pattern);
        let (L, inverses) = (vec![Default::default(); lower.columns.len()], vec![Default::default(); lower.rows()]);
        Self { L, inverses, block_of: vec![NONE; lower.rows()], pattern: lower }
    }

    /// Factorises the matrix with its diagonal scaled.
    fn factor(&mut self, values: &[Block<T, 3>], scale: T) -> Result<(), Breakdown> {
        for row in 0..self.pattern.rows() {
            let blocks = self.pattern.row(row);
            for block in blocks.clone() {
                self.block_of[self.pattern.columns[block] as usize] = block as u32;
            }
            let mut diagonal = values[self.pattern.diagonal[row] as usize];
            (0..3).for_each(|i| diagonal[i][i] *= scale);
            for block in blocks.clone() {
                self.L[block] = self.entry(block, &values[self.pattern.sources[block] as usize]);
                subtract_product(&self.L[block], &self.L[block], &mut diagonal);
            }
            for block in blocks {
                self.block_of[self.pattern.columns[block] as usize] = NONE;
            }
            self.inverses[row] = invert_lower(&factor(&diagonal)?);
        }
        Ok(())
    }

    /// L_ij = (A_ij − Σ L_ik L_jkᵀ) L_jj⁻ᵀ over the columns k of both rows.
    fn entry(&self, block: usize, A: &Block<T, 3>) -> Block<T, 3> {
        let column = self.pattern.columns[block] as usize;
        let mut entry = *A;
        for other in self.pattern.row(column) {
            let same_column = self.block_of[self.pattern.columns[other] as usize];
            if same_column != NONE {
                subtract_product(&self.L[same_column as usize], &self.L[other], &mut entry);
            }
        }
        let inverse = &self.inverses[column];
        entry.map(|row| {
            [
                row[0] * inverse[0][0],
                row[0] * inverse[1][0] + row[1] * inverse[1][1],
                row[0] * inverse[2][0] + row[1] * inverse[2][1] + row[2] * inverse[2][2],
            ]
        })
    }
}

impl<T: Real> Memory<T> for IncompleteCholesky<T> {
    fn save(&self, is_kept: bool, history: &mut History) {
        if !is_kept {
            return;
        }
        put(history, "incomplete_cholesky.L", self.L.as_flattened().as_flattened());
        put(history, "incomplete_cholesky.inverses", self.inverses.as_flattened().as_flattened());
    }

    fn restore(&mut self, is_kept: bool, history: &History) -> Result<(), String> {
        if !is_kept {
            return Ok(());
        }
        take(history, "incomplete_cholesky.L", self.L.as_flattened_mut().as_flattened_mut())?;
        take(history, "incomplete_cholesky.inverses", self.inverses.as_flattened_mut().as_flattened_mut())
    }

    /// The factor may be that of an earlier matrix; it is restored.
    fn prepare_again(&mut self, _values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        Ok(())
    }
}

impl<T: Real> ApproximateInverse<T> for IncompleteCholesky<T> {
    fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        let mut outcome = Ok(());
        for shift in SHIFTS {
            outcome = self.factor(values, T::of(1.0 + shift));
            if outcome.is_ok() {
                break;
            }
        }
        outcome
    }

    fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        for row in 0..self.pattern.rows() {
            let mut rest = r[row];
            for block in self.pattern.row(row) {
                let (L, known) = (&self.L[block], z[self.pattern.columns[block] as usize]);
                for i in 0..3 {
                    rest[i] -= L[i][0] * known[0] + L[i][1] * known[1] + L[i][2] * known[2];
                }
            }
            let inverse = &self.inverses[row];
            z[row] = inverse.map(|row| row[0] * rest[0] + row[1] * rest[1] + row[2] * rest[2]);
        }
        for row in (0..self.pattern.rows()).rev() {
            let known = transposed_product(&self.inverses[row], &z[row]);
            z[row] = known;
            for block in self.pattern.row(row) {
                let product = transposed_product(&self.L[block], &known);
                let rest = &mut z[self.pattern.columns[block] as usize];
                (0..3).for_each(|i| rest[i] -= product[i]);
            }
        }
    }

    fn bytes(&self) -> usize {
        self.pattern.bytes()
            + size_of_val(self.block_of.as_slice())
            + size_of_val(self.L.as_slice())
            + size_of_val(self.inverses.as_slice())
    }
}

/// C −= A Bᵀ
#[inline(always)]
fn subtract_product<T: Real>(A: &Block<T, 3>, B: &Block<T, 3>, C: &mut Block<T, 3>) {
    for i in 0..3 {
        for j in 0..3 {
            C[i][j] -= A[i][0] * B[j][0] + A[i][1] * B[j][1] + A[i][2] * B[j][2];
        }
    }
}

/// Aᵀ x
#[inline(always)]
fn transposed_product<T: Real>(A: &Block<T, 3>, x: &[T; 3]) -> [T; 3] {
    triple(|i| A[0][i] * x[0] + A[1][i] * x[1] + A[2][i] * x[2])
}

#[cfg(test)]
mod tests {
    use super::IncompleteCholesky;
    use crate::solvers::ApproximateInverse;
    use crate::solvers::krylov::{parts, product};
    use fem_elements::sparse::{Pattern, Stored};
    use fem_model::simulation::Breakdown;

    fn chain(off: f64) -> (Pattern, Vec<[[f64; 3]; 3]>) {
        let pattern = Pattern::new(3, &[[0, 1], [1, 2]], Stored::Full);
        let block = |row: usize, column: usize| {
            let entry = if row == column { 2.0 } else { off };
            std::array::from_fn(|i| std::array::from_fn(|j| if i == j { entry } else { 0.1 * entry }))
        };
        let values = (0..3)
            .flat_map(|row| pattern.row(row).map(move |k| (row, k)))
            .map(|(row, k)| block(row, pattern.columns[k] as usize));
        let values = values.collect();
        (pattern, values)
    }

    #[test]
    fn it_is_exact_for_a_matrix_without_fill_in() {
        let (pattern, values) = chain(-0.9);
        let mut incomplete = IncompleteCholesky::new(&pattern);
        incomplete.prepare(&values).unwrap();
        let x = [[1.0, 2.0, 3.0], [-1.0, 0.5, 0.0], [0.2, 0.1, -4.0]];
        let (mut b, mut z) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
        product(&pattern, &parts(&pattern), &values, &x, &mut b);
        incomplete.apply(&b, &mut z);
        for (z, x) in z.as_flattened().iter().zip(x.as_flattened()) {
            assert!((z - x).abs() < 1e-13, "{z} {x}");
        }
    }

    #[test]
    fn a_slightly_indefinite_matrix_is_shifted_and_a_strongly_indefinite_one_is_refused() {
        let (pattern, values) = chain(-1.5);
        assert_eq!(IncompleteCholesky::new(&pattern).prepare(&values), Ok(()));
        let (pattern, values) = chain(-9.0);
        assert_eq!(IncompleteCholesky::new(&pattern).prepare(&values), Err(Breakdown::NotPositiveDefinite));
    }
}
