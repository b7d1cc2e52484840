//! Incomplete Cholesky factorisation without fill-in, by 3×3 blocks: Meijerink and van der Vorst, An Iterative Solution Method
//! for Linear Systems of Which the Coefficient Matrix is a Symmetric M-Matrix (1977). If it breaks down, the diagonal is
//! enlarged: Manteuffel, An Incomplete Factorization Technique for Positive Definite Linear Systems (1980).

use fem_engine::sparse::{Block, Pattern};
use fem_model::simulation::Breakdown;
use nalgebra::{Matrix3, Vector3};

/// Relative shifts of the diagonal, tried one after the other until the factorisation succeeds.
const SHIFTS: [f64; 7] = [0.0, 1e-3, 4e-3, 1.6e-2, 6.4e-2, 0.25, 1.0];

/// L with the sparsity pattern of the lower half of A.
pub(super) struct IncompleteCholesky {
    /// Columns and blocks left of the diagonal, row by row.
    rows: Vec<Vec<(usize, Matrix3<f64>)>>,
    /// Inverses of the diagonal blocks.
    inverses: Vec<Matrix3<f64>>,
}

impl IncompleteCholesky {
    /// Factorises a matrix, with a larger diagonal where that is needed.
    pub(super) fn new(pattern: &Pattern, values: &[Block<f64, 3>]) -> Result<Self, Breakdown> {
        let mut attempts = SHIFTS.iter().map(|shift| Self::scaled(pattern, values, 1.0 + shift));
        attempts.find_map(Result::ok).ok_or(Breakdown::NotPositiveDefinite)
    }

    /// L_ij = (A_ij − Σ L_ik L_jkᵀ) L_jj⁻ᵀ over the columns k of both rows, with the diagonal of A times `scale`.
    fn scaled(pattern: &Pattern, values: &[Block<f64, 3>], scale: f64) -> Result<Self, Breakdown> {
        let mut factor = Self { rows: Vec::new(), inverses: Vec::new() };
        for row in 0..pattern.rows() {
            let mut left: Vec<(usize, Matrix3<f64>)> = Vec::new();
            let mut diagonal = Matrix3::zeros();
            for block in pattern.row(row) {
                let column = pattern.columns[block] as usize;
                let A = Matrix3::from(values[block]).transpose();
                if column < row {
                    let entry = A - product(&left, &factor.rows[column]);
                    left.push((column, entry * factor.inverses[column].transpose()));
                } else if column == row {
                    diagonal = A;
                    (0..3).for_each(|i| diagonal[(i, i)] *= scale);
                }
            }
            diagonal -= product(&left, &left);
            let L = diagonal.cholesky().ok_or(Breakdown::NotPositiveDefinite)?.unpack();
            factor.inverses.push(L.solve_lower_triangular(&Matrix3::identity()).ok_or(Breakdown::Singular)?);
            factor.rows.push(left);
        }
        Ok(factor)
    }

    /// z = L⁻ᵀ L⁻¹ r
    pub(super) fn apply(&self, r: &[[f64; 3]], z: &mut [[f64; 3]]) {
        for (row, left) in self.rows.iter().enumerate() {
            let known: Vector3<f64> = left.iter().map(|(column, L)| L * Vector3::from(z[*column])).sum();
            z[row] = (self.inverses[row] * (Vector3::from(r[row]) - known)).into();
        }
        for (row, left) in self.rows.iter().enumerate().rev() {
            let known = self.inverses[row].tr_mul(&Vector3::from(z[row]));
            z[row] = known.into();
            for (column, L) in left {
                z[*column] = (Vector3::from(z[*column]) - L.tr_mul(&known)).into();
            }
        }
    }
}

/// Σ a bᵀ over the blocks of the same column in two rows.
fn product(a: &[(usize, Matrix3<f64>)], b: &[(usize, Matrix3<f64>)]) -> Matrix3<f64> {
    let same = |column: &usize| b.binary_search_by_key(column, |(other, _)| *other).ok();
    a.iter().filter_map(|(column, block)| Some(block * b[same(column)?].1.transpose())).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use fem_engine::sparse::Stored;

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
        let x = [[1.0, 2.0, 3.0], [-1.0, 0.5, 0.0], [0.2, 0.1, -4.0]];
        let (mut b, mut z) = ([[0.0; 3]; 3], [[0.0; 3]; 3]);
        super::super::times(&pattern, &values, &x, &mut b);
        IncompleteCholesky::new(&pattern, &values).unwrap().apply(&b, &mut z);
        for (z, x) in z.as_flattened().iter().zip(x.as_flattened()) {
            assert!((z - x).abs() < 1e-13, "{z} {x}");
        }
    }

    #[test]
    fn a_slightly_indefinite_matrix_is_shifted_and_a_strongly_indefinite_one_is_refused() {
        let (pattern, values) = chain(-1.5);
        assert!(IncompleteCholesky::new(&pattern, &values).is_ok());
        let (pattern, values) = chain(-9.0);
        assert_eq!(IncompleteCholesky::new(&pattern, &values).err(), Some(Breakdown::NotPositiveDefinite));
    }
}
