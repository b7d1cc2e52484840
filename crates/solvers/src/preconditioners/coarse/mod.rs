//! The coarse-grid correction P (Pᵀ A P)⁻¹ Pᵀ with trilinear functions P, for smooth errors, which sweeps reduce slowly. It is
//! added to the sweeps: Bramble, Pasciak and Xu, Parallel Multilevel Preconditioners (1990), with two levels.

mod grid;
mod history;
#[cfg(feature = "gpu")]
mod inverse;

use nalgebra::Vector3;
use pulp::{Simd, WithSimd};

use super::lower_half::LowerHalf;
use crate::ApproximateInverse;
use crate::direct::SupernodalCholesky;
use crate::numbering::{Numbering, Ordering};
use fem_elements::Real;
use fem_elements::number::vectorized;
use fem_elements::sparse::{Block, Pattern, Stored};
use fem_elements::vector::triple;
pub use grid::{CellPoint, Grid};

/// Weight of the coarse correction: the sweeps reduce a part of the smooth error as well.
const WEIGHT: f32 = 0.5;

/// Relative shift of the coarse diagonal: the functions of cells with few nodes are not independent.
const SHIFT: f32 = 1e-4;

/// The coarse matrix is assembled and factorised again if a solve takes more iterations than `.0 + .1` × those of its first
/// solve.
const REFACTOR: (f64, f64) = (3.0, 1.5);

/// A row of three numbers, and a zero that fills a register.
pub type Row = [f32; 4];

/// The grid, and the factor of its matrix Pᵀ A P.
pub struct Coarse {
    pub grid: Grid,
    /// The pair of cells that each block of the lower half couples, diagonal blocks last in their rows.
    pairs: Vec<u32>,
    /// The coarse blocks of the products of the functions of each pair of cells.
    slots: Vec<[Slot; 64]>,
    sums: Vec<[Row; 3]>,
    values: Vec<Block<f32, 3>>,
    /// Pattern of the coarse matrix.
    pattern: Pattern,
    factor: SupernodalCholesky<f32>,
    /// Scale of the matrix that was factorised; `None` without a factor.
    scale: Option<f64>,
    /// Iterations per factor e of the residual in the first solve with this factor.
    effort: Option<f64>,
    /// True if the next preparation must factorise again.
    is_outdated: bool,
    /// Weight of the correction, for the scale of the present matrix.
    pub weight: f32,
    /// 1 for each free direction of a row, 0 for a constrained one, which the fine matrix does not couple to others.
    pub free: Vec<[f32; 3]>,
    /// Pᵀ r, and its decrease in a step of length 1.
    pub residual: Vec<Row>,
    pub change: Vec<Row>,
    /// The correction at the corners.
    pub correction: Vec<Row>,
    b: Vec<[f32; 3]>,
    x: Vec<[f32; 3]>,
}

/// A block of the coarse matrix, and the form in which a fine block is added to it.
#[derive(Clone, Copy)]
struct Slot {
    block: u32,
    form: u32,
}

/// Forms: as it is; transposed, for a block across the diagonal; the sum of both, for a block on the diagonal.
const PLAIN: u32 = 0;
const TRANSPOSED: u32 = 1;
const BOTH: u32 = 2;

impl Coarse {
    /// A grid of at most so many corners for a matrix and the undeformed positions of its nodes, m.
    pub fn new(fine: &LowerHalf, rest: &[[f64; 3]], most_corners: usize) -> Self {
        let mut grid = Grid::with_most_corners(fine, rest, most_corners);
        let cell = |node: usize| grid.nodes[node].cell;
        let lower = |row: usize| fine.row(row).map(|block| fine.columns[block] as usize).chain([row]);
        let rows = 0..fine.rows();
        let coupled: Vec<[u32; 2]> =
            rows.flat_map(|row| lower(row).map(move |column| (row, column))).map(|(i, j)| [cell(i), cell(j)]).collect();
        let mut kinds = coupled.clone();
        kinds.sort_unstable();
        kinds.dedup();
        let pairs = coupled.iter().map(|pair| kinds.binary_search(pair).unwrap_or_default() as u32).collect();
        let matrix = renumber(&mut grid, &kinds);
        let slots =
            kinds.iter().map(|&[a, b]| slots(&matrix, &grid.cells[a as usize], &grid.cells[b as usize])).collect();
        let zeros = vec![[0.0; 4]; matrix.rows()];
        Self {
            grid,
            pairs,
            slots,
            sums: vec![[[0.0; 4]; 3]; matrix.blocks()],
            values: vec![[[0.0; 3]; 3]; matrix.blocks()],
            factor: SupernodalCholesky::new(&matrix),
            scale: None,
            effort: None,
            is_outdated: true,
            weight: 0.0,
            free: vec![[0.0; 3]; fine.rows()],
            residual: zeros.clone(),
            change: zeros.clone(),
            correction: zeros,
            b: vec![[0.0; 3]; matrix.rows()],
            x: vec![[0.0; 3]; matrix.rows()],
            pattern: matrix,
        }
    }

    /// Assembles and factorises the coarse matrix, unless an earlier factor still serves. `values` holds the fine matrix. Returns whether
    /// there is another factor.
    pub fn prepare<T: Real>(&mut self, fine: &LowerHalf, values: &[Block<T, 3>], scale: f64) -> bool {
        let is_new = self.needs_factor();
        if is_new {
            (self.is_outdated, self.effort) = (false, None);
            self.find_free_directions(fine, values);
            self.assemble(fine, values, scale);
            self.scale = self.factor.prepare(&self.values).is_ok().then_some(scale);
        }
        self.weight = self.scale.map_or(0.0, |then| WEIGHT * (then / scale) as f32);
        is_new
    }

    /// Returns true if the next preparation assembles and factorises.
    pub fn needs_factor(&self) -> bool {
        self.is_outdated || self.scale.is_none()
    }

    /// Finds the directions that the matrix couples to others.
    fn find_free_directions<T: Real>(&mut self, fine: &LowerHalf, values: &[Block<T, 3>]) {
        self.free.fill([0.0; 3]);
        for row in 0..self.free.len() {
            for block in fine.row(row) {
                let (column, A) = (fine.columns[block] as usize, &values[fine.sources[block] as usize]);
                for_each_nonzero(A, |i, j| {
                    self.free[row][i] = 1.0;
                    self.free[column][j] = 1.0;
                });
            }
            for_each_nonzero(&values[fine.diagonal[row] as usize], |i, j| {
                if i != j {
                    self.free[row][i] = 1.0;
                }
            });
        }
    }

    /// Assembles Pᵀ A P.
    fn assemble<T: Real>(&mut self, fine: &LowerHalf, values: &[Block<T, 3>], scale: f64) {
        self.sums.fill([[0.0; 4]; 3]);
        let mut pairs = self.pairs.iter();
        let mut add = |row: usize, column: usize, block: u32| {
            let Some(&pair) = pairs.next() else { return };
            let (free_row, free_column) = (&self.free[row], &self.free[column]);
            let A: Block<f32, 3> = triple(|i| {
                triple(|j| (values[block as usize][i][j].as_f64() * scale) as f32 * free_row[i] * free_column[j])
            });
            let (rows, columns) = (self.grid.nodes[row].weights(), self.grid.nodes[column].weights());
            let forms = forms(&A, row == column);
            vectorized(Products {
                slots: &self.slots[pair as usize],
                forms: &forms,
                rows,
                columns,
                sums: &mut self.sums,
            });
        };
        for row in 0..self.free.len() {
            fine.row(row).for_each(|block| add(row, fine.columns[block] as usize, fine.sources[block]));
            add(row, row, fine.diagonal[row]);
        }
        for (value, sum) in self.values.iter_mut().zip(&self.sums) {
            *value = sum.map(|row| [row[0], row[1], row[2]]);
        }
        for block in self.pattern.diagonal() {
            for i in 0..3 {
                let entry = &mut self.values[block][i][i];
                *entry = if *entry > 0.0 { *entry * (1.0 + SHIFT) } else { 1.0 };
            }
        }
    }

    /// Computes the correction for the coarse residual; returns their inner product.
    pub fn solve(&mut self) -> f64 {
        if self.scale.is_none() {
            return 0.0;
        }
        for (b, r) in self.b.iter_mut().zip(&self.residual) {
            b.copy_from_slice(&r[..3]);
        }
        self.factor.apply(&self.b, &mut self.x);
        let mut product = 0.0;
        for ((correction, x), b) in self.correction.iter_mut().zip(&self.x).zip(&self.b) {
            for i in 0..3 {
                correction[i] = self.weight * x[i];
                product += f64::from(correction[i] * b[i]);
            }
        }
        product
    }

    /// Records the iterations of a solve to `tolerance`, `None` if it failed. A solve that fails or takes many more iterations
    /// than the first one makes the factor outdated.
    pub fn record_effort(&mut self, iterations: Option<usize>, tolerance: f64) {
        let powers = -tolerance.ln().min(-1.0);
        let mut limit = |first: f64| REFACTOR.0 + REFACTOR.1 * powers * *self.effort.get_or_insert(first / powers);
        self.is_outdated |= iterations.is_none_or(|count| count as f64 > limit(count as f64));
    }

    pub fn bytes(&self) -> usize {
        let numbers = size_of_val(self.pairs.as_slice()) + size_of_val(self.slots.as_slice()) + self.pattern.bytes();
        let matrix = size_of_val(self.sums.as_slice()) + size_of_val(self.values.as_slice()) + self.factor.bytes();
        let vectors = 3 * size_of_val(self.residual.as_slice()) + 2 * size_of_val(self.b.as_slice());
        numbers + matrix + vectors + self.grid.bytes() + size_of_val(self.free.as_slice())
    }
}

/// Visits the nonzero entries of a block.
fn for_each_nonzero<T: Real>(A: &Block<T, 3>, mut visit: impl FnMut(usize, usize)) {
    for i in 0..3 {
        for j in 0..3 {
            if A[i][j] != T::default() {
                visit(i, j);
            }
        }
    }
}

/// A fine block in each form.
fn forms(A: &Block<f32, 3>, is_diagonal: bool) -> [[Row; 3]; 3] {
    let other = if is_diagonal { 0.0 } else { 1.0 };
    let row = |of: &dyn Fn(usize) -> f32| [of(0), of(1), of(2), 0.0];
    [
        triple(|i| row(&|j| A[i][j])),
        triple(|i| row(&|j| other * A[j][i])),
        triple(|i| row(&|j| A[i][j] + other * A[j][i])),
    ]
}

/// Adds a fine block to the coarse blocks, times the products of its row's and its column's trilinear functions.
struct Products<'a> {
    slots: &'a [Slot; 64],
    forms: &'a [[Row; 3]; 3],
    rows: [f32; 8],
    columns: [f32; 8],
    sums: &'a mut [[Row; 3]],
}

impl WithSimd for Products<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) {
        for (number, slot) in self.slots.iter().enumerate() {
            let weight = self.rows[number / 8] * self.columns[number % 8];
            let (sum, form) = (&mut self.sums[slot.block as usize], &self.forms[slot.form as usize]);
            for i in 0..3 {
                for k in 0..4 {
                    sum[i][k] += weight * form[i][k];
                }
            }
        }
    }
}

/// Numbers the corners in a fill-reducing ordering. Returns the pattern of the coarse matrix.
fn renumber(grid: &mut Grid, pairs: &[[u32; 2]]) -> Pattern {
    let corners = |&[a, b]: &[u32; 2]| {
        let (a, b) = (grid.cells[a as usize], grid.cells[b as usize]);
        a.into_iter().flat_map(move |a| b.into_iter().map(move |b| [a.max(b) as usize, a.min(b) as usize]))
    };
    let mut joined: Vec<[usize; 2]> = pairs.iter().flat_map(corners).collect();
    joined.sort_unstable();
    joined.dedup();
    let positions: Vec<Vector3<f64>> = grid.corners.iter().map(|&x| Vector3::from(x)).collect();
    let numbering = Numbering::new(Ordering::FillReducing, &positions, &joined, &vec![false; positions.len()]);
    grid.renumber(&numbering.engine_node);
    Pattern::new(positions.len(), &numbering.elements(&joined), Stored::Lower)
}

/// The coarse blocks of the products of two cells' functions.
fn slots(matrix: &Pattern, a: &[u32; 8], b: &[u32; 8]) -> [Slot; 64] {
    std::array::from_fn(|number| {
        let (row, column) = (a[number / 8], b[number % 8]);
        let form = match row.cmp(&column) {
            std::cmp::Ordering::Greater => PLAIN,
            std::cmp::Ordering::Less => TRANSPOSED,
            std::cmp::Ordering::Equal => BOTH,
        };
        let block = matrix.find(row.max(column) as usize, row.min(column) as usize);
        Slot { block: block.unwrap_or_else(|| unreachable!("the pattern couples these corners")) as u32, form }
    })
}
