//! The fill of a Cholesky factor.

/// Number of blocks of the Cholesky factor of a symmetric matrix in the order of its rows. `columns` gives the columns of the blocks in a row,
/// ascending; those right of the diagonal do not matter.
///
/// Row i of the factor has a block in each column on the way up the elimination tree from a block of the matrix in row i to i: Liu, The Role of
/// Elimination Trees in Sparse Factorization (1990).
pub fn blocks_of_factor<'a>(rows: usize, columns: impl Fn(usize) -> &'a [u32]) -> usize {
    let mut parents = vec![usize::MAX; rows];
    let mut last_rows: Vec<usize> = (0..rows).collect();
    let mut count = rows;
    for row in 0..rows {
        for &column in columns(row).iter().take_while(|&&column| (column as usize) < row) {
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
