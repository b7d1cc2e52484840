//! A sparse factorization A = L D Lᵀ for references: up-looking, row by row, by the elimination tree. T. A. Davis, "Algorithm 849: a
//! concise sparse Cholesky factorization package", ACM Transactions on Mathematical Software 31, 2005.
//!
//! It shares no code with the solvers under test.

/// No parent in the tree.
const ROOT: usize = usize::MAX;

/// The factor of a symmetric positive definite matrix.
#[derive(Clone, Debug)]
pub struct Ldl {
    /// Start of each column of L. Its entries are below the diagonal, which is 1.
    starts: Vec<usize>,
    rows: Vec<usize>,
    values: Vec<f64>,
    diagonal: Vec<f64>,
}

impl Ldl {
    /// Factorises a matrix given by its columns: entries `(row, value)` with row ≤ column, in any order, none twice. `None`
    /// where it is not positive definite.
    pub fn new(columns: &[Vec<(usize, f64)>]) -> Option<Self> {
        let n = columns.len();
        let (parent, counts) = tree(columns);
        let mut starts = vec![0; n + 1];
        for k in 0..n {
            starts[k + 1] = starts[k] + counts[k];
        }
        let mut factor =
            Self { rows: vec![0; starts[n]], values: vec![0.0; starts[n]], diagonal: vec![0.0; n], starts };
        let mut row = Row { y: vec![0.0; n], flag: vec![ROOT; n], pattern: vec![0; n], filled: vec![0; n] };
        (0..n).all(|k| factor.add_row(k, &columns[k], &parent, &mut row)).then_some(factor)
    }

    /// Row k of L and the k-th entry of D: a sparse triangular solve with the rows above.
    fn add_row(&mut self, k: usize, column: &[(usize, f64)], parent: &[usize], row: &mut Row) -> bool {
        let n = parent.len();
        let mut top = n;
        row.flag[k] = k;
        for &(i, value) in column {
            row.y[i] += value;
            let (mut node, mut length) = (i, 0);
            while row.flag[node] != k {
                row.pattern[length] = node;
                length += 1;
                row.flag[node] = k;
                node = parent[node];
            }
            while length > 0 {
                (top, length) = (top - 1, length - 1);
                row.pattern[top] = row.pattern[length];
            }
        }
        let mut d = std::mem::take(&mut row.y[k]);
        for place in top..n {
            let i = row.pattern[place];
            let y = std::mem::take(&mut row.y[i]);
            let (start, end) = (self.starts[i], self.starts[i] + row.filled[i]);
            for p in start..end {
                row.y[self.rows[p]] -= self.values[p] * y;
            }
            let l = y / self.diagonal[i];
            d -= l * y;
            (self.rows[end], self.values[end]) = (k, l);
            row.filled[i] += 1;
        }
        self.diagonal[k] = d;
        d > 0.0
    }

    /// Solves A x = b in place, for several right sides at once.
    pub fn solve<const D: usize>(&self, x: &mut [[f64; D]]) {
        let n = self.diagonal.len();
        for j in 0..n {
            let xj = x[j];
            for p in self.starts[j]..self.starts[j + 1] {
                let (row, l) = (self.rows[p], self.values[p]);
                for c in 0..D {
                    x[row][c] -= l * xj[c];
                }
            }
        }
        for j in (0..n).rev() {
            let mut xj = x[j].map(|x| x / self.diagonal[j]);
            for p in self.starts[j]..self.starts[j + 1] {
                let (row, l) = (self.rows[p], self.values[p]);
                for c in 0..D {
                    xj[c] -= l * x[row][c];
                }
            }
            x[j] = xj;
        }
    }
}

/// Working memory of a row.
struct Row {
    y: Vec<f64>,
    flag: Vec<usize>,
    pattern: Vec<usize>,
    filled: Vec<usize>,
}

/// The elimination tree, and how many entries each column of L has.
fn tree(columns: &[Vec<(usize, f64)>]) -> (Vec<usize>, Vec<usize>) {
    let n = columns.len();
    let (mut parent, mut flag, mut counts) = (vec![ROOT; n], vec![ROOT; n], vec![0; n]);
    for k in 0..n {
        flag[k] = k;
        for &(i, _) in &columns[k] {
            let mut node = i;
            while flag[node] != k {
                if parent[node] == ROOT {
                    parent[node] = k;
                }
                counts[node] += 1;
                flag[node] = k;
                node = parent[node];
            }
        }
    }
    (parent, counts)
}
