//! The fill of the factor on the coarsest level.

use super::blocks::Blocks;

/// Returns true if the Cholesky factor of a coarse matrix has no more entries than the fine matrix, so that a substitution takes about as long as
/// the sweeps of the fine level. That of a compact body soon has more; that of a slender one, which needs a fine coarsest level, has a narrow band.
pub fn is_factor_cheap(coarse: &Blocks<6, 6, f64>, fine: &Blocks<3, 3, f64>) -> bool {
    36 * blocks_of_factor(coarse) <= 9 * fine.values.len()
}

/// Number of blocks of the Cholesky factor of A, in the order of its rows: row i of the factor has a block in each column on the way up the
/// elimination tree from a block of A in row i to i (Liu, The Role of Elimination Trees in Sparse Factorization, 1990).
fn blocks_of_factor(A: &Blocks<6, 6, f64>) -> usize {
    let mut parents = vec![usize::MAX; A.rows()];
    let mut last_rows: Vec<usize> = (0..A.rows()).collect();
    let mut count = A.rows();
    for row in 0..A.rows() {
        for &column in A.row(row).0.iter().take_while(|&&column| (column as usize) < row) {
            let mut node = column as usize;
            while last_rows[node] != row {
                last_rows[node] = row;
                count += 1;
                if parents[node] == usize::MAX {
                    parents[node] = row;
                }
                node = parents[node];
            }
        }
    }
    count
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A matrix with these columns in each row.
    fn matrix(rows: &[&[u32]]) -> Blocks<6, 6, f64> {
        let starts = (0..=rows.len()).map(|count| rows[..count].iter().map(|row| row.len()).sum()).collect();
        Blocks::zeros(starts, rows.concat())
    }

    #[test]
    fn the_factor_of_a_chain_has_no_fill() {
        assert_eq!(blocks_of_factor(&matrix(&[&[0, 1], &[0, 1, 2], &[1, 2, 3], &[2, 3]])), 7);
    }

    #[test]
    fn the_factor_of_a_star_is_full_if_its_centre_comes_first_and_has_no_fill_if_it_comes_last() {
        assert_eq!(blocks_of_factor(&matrix(&[&[0, 1, 2, 3], &[0, 1], &[0, 2], &[0, 3]])), 10);
        assert_eq!(blocks_of_factor(&matrix(&[&[0, 3], &[1, 3], &[2, 3], &[0, 1, 2, 3]])), 7);
    }

    #[test]
    fn the_factor_of_a_ring_couples_its_last_node_with_all_after_the_first() {
        assert_eq!(blocks_of_factor(&matrix(&[&[0, 1, 3], &[0, 1, 2], &[1, 2, 3], &[0, 2, 3]])), 9);
    }
}
