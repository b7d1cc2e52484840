//! A matrix A = L + D + Lᵀ scaled by the factors of blocks near its diagonal: L̃ + K + 2 + L̃ᵀ, in single precision.

use std::ops::Range;

use crate::number::Real;
use crate::solvers::Breakdown;
use crate::solvers::block_jacobi::{factor, invert_lower};
use crate::sparse::Pattern;

/// Parts of an incomplete factorisation's change of the diagonal that are tried, one after the other, until it succeeds: half of
/// it takes fewest iterations on beams, all of it mostly breaks down, none of it is Gauss and Seidel's own.
const PARTS: [f32; 2] = [0.5, 0.0];

/// Part of the diagonal that it must leave.
const LEAST: f32 = 0.02;

/// The lower half of a 3×3 block, row by row.
pub type Half = [f32; 6];

/// Row and column of its entries.
const LOWER: [(usize, usize); 6] = [(0, 0), (1, 0), (1, 1), (2, 0), (2, 1), (2, 2)];

/// A scaled matrix.
pub struct Scaled {
    pub places: Places,
    /// L̃, row by row, and one number more, so that four can be read where a block's last three are.
    pub L: Vec<f32>,
    /// K, of which only the lower half is stored.
    pub K: Vec<Half>,
    /// G⁻¹.
    pub inverses: Vec<[[f32; 3]; 3]>,
    /// G, with zeros for held directions.
    pub G: Vec<Half>,
    /// What the matrix is multiplied with, so that single precision holds it.
    pub scale: f64,
}

/// Where the blocks below the diagonal are.
pub struct Places {
    starts: Vec<u32>,
    pub columns: Vec<u32>,
    /// Number in the matrix of each of those blocks, and of the diagonal ones.
    pub sources: Vec<u32>,
    pub diagonal: Vec<u32>,
}

impl Places {
    /// Blocks of a row, below the diagonal.
    #[inline(always)]
    pub fn row(&self, row: usize) -> Range<usize> {
        self.starts[row] as usize..self.starts[row + 1] as usize
    }
}

impl Scaled {
    /// For a pattern of which all blocks are stored, or the lower half.
    pub fn new(pattern: &Pattern) -> Self {
        let (mut starts, mut columns, mut sources) = (vec![0], Vec::new(), Vec::new());
        for row in 0..pattern.rows() {
            for block in pattern.row(row).filter(|&block| (pattern.columns[block] as usize) < row) {
                columns.push(pattern.columns[block]);
                sources.push(block as u32);
            }
            starts.push(columns.len() as u32);
        }
        let diagonal = pattern.diagonal().map(|block| block as u32).collect();
        let rows = pattern.rows();
        Self {
            L: vec![0.0; 9 * columns.len() + 1],
            K: vec![[0.0; 6]; rows],
            inverses: vec![[[0.0; 3]; 3]; rows],
            G: vec![[0.0; 6]; rows],
            places: Places { starts, columns, sources, diagonal },
            scale: 1.0,
        }
    }

    /// What to multiply a matrix with.
    pub fn choose_scale<T: Real>(&mut self, values: &[[[T; 3]; 3]]) -> Result<f64, Breakdown> {
        let entries = |&block: &u32| (0..3).map(move |i| values[block as usize][i][i].as_f64());
        let largest = self.places.diagonal.iter().flat_map(entries).fold(0.0, f64::max);
        if !(largest > 0.0 && largest.is_finite()) {
            return Err(Breakdown::Singular);
        }
        self.scale = 1.0 / largest;
        Ok(self.scale)
    }

    /// Scales a matrix, of which G has the directions that move.
    pub fn prepare<T: Real>(&mut self, values: &[[[T; 3]; 3]], moves: &[[f32; 3]]) -> Result<(), Breakdown> {
        let mut outcome = Ok(());
        for part in PARTS {
            outcome = self.scaled(values, moves, part);
            if outcome.is_ok() {
                break;
            }
        }
        outcome
    }

    fn scaled<T: Real>(&mut self, values: &[[[T; 3]; 3]], moves: &[[f32; 3]], part: f32) -> Result<(), Breakdown> {
        let Self { places, L, K, G, inverses, scale } = self;
        let single = |block: u32| values[block as usize].map(|row| row.map(|entry| (entry.as_f64() * *scale) as f32));
        for row in 0..places.diagonal.len() {
            let blocks = places.row(row);
            let diagonal = single(places.diagonal[row]);
            let mut W = diagonal;
            for block in blocks.clone() {
                let column = places.columns[block] as usize;
                let half = times_transpose(&single(places.sources[block]), &inverses[column]);
                for i in 0..3 {
                    for j in 0..3 {
                        W[i][j] -= part * (0..3).map(|k| half[i][k] * half[j][k]).sum::<f32>();
                    }
                    L[9 * block + 3 * i..][..3].copy_from_slice(&half[i]);
                }
            }
            if part > 0.0 && (0..3).any(|i| !(W[i][i] > LEAST * diagonal[i][i])) {
                return Err(Breakdown::NotPositiveDefinite);
            }
            let root = factor(&W)?;
            let inverse = invert_lower(&root);
            G[row] = LOWER.map(|(i, j)| moves[row][i] * root[i][j]);
            for block in blocks {
                let half: [[f32; 3]; 3] = std::array::from_fn(|i| std::array::from_fn(|j| L[9 * block + 3 * i + j]));
                let whole = times(&inverse, &half);
                L[9 * block..9 * block + 9].copy_from_slice(whole.as_flattened());
            }
            let scaled = times_transpose(&times(&inverse, &diagonal), &inverse);
            K[row] = LOWER.map(|(i, j)| scaled[i][j] - if i == j { 2.0 } else { 0.0 });
            inverses[row] = inverse;
        }
        Ok(())
    }

    /// Bytes that it holds.
    pub fn bytes(&self) -> usize {
        let places = &self.places;
        let numbers = places.starts.len() + 2 * places.columns.len() + places.diagonal.len() + self.L.len();
        let blocks = size_of_val(self.K.as_slice()) + size_of_val(self.G.as_slice());
        4 * numbers + blocks + size_of_val(self.inverses.as_slice())
    }
}

/// A B
#[inline(always)]
fn times(A: &[[f32; 3]; 3], B: &[[f32; 3]; 3]) -> [[f32; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| A[i][0] * B[0][j] + A[i][1] * B[1][j] + A[i][2] * B[2][j]))
}

/// A Bᵀ
#[inline(always)]
fn times_transpose(A: &[[f32; 3]; 3], B: &[[f32; 3]; 3]) -> [[f32; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| A[i][0] * B[j][0] + A[i][1] * B[j][1] + A[i][2] * B[j][2]))
}
