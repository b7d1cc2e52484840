//! Cholesky factorisation in single precision, for directions of Newton's method: half the memory and half the time. Where the matrix is
//! too ill-conditioned for it, the factor is computed in the precision of the matrix.

use std::sync::Arc;

use super::SupernodalCholesky;
use crate::krylov::{parts, product};
use crate::parts::Part;
use crate::{ApproximateInverse, Memoryless};
use fem_elements::Real;
use fem_elements::sparse::{Block, Pattern};
use fem_model::simulation::Breakdown;

/// Largest relative residual of a solution by the factor in single precision: iterations with a better one would not be fewer.
const LARGEST_RESIDUAL: f64 = 1e-2;

/// The factor in single precision, and that of the matrix where it is needed.
pub(super) struct SingleCholesky<T: Real> {
    pattern: Arc<Pattern>,
    parts: Part,
    /// 1 / largest entry of the matrix: the scaled matrix is within the range of single precision.
    scale: f64,
    values: Vec<Block<f32, 3>>,
    factor: SupernodalCholesky<f32>,
    right: Vec<[f32; 3]>,
    solution: Vec<[f32; 3]>,
    /// Right-hand side of the test, with entries from −1 to 1.
    test: Vec<[f32; 3]>,
    /// The factor in the precision of the matrix; `None` until the first matrix that needs it.
    precise: Option<SupernodalCholesky<T>>,
    is_precise: bool,
}

impl<T: Real> SingleCholesky<T> {
    /// Symbolic factorisation in the order of the rows; `pattern` stores the lower half.
    pub(super) fn new(pattern: &Arc<Pattern>) -> Self {
        let zero = || vec![[0.0; 3]; pattern.rows()];
        Self {
            parts: parts(pattern),
            scale: 1.0,
            values: vec![[[0.0; 3]; 3]; pattern.blocks()],
            factor: SupernodalCholesky::new(pattern),
            right: zero(),
            solution: zero(),
            test: test_vector(pattern.rows()),
            precise: None,
            is_precise: false,
            pattern: Arc::clone(pattern),
        }
    }

    /// Factors the scaled matrix in single precision. Returns whether its solutions have a few correct digits.
    fn prepare_single(&mut self, values: &[Block<T, 3>]) -> bool {
        let largest = self.pattern.diagonal().flat_map(|block| (0..3).map(move |i| values[block][i][i].as_f64()));
        self.scale = 1.0 / largest.fold(0.0, f64::max);
        if !self.scale.is_normal() {
            return false;
        }
        let pairs = self.values.as_flattened_mut().as_flattened_mut().iter_mut();
        for (single, value) in pairs.zip(values.as_flattened().as_flattened()) {
            *single = (self.scale * value.as_f64()) as f32;
        }
        self.factor.prepare(&self.values).is_ok() && self.residual_of_test() <= LARGEST_RESIDUAL
    }

    /// ‖b − A P⁻¹ b‖ / ‖b‖ for the right-hand side b of the test: about the machine epsilon times the condition number.
    fn residual_of_test(&mut self) -> f64 {
        let Self { pattern, parts, values, factor, right, solution, test, .. } = self;
        factor.apply(test, solution);
        product(pattern, parts, values, solution, right);
        let (mut of_residual, mut of_test) = (0.0, 0.0);
        for (b, ax) in test.as_flattened().iter().zip(right.as_flattened()) {
            of_residual += (b - ax) * (b - ax);
            of_test += b * b;
        }
        f64::from(of_residual / of_test).sqrt()
    }
}

impl<T: Real> Memoryless for SingleCholesky<T> {}

impl<T: Real> ApproximateInverse<T> for SingleCholesky<T> {
    fn prepare(&mut self, values: &[Block<T, 3>]) -> Result<(), Breakdown> {
        self.is_precise = !self.prepare_single(values);
        if !self.is_precise {
            return Ok(());
        }
        self.precise.get_or_insert_with(|| SupernodalCholesky::new(&self.pattern)).prepare(values)
    }

    fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        if let Some(precise) = self.precise.as_mut().filter(|_| self.is_precise) {
            return precise.apply(r, z);
        }
        let size = fem_elements::vector::max_norm(r);
        if !(size > 0.0) {
            // Zero, or NaN.
            return z.copy_from_slice(r);
        }
        for (right, r) in self.right.as_flattened_mut().iter_mut().zip(r.as_flattened()) {
            *right = (r.as_f64() / size) as f32;
        }
        self.factor.apply(&self.right, &mut self.solution);
        let factor = size * self.scale;
        for (z, x) in z.as_flattened_mut().iter_mut().zip(self.solution.as_flattened()) {
            *z = T::of(factor * f64::from(*x));
        }
    }

    fn bytes(&self) -> usize {
        let vectors = size_of_val(&self.values[..]) + 3 * size_of_val(&self.test[..]);
        vectors + self.factor.bytes() + self.precise.as_ref().map_or(0, |precise| precise.bytes())
    }
}

/// Numbers from −1 to 1 without a pattern, the same in every run: multiples of the golden ratio without their whole part, Weyl (1916).
fn test_vector(rows: usize) -> Vec<[f32; 3]> {
    const GOLDEN_RATIO: f64 = 0.618_033_988_749_894_9;
    let entry = |number: usize| (2.0 * (number as f64 * GOLDEN_RATIO).fract() - 1.0) as f32;
    (0..rows).map(|row| [0, 1, 2].map(|i| entry(3 * row + i))).collect()
}
