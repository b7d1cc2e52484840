//! Sparse Cholesky factorisation by 3×3 blocks.

use nalgebra::{DVector, Matrix3, Vector3};
use nalgebra_sparse::{CsrMatrix, pattern::SparsityPattern};

use super::ordering::minimum_degree;

/// The error of a matrix that has no Cholesky factor: a pivot is not positive (or NaN).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct NotPositiveDefinite;

/// Factorisation `Π A Πᵀ = L Lᵀ` of a symmetric matrix, Π a fill-reducing permutation.
///
/// [`analyze`](Self::analyze) does the symbolic factorisation, which depends on the pattern alone, once;
/// [`factor`](Self::factor) computes L for given values and allocates nothing. Unknowns are grouped in threes, as
/// vertices have them; a size that three does not divide is filled up with rows of the identity.
/// The algorithm is left-looking (T. Davis, Direct Methods for Sparse Linear Systems, SIAM 2006, chapter 4).
pub struct Cholesky {
    pattern: SparsityPattern,
    /// `place[vertex]` is the position of a vertex in the elimination order.
    place: Vec<usize>,
    /// The block of `values`, and the row and column in it, to which each entry of A is added; `None` above the diagonal.
    targets: Vec<Option<(usize, usize, usize)>>,
    /// Block columns of L: `rows[starts[j]..starts[j + 1]]` are the rows of column j, ascending, the diagonal first.
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<Matrix3<f64>>,
    scratch: Scratch,
}

/// Work arrays of a factorisation.
struct Scratch {
    /// The column being computed, by row.
    column: Vec<Matrix3<f64>>,
    /// Lists of the columns that have an entry in a later row: `next[k]` follows k in the list that starts at `heads[row]`.
    heads: Vec<usize>,
    next: Vec<usize>,
    /// `cursor[k]` is the position of the first entry of column k that no later column has used yet.
    cursor: Vec<usize>,
}

/// The end of a list in [`Scratch`].
const NONE: usize = usize::MAX;

impl Cholesky {
    /// Chooses the elimination order and finds the pattern of L.
    ///
    /// `pattern  (n×n)` of A, symmetric.
    pub fn analyze(pattern: &SparsityPattern) -> Self {
        let neighbours = block_neighbours(pattern);
        let vertices = neighbours.len();
        let mut place = vec![0; vertices];
        for (k, vertex) in minimum_degree(&neighbours).into_iter().enumerate() {
            place[vertex] = k;
        }
        let (starts, rows) = fill(&neighbours, &place);
        let mut cholesky = Self {
            pattern: pattern.clone(),
            place,
            targets: Vec::new(),
            values: vec![Matrix3::zeros(); rows.len()],
            starts,
            rows,
            scratch: Scratch {
                column: vec![Matrix3::zeros(); vertices],
                heads: vec![NONE; vertices],
                next: vec![NONE; vertices],
                cursor: vec![0; vertices],
            },
        };
        cholesky.targets = cholesky.find_targets();
        cholesky
    }

    /// Returns whether this is the pattern that was analysed.
    pub fn fits(&self, pattern: &SparsityPattern) -> bool {
        self.pattern == *pattern
    }

    /// Number of entries of L, zeros inside its blocks included.
    pub fn nnz(&self) -> usize {
        9 * self.rows.len()
    }

    fn find_targets(&self) -> Vec<Option<(usize, usize, usize)>> {
        let target = |(row, column): (usize, usize)| {
            let (i, j) = (self.place[row / 3], self.place[column / 3]);
            (i >= j).then(|| {
                let rows = &self.rows[self.starts[j]..self.starts[j + 1]];
                let block = self.starts[j] + rows.binary_search(&i).expect("L has an entry wherever A has one");
                (block, row % 3, column % 3)
            })
        };
        self.pattern.entries().map(target).collect()
    }

    /// Computes L for the values of `A + shift · 1`.
    ///
    /// `A  (n×n)` symmetric, with the pattern that was analysed.
    pub fn factor(&mut self, A: &CsrMatrix<f64>, shift: f64) -> Result<(), NotPositiveDefinite> {
        assert!(self.fits(A.pattern()), "the matrix has another pattern than the one that was analysed");
        self.values.fill(Matrix3::zeros());
        for (&value, target) in A.values().iter().zip(&self.targets) {
            if let Some((block, i, j)) = *target {
                self.values[block][(i, j)] += value;
            }
        }
        for (coordinate, vertex) in (0..3 * self.place.len()).map(|i| (i, self.place[i / 3])) {
            let filler = if coordinate < A.nrows() { shift } else { 1.0 };
            self.values[self.starts[vertex]][(coordinate % 3, coordinate % 3)] += filler;
        }
        self.scratch.heads.fill(NONE);
        (0..self.place.len()).try_for_each(|j| self.factor_column(j))
    }

    fn factor_column(&mut self, j: usize) -> Result<(), NotPositiveDefinite> {
        let Scratch { column, heads, next, cursor } = &mut self.scratch;
        let (start, end) = (self.starts[j], self.starts[j + 1]);
        for p in start..end {
            column[self.rows[p]] = self.values[p];
        }

        // Subtract L(:, k) L(j, k)ᵀ for every earlier column k that reaches row j.
        let mut k = heads[j];
        while k != NONE {
            let following = next[k];
            let (used, end_k) = (cursor[k], self.starts[k + 1]);
            let L_jk = self.values[used].transpose();
            for (&row, L_ik) in self.rows[used..end_k].iter().zip(&self.values[used..end_k]) {
                column[row] -= L_ik * L_jk;
            }
            if used + 1 < end_k {
                cursor[k] = used + 1;
                let row = self.rows[used + 1];
                next[k] = heads[row];
                heads[row] = k;
            }
            k = following;
        }

        let diagonal = factor_block(&column[j]).ok_or(NotPositiveDefinite)?;
        self.values[start] = diagonal;
        let inverse_transpose = invert_lower(&diagonal).transpose();
        for p in start + 1..end {
            self.values[p] = column[self.rows[p]] * inverse_transpose;
        }
        if start + 1 < end {
            cursor[j] = start + 1;
            let row = self.rows[start + 1];
            next[j] = heads[row];
            heads[row] = j;
        }
        Ok(())
    }

    /// Solves `A x = b` with the last factor.
    ///
    /// `b  (n)`; returns `x  (n)`.
    pub fn solve(&self, b: &DVector<f64>) -> DVector<f64> {
        let mut x = vec![Vector3::zeros(); self.place.len()];
        for (i, &value) in b.iter().enumerate() {
            x[self.place[i / 3]][i % 3] = value;
        }
        for j in 0..x.len() {
            let (start, end) = (self.starts[j], self.starts[j + 1]);
            x[j] = solve_lower(&self.values[start], &x[j]);
            let x_j = x[j];
            for p in start + 1..end {
                x[self.rows[p]] -= self.values[p] * x_j;
            }
        }
        for j in (0..x.len()).rev() {
            let (start, end) = (self.starts[j], self.starts[j + 1]);
            let below = (start + 1..end).map(|p| self.values[p].tr_mul(&x[self.rows[p]])).sum::<Vector3<f64>>();
            x[j] = solve_lower_transposed(&self.values[start], &(x[j] - below));
        }
        DVector::from_fn(b.len(), |i, _| x[self.place[i / 3]][i % 3])
    }
}

/// Groups of three unknowns that share an entry with each group, ascending.
fn block_neighbours(pattern: &SparsityPattern) -> Vec<Vec<usize>> {
    assert_eq!(pattern.major_dim(), pattern.minor_dim(), "only a square matrix has a Cholesky factor");
    let mut neighbours = vec![Vec::new(); pattern.major_dim().div_ceil(3)];
    for row in 0..pattern.major_dim() {
        neighbours[row / 3].extend(pattern.lane(row).iter().map(|column| column / 3));
    }
    for list in &mut neighbours {
        list.sort_unstable();
        list.dedup();
    }
    neighbours
}

/// Block columns of L by symbolic elimination: a column passes its rows on to the column of the first of them.
fn fill(neighbours: &[Vec<usize>], place: &[usize]) -> (Vec<usize>, Vec<usize>) {
    let mut columns: Vec<Vec<usize>> = (0..place.len()).map(|j| vec![j]).collect();
    for (vertex, list) in neighbours.iter().enumerate() {
        let j = place[vertex];
        columns[j].extend(list.iter().map(|&other| place[other]).filter(|&i| i > j));
    }
    let (mut starts, mut rows) = (vec![0], Vec::new());
    for j in 0..columns.len() {
        let mut column = std::mem::take(&mut columns[j]);
        column.sort_unstable();
        column.dedup();
        if let Some(&parent) = column.get(1) {
            columns[parent].extend(&column[2..]);
        }
        rows.extend(column);
        starts.push(rows.len());
    }
    (starts, rows)
}

/// Cholesky factor of a 3×3 matrix, of which the lower triangle is read.
fn factor_block(A: &Matrix3<f64>) -> Option<Matrix3<f64>> {
    let pivot = |square: f64| (square > 0.0 && square.is_finite()).then(|| square.sqrt());
    let l00 = pivot(A[(0, 0)])?;
    let (l10, l20) = (A[(1, 0)] / l00, A[(2, 0)] / l00);
    let l11 = pivot(A[(1, 1)] - l10 * l10)?;
    let l21 = (A[(2, 1)] - l20 * l10) / l11;
    let l22 = pivot(A[(2, 2)] - l20 * l20 - l21 * l21)?;
    Some(Matrix3::new(l00, 0.0, 0.0, l10, l11, 0.0, l20, l21, l22))
}

fn invert_lower(L: &Matrix3<f64>) -> Matrix3<f64> {
    let columns = [Vector3::x(), Vector3::y(), Vector3::z()].map(|unit| solve_lower(L, &unit));
    Matrix3::from_columns(&columns)
}

fn solve_lower(L: &Matrix3<f64>, b: &Vector3<f64>) -> Vector3<f64> {
    let x = b.x / L[(0, 0)];
    let y = (b.y - L[(1, 0)] * x) / L[(1, 1)];
    Vector3::new(x, y, (b.z - L[(2, 0)] * x - L[(2, 1)] * y) / L[(2, 2)])
}

fn solve_lower_transposed(L: &Matrix3<f64>, b: &Vector3<f64>) -> Vector3<f64> {
    let z = b.z / L[(2, 2)];
    let y = (b.y - L[(2, 1)] * z) / L[(1, 1)];
    Vector3::new((b.x - L[(1, 0)] * y - L[(2, 0)] * z) / L[(0, 0)], y, z)
}
