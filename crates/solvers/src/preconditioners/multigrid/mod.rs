//! Multigrid by smoothed aggregation with the six rigid motions: Vaněk, Mandel and Brezina, Algebraic Multigrid by Smoothed
//! Aggregation for Second and Fourth Order Elliptic Problems (1996). The coarse matrices are computed and factored in double precision, and
//! cycles smooth in single, whose round-off a preconditioner forgives.

mod aggregate;
mod blocks;
mod cycle;
mod level;
mod motions;

use blocks::Blocks;
use level::Level;
use motions::DISPLACEMENTS;

use super::single_precision_scale;
use crate::direct::SupernodalCholesky;
use crate::numbering::blocks_of_factor;
use crate::{ApproximateInverse, Memory};
use fem_elements::Real;
use fem_elements::history::{put, put_option, take, take_option};
use fem_elements::sparse::{Block, Pattern, Stored};
use fem_elements::tensor::map;
use fem_elements::vector::norm;
use fem_model::simulation::{Breakdown, History};

/// Coarse matrices of up to this many nodes are factored, if their factor is [cheap](is_factor_cheap). One level more would leave too few nodes
/// for the motions of a slender body.
const MAX_COARSEST: usize = 1000;

/// A symmetric V-cycle.
pub(crate) struct Multigrid {
    fine: Level<3>,
    coarser: Vec<Level<6>>,
    coarsest: Blocks<6, 6, f64>,
    /// Right-hand side and solution on the coarsest level.
    b: Vec<[f32; 6]>,
    x: Vec<[f32; 6]>,
    direct: SupernodalCholesky<f64>,
    direct_values: Vec<[[f64; 3]; 3]>,
    /// Right-hand side and solution of the factor.
    direct_b: Vec<[f64; 3]>,
    direct_x: Vec<[f64; 3]>,
    /// Number in the given matrix of each block of the fine one, or of its transpose right of the diagonal.
    sources: Vec<u32>,
    diagonal: Vec<u32>,
    /// Factor by which the matrix is scaled into the range of single precision.
    scale: f64,
}

impl Multigrid {
    /// Finds the levels from a pattern, which may store the lower half, and the undeformed positions of its nodes, m.
    pub(crate) fn new(pattern: &Pattern, rest: &[[f64; 3]]) -> Self {
        let (fine, sources) = all_blocks(pattern);
        let motions = vec![DISPLACEMENTS; rest.len()];
        let (fine, mut coarsest, mut motions, mut positions) = Level::new(fine, &motions, &scaled_positions(rest));
        let mut coarser = Vec::new();
        while coarsest.rows() > MAX_COARSEST || !is_factor_cheap(&coarsest, &fine.exact) {
            let before = coarsest.rows();
            let (level, next, next_motions, next_positions) = Level::new(coarsest.clone(), &motions, &positions);
            if 2 * next.rows() > before {
                break;
            }
            coarser.push(level);
            (coarsest, motions, positions) = (next, next_motions, next_positions);
        }
        let lower = lower_pattern(&coarsest);
        let vector = vec![[0.0; 6]; coarsest.rows()];
        Self {
            fine,
            coarser,
            direct: SupernodalCholesky::new(&lower),
            direct_values: vec![Default::default(); lower.blocks()],
            direct_b: vec![[0.0; 3]; lower.rows()],
            direct_x: vec![[0.0; 3]; lower.rows()],
            b: vector.clone(),
            x: vector,
            coarsest,
            sources,
            diagonal: pattern.diagonal().map(|block| block as u32).collect(),
            scale: 1.0,
        }
    }

    /// Solves for `fine.x` from `fine.b`.
    fn cycle(&mut self) {
        let coarsest = &mut self.b;
        self.fine.descend(self.coarser.first_mut().map_or(coarsest, |level| &mut level.b));
        for number in 0..self.coarser.len() {
            let (levels, coarser) = self.coarser.split_at_mut(number + 1);
            levels[number].descend(coarser.first_mut().map_or(&mut self.b, |level| &mut level.b));
        }
        for (double, b) in self.direct_b.as_flattened_mut().iter_mut().zip(self.b.as_flattened()) {
            *double = f64::from(*b);
        }
        self.direct.apply(&self.direct_b, &mut self.direct_x);
        for (x, double) in self.x.as_flattened_mut().iter_mut().zip(self.direct_x.as_flattened()) {
            *x = *double as f32;
        }
        for number in (0..self.coarser.len()).rev() {
            let (levels, coarser) = self.coarser.split_at_mut(number + 1);
            levels[number].ascend(coarser.first().map_or(&self.x, |level| &level.x));
        }
        self.fine.ascend(self.coarser.first().map_or(&self.x, |level| &level.x));
    }

    /// Prepares all levels for the fine matrix.
    fn prepare_levels(&mut self) -> Result<(), Breakdown> {
        let first = self.coarser.first_mut().map_or(&mut self.coarsest, |level| &mut level.exact);
        self.fine.prepare(first)?;
        for number in 0..self.coarser.len() {
            let (levels, coarser) = self.coarser.split_at_mut(number + 1);
            let next = coarser.first_mut().map_or(&mut self.coarsest, |level| &mut level.exact);
            levels[number].prepare(next)?;
        }
        copy_lower(&self.coarsest, &mut self.direct_values);
        self.direct.prepare(&self.direct_values)
    }
}

impl<T: Real> Memory<T> for Multigrid {
    fn save(&self, is_kept: bool, history: &mut History) {
        self.fine.save(is_kept, "multigrid.power.0", history);
        for (number, level) in self.coarser.iter().enumerate() {
            level.save(is_kept, &format!("multigrid.power.{}", number + 1), history);
        }
        if is_kept {
            put(history, "multigrid.values", self.fine.exact.values.as_flattened().as_flattened());
            put_option(history, "multigrid.scale", Some(self.scale));
        }
    }

    fn restore(&mut self, is_kept: bool, history: &History) -> Result<(), String> {
        self.fine.restore("multigrid.power.0", history)?;
        for (number, level) in self.coarser.iter_mut().enumerate() {
            level.restore(&format!("multigrid.power.{}", number + 1), history)?;
        }
        if !is_kept {
            return Ok(());
        }
        take(history, "multigrid.values", self.fine.exact.values.as_flattened_mut().as_flattened_mut())?;
        self.scale = take_option(history, "multigrid.scale")?.unwrap_or(1.0);
        self.prepare_levels().map_err(|breakdown| format!("its multigrid levels cannot be prepared again: {breakdown}"))
    }

    /// The levels may be those of an earlier matrix; they are restored.
    fn prepare_again(&mut self, _values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        Ok(())
    }
}

impl<T: Real> ApproximateInverse<T> for Multigrid {
    fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        self.scale = single_precision_scale(values, &self.diagonal)?;
        let Blocks { starts, columns, values: exact } = &mut self.fine.exact;
        for row in 0..starts.len() - 1 {
            for block in starts[row]..starts[row + 1] {
                let value = &values[self.sources[block] as usize];
                let scaled = map(value, |entry| entry.as_f64() * self.scale);
                exact[block] = if columns[block] as usize > row { transposed(&scaled) } else { scaled };
            }
        }
        self.prepare_levels()
    }

    /// One cycle from x = 0.
    fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        let size = norm(r);
        if !(size > 0.0 && size.is_finite()) {
            z.copy_from_slice(r);
            return;
        }
        for (b, r) in self.fine.b.iter_mut().zip(r) {
            *b = r.map(|r| (r.as_f64() / size) as f32);
        }
        self.cycle();
        let scale = size * self.scale;
        for (z, x) in z.iter_mut().zip(&self.fine.x) {
            *z = x.map(|x| T::of(f64::from(x) * scale));
        }
    }

    fn bytes(&self) -> usize {
        let levels: usize = self.coarser.iter().map(Level::bytes).sum();
        let vectors = size_of_val(self.direct_b.as_slice()) + size_of_val(self.direct_x.as_slice());
        let direct = self.direct.bytes() + size_of_val(self.direct_values.as_slice()) + vectors;
        let own = size_of_val(self.sources.as_slice()) + size_of_val(self.diagonal.as_slice());
        self.fine.bytes() + levels + self.coarsest.bytes() + direct + own
    }
}

/// Returns true if the Cholesky factor of a coarse matrix has no more entries than the fine matrix, so that a substitution takes about as long as
/// the sweeps of the fine level. That of a compact body soon has more; that of a slender one, which needs a fine coarsest level, has a narrow band.
fn is_factor_cheap(coarse: &Blocks<6, 6, f64>, fine: &Blocks<3, 3, f64>) -> bool {
    36 * blocks_of_factor(coarse.rows(), |row| coarse.row(row).0) <= 9 * fine.values.len()
}

/// Positions relative to the first node, scaled to coordinates of at most 1.
fn scaled_positions(rest: &[[f64; 3]]) -> Vec<[f64; 3]> {
    let Some(&origin) = rest.first() else { return Vec::new() };
    let relative = |x: &[f64; 3]| [x[0] - origin[0], x[1] - origin[1], x[2] - origin[2]];
    let largest = rest.iter().flat_map(relative).fold(0.0, |most: f64, x| most.max(x.abs()));
    let unit = if largest > 0.0 { largest } else { 1.0 };
    rest.iter().map(|x| relative(x).map(|x| x / unit)).collect()
}

/// A zero matrix with all blocks of a pattern, which may store the lower half, and the number in the pattern of each block, or of its transpose
/// right of the diagonal.
fn all_blocks(pattern: &Pattern) -> (Blocks<3, 3, f64>, Vec<u32>) {
    let mut rows: Vec<Vec<(u32, u32)>> = vec![Vec::new(); pattern.rows()];
    for row in 0..pattern.rows() {
        for block in pattern.row(row).filter(|&block| pattern.columns[block] as usize <= row) {
            let column = pattern.columns[block];
            rows[row].push((column, block as u32));
            if (column as usize) < row {
                rows[column as usize].push((row as u32, block as u32));
            }
        }
    }
    let mut starts = vec![0];
    starts.extend(rows.iter().scan(0, |blocks, row| {
        *blocks += row.len();
        Some(*blocks)
    }));
    let (columns, sources) = rows.into_iter().flatten().unzip();
    (Blocks::zeros(starts, columns), sources)
}

/// Aᵀ for a block.
fn transposed(A: &[[f64; 3]; 3]) -> [[f64; 3]; 3] {
    std::array::from_fn(|i| std::array::from_fn(|j| A[j][i]))
}

/// The pattern of the lower half of a matrix of 6×6 blocks, as 3×3 blocks.
fn lower_pattern(A: &Blocks<6, 6, f64>) -> Pattern {
    let (mut starts, mut columns) = (vec![0], Vec::new());
    for row in 0..2 * A.rows() {
        let all = A.row(row / 2).0.iter().flat_map(|&column| [2 * column, 2 * column + 1]);
        columns.extend(all.filter(|&column| column as usize <= row));
        starts.push(columns.len());
    }
    Pattern { stored: Stored::Lower, starts, columns }
}

/// Copies the lower half of a matrix of 6×6 blocks to the 3×3 blocks of its [`lower_pattern`].
fn copy_lower(A: &Blocks<6, 6, f64>, values: &mut [[[f64; 3]; 3]]) {
    let mut values = values.iter_mut();
    for row in 0..2 * A.rows() {
        let (columns, blocks) = A.row(row / 2);
        for (&column, block) in columns.iter().zip(blocks) {
            for half in (0..2).filter(|half| 2 * column as usize + half <= row) {
                let Some(value) = values.next() else { return };
                *value = std::array::from_fn(|i| std::array::from_fn(|j| block[3 * (row % 2) + i][3 * half + j]));
            }
        }
    }
}
