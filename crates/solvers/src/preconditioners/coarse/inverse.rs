//! The inverse of the coarse matrix, for a device that multiplies faster than it substitutes.

use super::Coarse;
use crate::ApproximateInverse;

impl Coarse {
    /// The inverse of the coarse matrix, row by row; zero without a factor.
    pub fn inverse(&mut self) -> Vec<f32> {
        let rows = self.b.len();
        let mut inverse = vec![0.0; 9 * rows * rows];
        if self.scale.is_none() {
            return inverse;
        }
        // It is symmetric, so its columns are its rows.
        for (place, row) in inverse.chunks_exact_mut(3 * rows).enumerate() {
            self.b.fill([0.0; 3]);
            self.b[place / 3][place % 3] = 1.0;
            self.factor.apply(&self.b, &mut self.x);
            row.copy_from_slice(self.x.as_flattened());
        }
        inverse
    }
}
