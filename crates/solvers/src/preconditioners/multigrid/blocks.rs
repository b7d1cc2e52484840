//! Sparse matrices of R×C blocks, in single precision for cycles and in double for products, whose sparsity patterns are fixed.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use fem_elements::number::vectorized;
use fem_elements::threads::join;

/// A matrix in block compressed sparse rows.
#[derive(Clone)]
pub struct Blocks<const R: usize, const C: usize, F = f32> {
    /// `starts[i]..starts[i + 1]` are the blocks of row i.
    pub starts: Vec<usize>,
    /// Column of each block, ascending within a row.
    pub columns: Vec<u32>,
    pub values: Vec<[[F; C]; R]>,
}

impl<const R: usize, const C: usize, F: Copy + Default> Blocks<R, C, F> {
    /// A zero matrix with this sparsity pattern.
    pub fn zeros(starts: Vec<usize>, columns: Vec<u32>) -> Self {
        let values = vec![[[F::default(); C]; R]; columns.len()];
        Self { starts, columns, values }
    }

    /// A zero matrix with the sparsity pattern of A B.
    pub fn product<const K: usize, G, H>(A: &Blocks<R, K, G>, B: &Blocks<K, C, H>) -> Self
    where
        G: Copy + Default,
        H: Copy + Default,
    {
        let (mut starts, mut columns, mut row) = (vec![0], Vec::new(), Vec::new());
        for i in 0..A.rows() {
            row.clear();
            for &k in A.row(i).0 {
                row.extend(B.row(k as usize).0);
            }
            row.sort_unstable();
            row.dedup();
            columns.extend(&row);
            starts.push(columns.len());
        }
        Self::zeros(starts, columns)
    }

    /// A zero matrix with this sparsity pattern, but in each row without the blocks right of the last one that B has there.
    pub fn left_of_last<const K: usize, G: Copy + Default>(self, B: &Blocks<R, K, G>) -> Self {
        let (mut starts, mut columns) = (vec![0], Vec::with_capacity(self.columns.len()));
        for row in 0..self.rows() {
            let last = B.row(row).0.last();
            columns.extend(self.row(row).0.iter().take_while(|&column| Some(column) <= last));
            starts.push(columns.len());
        }
        columns.shrink_to_fit();
        Self::zeros(starts, columns)
    }

    /// A zero matrix with the sparsity pattern of Aᵀ, for A of `columns` columns, and the number in A of each block's
    /// transpose.
    pub fn transpose(A: &Blocks<C, R, F>, columns: usize) -> (Self, Vec<u32>) {
        let mut starts = vec![0; columns + 1];
        A.columns.iter().for_each(|&column| starts[column as usize + 1] += 1);
        for column in 0..columns {
            starts[column + 1] += starts[column];
        }
        let mut next = starts.clone();
        let (mut rows, mut sources) = (vec![0; A.columns.len()], vec![0; A.columns.len()]);
        for row in 0..A.rows() {
            for block in A.starts[row]..A.starts[row + 1] {
                let place = &mut next[A.columns[block] as usize];
                rows[*place] = row as u32;
                sources[*place] = block as u32;
                *place += 1;
            }
        }
        (Self::zeros(starts, rows), sources)
    }

    pub fn rows(&self) -> usize {
        self.starts.len() - 1
    }

    /// Columns and values of a row.
    pub fn row(&self, row: usize) -> (&[u32], &[[[F; C]; R]]) {
        let blocks = self.starts[row]..self.starts[row + 1];
        (&self.columns[blocks.clone()], &self.values[blocks])
    }

    pub fn bytes(&self) -> usize {
        size_of_val(self.starts.as_slice()) + size_of_val(self.columns.as_slice()) + size_of_val(self.values.as_slice())
    }
}

/// Up to this many rows one thread computes.
const ROWS: usize = 256;

/// C = A B in double precision for a C from [`Blocks::product`], or those blocks of it that C has at the beginning of each row.
pub fn multiply<F, G, const R: usize, const K: usize, const C: usize>(
    A: &Blocks<R, K, F>,
    B: &Blocks<K, C, G>,
    product: &mut Blocks<R, C, f64>,
) where
    F: Copy + Default + Into<f64> + Sync,
    G: Copy + Default + Into<f64> + Sync,
{
    let Blocks { starts, columns, values } = product;
    Product { A, B, starts, columns, last: |_, columns| columns.last().copied(), rows: 0..A.rows(), values }.compute();
}

/// The same where C is symmetric: its lower half, which is copied to the upper one. `slots` is workspace with an entry for each row.
pub fn multiply_symmetric<const K: usize, const C: usize>(
    A: &Blocks<C, K>,
    B: &Blocks<K, C, f64>,
    product: &mut Blocks<C, C, f64>,
    slots: &mut [u32],
) {
    let Blocks { starts, columns, values } = product;
    Product { A, B, starts, columns, last: |row, _| Some(row as u32), rows: 0..A.rows(), values }.compute();
    // Rows ascend, so the blocks of a column go one after another to the row of that number.
    for row in 0..A.rows() {
        for block in starts[row]..starts[row + 1] {
            let column = columns[block] as usize;
            if column == row {
                slots[row] = block as u32 + 1;
                break;
            }
            let lower = values[block];
            values[slots[column] as usize] = std::array::from_fn(|i| std::array::from_fn(|j| lower[j][i]));
            slots[column] += 1;
        }
    }
}

/// Some rows of a product.
struct Product<'a, F, G, const R: usize, const K: usize, const C: usize> {
    A: &'a Blocks<R, K, F>,
    B: &'a Blocks<K, C, G>,
    /// The pattern of the product.
    starts: &'a [usize],
    columns: &'a [u32],
    /// The last column that is computed in a row, from the number and the columns of the row.
    last: fn(usize, &[u32]) -> Option<u32>,
    rows: Range<usize>,
    /// The values in these rows.
    values: &'a mut [[[f64; C]; R]],
}

impl<F, G, const R: usize, const K: usize, const C: usize> Product<'_, F, G, R, K, C>
where
    F: Copy + Default + Into<f64> + Sync,
    G: Copy + Default + Into<f64> + Sync,
{
    /// Halves of many rows side by side. Each row is computed in one order, so that the threads do not change a bit.
    fn compute(self) {
        if self.rows.len() <= ROWS {
            return vectorized(self);
        }
        let Self { A, B, starts, columns, last, rows, values } = self;
        let middle = rows.start + rows.len() / 2;
        let (left, right) = values.split_at_mut(starts[middle] - starts[rows.start]);
        let part = |rows, values| Product { A, B, starts, columns, last, rows, values };
        let (left, right) = (part(rows.start..middle, left), part(middle..rows.end, right));
        join(|| left.compute(), || right.compute());
    }
}

impl<F, G, const R: usize, const K: usize, const C: usize> WithSimd for Product<'_, F, G, R, K, C>
where
    F: Copy + Default + Into<f64>,
    G: Copy + Default + Into<f64>,
{
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        let Self { A, B, starts, columns: of_product, last, rows, values } = self;
        let first = starts[rows.start];
        for i in rows {
            let of_row = &of_product[starts[i]..starts[i + 1]];
            let row = &mut values[starts[i] - first..][..of_row.len()];
            row.fill([[0.0; C]; R]);
            let last = last(i, of_row);
            let (columns, values) = A.row(i);
            for (&k, a) in columns.iter().zip(values) {
                let a = double(a);
                let (columns, values) = B.row(k as usize);
                let mut place = 0;
                for (&column, b) in columns.iter().zip(values).take_while(|(column, _)| Some(**column) <= last) {
                    place += of_row[place..].partition_point(|&other| other < column);
                    add_product(&a, &double(b), &mut row[place]);
                }
            }
        }
    }
}

/// c += a b
#[inline(always)]
pub fn add_product<const R: usize, const K: usize, const C: usize>(
    a: &[[f64; K]; R],
    b: &[[f64; C]; K],
    c: &mut [[f64; C]; R],
) {
    for i in 0..R {
        let mut row = c[i];
        for k in 0..K {
            for j in 0..C {
                row[j] += a[i][k] * b[k][j];
            }
        }
        c[i] = row;
    }
}

/// A block in double precision.
#[inline(always)]
pub fn double<F: Copy + Into<f64>, const R: usize, const C: usize>(block: &[[F; C]; R]) -> [[f64; C]; R] {
    let mut double = [[0.0; C]; R];
    for i in 0..R {
        for j in 0..C {
            double[i][j] = block[i][j].into();
        }
    }
    double
}

/// Row i of A x.
#[inline(always)]
pub fn row_times<const R: usize, const C: usize>(A: &Blocks<R, C>, row: usize, x: &[[f32; C]]) -> [f32; R] {
    let (columns, values) = A.row(row);
    sum_products(columns, values, 0, x)
}

/// Sum of blocks times entries of x, which begins with row `first`. Each entry of a block has a sum of its own, so that no addition waits
/// for another.
#[inline(always)]
pub fn sum_products<const R: usize, const C: usize>(
    columns: &[u32],
    values: &[[[f32; C]; R]],
    first: usize,
    x: &[[f32; C]],
) -> [f32; R] {
    let mut sums = [[0.0; C]; R];
    for (&column, block) in columns.iter().zip(values) {
        let x = &x[column as usize - first];
        for i in 0..R {
            for j in 0..C {
                sums[i][j] += block[i][j] * x[j];
            }
        }
    }
    sums.map(|sums| sums.iter().sum())
}
