//! The scaled matrix G⁻¹ A G⁻ᵀ = L̃ + K + 2 + L̃ᵀ in single precision.

use std::ops::Range;

use pulp::{Simd, WithSimd};

use super::super::lower_half::LowerHalf;
use crate::block::{factor, invert_lower};
use crate::parts::Part;
use fem_elements::Real;
use fem_elements::number::vectorized;
use fem_elements::sparse::{Block, Pattern};
use fem_elements::tensor::map;
use fem_elements::threads::join;
use fem_elements::vector::triple;
use fem_model::simulation::Breakdown;

/// Fractions of the diagonal's change by an incomplete factorisation, tried one after the other until all blocks are positive
/// definite. On beams ½ takes the fewest iterations and 1 mostly breaks down; 0 is symmetric Gauss–Seidel.
const FRACTIONS: [f32; 2] = [0.5, 0.0];

/// Fraction of a diagonal entry that must remain.
const MIN_DIAGONAL: f32 = 0.02;

/// The lower triangle of a 3×3 block, row by row.
pub type Triangle = [f32; 6];

/// Row and column of each entry of a [`Triangle`].
const LOWER: [(usize, usize); 6] = [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2)];

/// A scaled matrix.
pub struct Scaled {
    pub pattern: LowerHalf,
    /// L̃, row by row, and one number more, so that a register of four can be read at the last row of a block.
    pub L: Vec<f32>,
    /// The lower triangles of K.
    pub K: Vec<Triangle>,
    /// G⁻¹.
    pub inverses: Vec<Block<f32, 3>>,
    /// G, with zeros in the rows of constrained directions.
    pub G: Vec<Triangle>,
    /// Factor by which the matrix is scaled into the range of single precision.
    pub scale: f64,
}

impl Scaled {
    /// Takes the lower half of a pattern, which may store all blocks.
    pub fn new(pattern: &Pattern) -> Self {
        let lower = LowerHalf::new(pattern);
        let rows = pattern.rows();
        Self {
            L: vec![0.0; 9 * lower.columns.len() + 1],
            K: vec![[0.0; 6]; rows],
            inverses: vec![[[0.0; 3]; 3]; rows],
            G: vec![[0.0; 6]; rows],
            pattern: lower,
            scale: 1.0,
        }
    }

    /// Computes L̃, K and G. `free` is 1 for each free direction of a row and 0 for a constrained one.
    pub fn prepare<T: Real>(
        &mut self,
        values: &[Block<T, 3>],
        free: &[[f32; 3]],
        parts: &Part,
    ) -> Result<(), Breakdown> {
        let mut outcome = Ok(());
        for fraction in FRACTIONS {
            let Self { pattern, L, K, G, inverses, scale } = self;
            let rows = Rows { pattern, values, free, fraction, scale: *scale, first: 0, L, K, G, inverses };
            outcome = rows.factor(parts);
            if outcome.is_ok() {
                break;
            }
        }
        outcome
    }

    pub fn bytes(&self) -> usize {
        let triangles = size_of_val(self.K.as_slice()) + size_of_val(self.G.as_slice());
        self.pattern.bytes() + size_of_val(self.L.as_slice()) + triangles + size_of_val(self.inverses.as_slice())
    }
}

/// Consecutive rows, from `first` on.
struct Rows<'a, T> {
    pattern: &'a LowerHalf,
    values: &'a [Block<T, 3>],
    free: &'a [[f32; 3]],
    fraction: f32,
    scale: f64,
    first: usize,
    L: &'a mut [f32],
    K: &'a mut [Triangle],
    G: &'a mut [Triangle],
    inverses: &'a mut [Block<f32, 3>],
}

impl<T: Real> Rows<'_, T> {
    /// Factorises the rows of a part: its halves side by side, then its own.
    fn factor(mut self, part: &Part) -> Result<(), Breakdown> {
        if let Some([left, right]) = part.halves.as_deref() {
            let [a, rest] = self.reborrow().split(right.rows.start);
            let [b, _] = rest.split(right.rows.end);
            let (a, b) = join(|| a.factor(left), || b.factor(right));
            a.and(b)?;
        }
        vectorized(Factor { all: self, rows: part.own() })
    }

    fn reborrow(&mut self) -> Rows<'_, T> {
        let Self { pattern, values, free, fraction, scale, first, L, K, G, inverses } = self;
        Rows { pattern, values, free, fraction: *fraction, scale: *scale, first: *first, L, K, G, inverses }
    }

    /// The rows before and from `middle` on.
    fn split(self, middle: usize) -> [Self; 2] {
        let Self { pattern, values, free, fraction, scale, first, L, K, G, inverses } = self;
        let (L, L_right) = L.split_at_mut(9 * (pattern.row(middle).start - pattern.row(first).start));
        let (K, K_right) = K.split_at_mut(middle - first);
        let (G, G_right) = G.split_at_mut(middle - first);
        let (inverses, inverses_right) = inverses.split_at_mut(middle - first);
        let rows = |first, L, K, G, inverses| Self { pattern, values, free, fraction, scale, first, L, K, G, inverses };
        [rows(first, L, K, G, inverses), rows(middle, L_right, K_right, G_right, inverses_right)]
    }
}

/// The factorisation of some rows, whose blocks are in columns of rows that are factorised before.
struct Factor<'a, T> {
    all: Rows<'a, T>,
    rows: Range<usize>,
}

impl<T: Real> WithSimd for Factor<'_, T> {
    type Output = Result<(), Breakdown>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> Result<(), Breakdown> {
        let Rows { pattern, values, free, fraction, scale, first, L, K, G, inverses } = self.all;
        let single = |block: u32| map(&values[block as usize], |entry| (entry.as_f64() * scale) as f32);
        let first_block = pattern.row(first).start;
        for row in self.rows {
            let blocks = pattern.row(row);
            let own = &mut L[9 * (blocks.start - first_block)..][..9 * blocks.len()];
            let (own, _) = own.as_chunks_mut::<9>();
            let diagonal = single(pattern.diagonal[row]);
            let mut W = diagonal;
            for (block, L) in blocks.zip(own.iter_mut()) {
                let column = pattern.columns[block] as usize - first;
                let half = times_transpose(&single(pattern.sources[block]), &inverses[column]);
                for i in 0..3 {
                    for j in 0..3 {
                        W[i][j] -= fraction * (0..3).map(|k| half[i][k] * half[j][k]).sum::<f32>();
                    }
                }
                L.copy_from_slice(half.as_flattened());
            }
            if fraction > 0.0 && (0..3).any(|i| !(W[i][i] > MIN_DIAGONAL * diagonal[i][i])) {
                return Err(Breakdown::NotPositiveDefinite);
            }
            let root = factor(&W)?;
            let inverse = invert_lower(&root);
            G[row - first] = LOWER.map(|(i, j)| free[row][i] * root[i][j]);
            for L in own {
                let half: Block<f32, 3> = triple(|i| triple(|j| L[3 * i + j]));
                L.copy_from_slice(times(&inverse, &half).as_flattened());
            }
            let scaled = times_transpose(&times(&inverse, &diagonal), &inverse);
            K[row - first] = LOWER.map(|(i, j)| scaled[i][j] - if i == j { 2.0 } else { 0.0 });
            inverses[row - first] = inverse;
        }
        Ok(())
    }
}

/// A B
#[inline(always)]
fn times(A: &Block<f32, 3>, B: &Block<f32, 3>) -> Block<f32, 3> {
    triple(|i| triple(|j| A[i][0] * B[0][j] + A[i][1] * B[1][j] + A[i][2] * B[2][j]))
}

/// A Bᵀ
#[inline(always)]
fn times_transpose(A: &Block<f32, 3>, B: &Block<f32, 3>) -> Block<f32, 3> {
    triple(|i| triple(|j| A[i][0] * B[j][0] + A[i][1] * B[j][1] + A[i][2] * B[j][2]))
}
