//! The smooth part of a correction, at which sweeps are slow, on a coarse grid: trilinear functions P, and the matrix Pᵀ A P
//! between them. It is added to the sweeps' own part: Bramble, Pasciak and Xu, Parallel Multilevel Preconditioners (1990), with
//! two levels.

use std::array::from_fn;

use nalgebra::Vector3;
use pulp::{Simd, WithSimd};

use super::Row;
use super::grid::Grid;
use super::scaled::Places;
use crate::model::numbering::{Numbering, Ordering};
use crate::number::{Real, vectorized};
use crate::solvers::supernodal::Supernodal;
use crate::sparse::{Pattern, Stored};

/// Part of the coarse correction that is taken: sweeps find some of it as well.
const TAKEN: f32 = 0.5;

/// Part by which the coarse diagonal is enlarged: where cells hold few nodes, their functions are not independent.
const ENLARGED: f32 = 1e-4;

/// An old matrix is worn when it takes more than so many iterations and, beyond them, so many times those of a new one.
const WORN: (f64, f64) = (3.0, 1.5);

/// Functions on a grid, and the factor of the matrix between them.
pub struct Coarse {
    pub grid: Grid,
    /// Which pair of cells each block of the lower half couples, the diagonal included, in the order of the rows.
    pairs: Vec<u32>,
    /// Where the products of a pair's functions go.
    slots: Vec<[Slot; 64]>,
    sums: Vec<[Row; 3]>,
    values: Vec<[[f32; 3]; 3]>,
    /// Where the blocks of the coarse matrix are.
    pattern: Pattern,
    factor: Supernodal<f32>,
    /// What the matrix was multiplied with that the factor is of; none without a factor.
    scale: Option<f64>,
    /// Iterations that the first solve with this factor took for each power of e.
    effort: Option<f64>,
    is_worn: bool,
    /// How much of E⁻¹ is taken, for the present matrix.
    taken: f32,
    /// 1 for directions of each row that the fine matrix couples to others, 0 for those that are held.
    pub moves: Vec<[f32; 3]>,
    /// Pᵀ r, and what a step of length 1 takes from it.
    pub residual: Vec<Row>,
    pub change: Vec<Row>,
    /// What is added at the corners.
    pub correction: Vec<Row>,
    b: Vec<[f32; 3]>,
    x: Vec<[f32; 3]>,
}

/// A block of the matrix, and in which form a block of the fine one is added to it.
#[derive(Clone, Copy)]
struct Slot {
    block: u32,
    form: u32,
}

/// As it is; transposed, because the block is on the other side of the diagonal; or both, because it is on the diagonal.
const PLAIN: u32 = 0;
const TRANSPOSED: u32 = 1;
const BOTH: u32 = 2;

impl Coarse {
    /// A grid for a pattern of which all blocks are stored, or the lower half.
    pub fn new(pattern: &Pattern, rest: &[[f64; 3]]) -> Self {
        let mut grid = Grid::new(pattern, rest);
        let cell = |node: usize| grid.inside[node].cell;
        let rows = 0..pattern.rows();
        let coupled: Vec<[u32; 2]> = rows
            .flat_map(|row| lower(pattern, row).map(move |column| (row, column)))
            .map(|(i, j)| [cell(i), cell(j)])
            .collect();
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
            factor: Supernodal::new(&matrix),
            scale: None,
            effort: None,
            is_worn: true,
            taken: 0.0,
            moves: vec![[0.0; 3]; pattern.rows()],
            residual: zeros.clone(),
            change: zeros.clone(),
            correction: zeros,
            b: vec![[0.0; 3]; matrix.rows()],
            x: vec![[0.0; 3]; matrix.rows()],
            pattern: matrix,
        }
    }

    /// The matrix between the functions, and its factor, unless those that are there still serve. `values` holds the fine one.
    pub fn prepare<T: Real>(&mut self, places: &Places, values: &[[[T; 3]; 3]], scale: f64) {
        if self.is_worn || self.scale.is_none() {
            (self.is_worn, self.effort) = (false, None);
            self.find_held(places, values);
            self.add_up(places, values, scale);
            self.scale = self.factor.prepare(&self.values).is_ok().then_some(scale);
        }
        self.taken = self.scale.map_or(0.0, |then| TAKEN * (then / scale) as f32);
    }

    /// Which directions the matrix couples to nothing else.
    fn find_held<T: Real>(&mut self, places: &Places, values: &[[[T; 3]; 3]]) {
        self.moves.fill([0.0; 3]);
        for row in 0..self.moves.len() {
            for block in places.row(row) {
                let (column, A) = (places.columns[block] as usize, &values[places.sources[block] as usize]);
                couple(A, |i, j| {
                    self.moves[row][i] = 1.0;
                    self.moves[column][j] = 1.0;
                });
            }
            couple(&values[places.diagonal[row] as usize], |i, j| {
                if i != j {
                    self.moves[row][i] = 1.0;
                }
            });
        }
    }

    /// Pᵀ A P.
    fn add_up<T: Real>(&mut self, places: &Places, values: &[[[T; 3]; 3]], scale: f64) {
        self.sums.fill([[0.0; 4]; 3]);
        let mut pairs = self.pairs.iter();
        let mut add = |row: usize, column: usize, block: u32| {
            let Some(&pair) = pairs.next() else { return };
            let (mine, other) = (&self.moves[row], &self.moves[column]);
            let A: [[f32; 3]; 3] =
                from_fn(|i| from_fn(|j| (values[block as usize][i][j].as_f64() * scale) as f32 * mine[i] * other[j]));
            let (rows, columns) = (self.grid.inside[row].weights(), self.grid.inside[column].weights());
            let forms = forms(&A, row == column);
            vectorized(Products {
                slots: &self.slots[pair as usize],
                forms: &forms,
                rows,
                columns,
                sums: &mut self.sums,
            });
        };
        for row in 0..self.moves.len() {
            places.row(row).for_each(|block| add(row, places.columns[block] as usize, places.sources[block]));
            add(row, row, places.diagonal[row]);
        }
        for (value, sum) in self.values.iter_mut().zip(&self.sums) {
            *value = sum.map(|row| [row[0], row[1], row[2]]);
        }
        for block in self.pattern.diagonal() {
            for i in 0..3 {
                let entry = &mut self.values[block][i][i];
                *entry = if *entry > 0.0 { *entry * (1.0 + ENLARGED) } else { 1.0 };
            }
        }
    }

    /// Adds a node's part of Pᵀ r.
    pub fn restrict(&mut self, row: usize, r: &[f32; 3]) {
        let (inside, moves) = (&self.grid.inside[row], &self.moves[row]);
        for (&corner, weight) in self.grid.cells[inside.cell as usize].iter().zip(inside.weights()) {
            (0..3).for_each(|i| self.residual[corner as usize][i] += weight * moves[i] * r[i]);
        }
    }

    /// The correction for the residual; returns their product.
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
                correction[i] = self.taken * x[i];
                product += f64::from(correction[i] * b[i]);
            }
        }
        product
    }

    /// Takes note of how many iterations made the residual so many times smaller; none did where this matrix may be why not.
    pub fn wear(&mut self, iterations: Option<usize>, tolerance: f64) {
        let powers = -tolerance.ln().min(-1.0);
        let mut most = |first: f64| WORN.0 + WORN.1 * powers * *self.effort.get_or_insert(first / powers);
        self.is_worn |= iterations.is_none_or(|count| count as f64 > most(count as f64));
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let numbers = size_of_val(self.pairs.as_slice()) + size_of_val(self.slots.as_slice()) + self.pattern.bytes();
        let matrix = size_of_val(self.sums.as_slice()) + size_of_val(self.values.as_slice()) + self.factor.bytes();
        let vectors = 3 * size_of_val(self.residual.as_slice()) + 2 * size_of_val(self.b.as_slice());
        numbers + matrix + vectors + self.grid.bytes() + size_of_val(self.moves.as_slice())
    }
}

/// Entries of a block that are not 0.
fn couple<T: Real>(A: &[[T; 3]; 3], mut found: impl FnMut(usize, usize)) {
    for i in 0..3 {
        for j in 0..3 {
            if A[i][j] != T::default() {
                found(i, j);
            }
        }
    }
}

/// What a block is added as, in each form.
fn forms(A: &[[f32; 3]; 3], is_diagonal: bool) -> [[Row; 3]; 3] {
    let other = if is_diagonal { 0.0 } else { 1.0 };
    let row = |of: &dyn Fn(usize) -> f32| [of(0), of(1), of(2), 0.0];
    [
        from_fn(|i| row(&|j| A[i][j])),
        from_fn(|i| row(&|j| other * A[j][i])),
        from_fn(|i| row(&|j| A[i][j] + other * A[j][i])),
    ]
}

/// Adds a fine block, times each two functions of the cells of its row and its column, to the sums.
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

/// Columns of a row up to the diagonal.
fn lower(pattern: &Pattern, row: usize) -> impl Iterator<Item = usize> {
    pattern.columns[pattern.row(row)].iter().map(|&column| column as usize).filter(move |&column| column <= row)
}

/// Numbers the corners so that a factor fills in little. Returns the pattern of their matrix.
fn renumber(grid: &mut Grid, pairs: &[[u32; 2]]) -> Pattern {
    let corners = |&[a, b]: &[u32; 2]| {
        let (a, b) = (grid.cells[a as usize], grid.cells[b as usize]);
        a.into_iter().flat_map(move |a| b.into_iter().map(move |b| [a.max(b) as usize, a.min(b) as usize]))
    };
    let mut joined: Vec<[usize; 2]> = pairs.iter().flat_map(corners).collect();
    joined.sort_unstable();
    joined.dedup();
    let places: Vec<Vector3<f64>> = grid.corners.iter().map(|&x| Vector3::from(x)).collect();
    let order = Numbering::new(Ordering::Dissected, &places, &joined, &vec![false; places.len()]);
    grid.renumber(&order.engine_node);
    Pattern::new(places.len(), &order.elements(&joined), Stored::Lower)
}

/// Where the products of two cells' functions go.
fn slots(matrix: &Pattern, a: &[u32; 8], b: &[u32; 8]) -> [Slot; 64] {
    from_fn(|number| {
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

#[cfg(test)]
mod tests;
