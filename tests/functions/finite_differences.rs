//! Derivatives by central differences, extrapolated to step zero (Richardson), so that both the error of the formula
//! and round-off stay near 1e-10 of the values that were subtracted.

use std::ops::{Add, Mul, Sub};

use nalgebra::{DMatrix, DVector};

const LEVELS: usize = 4;

/// Derivative of `along(t)` at t = 0. `along` must be smooth for some 20 steps around.
pub fn derivative<T>(along: impl Fn(f64) -> T, step: f64) -> T
where
    T: Clone + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
{
    let difference = |level: usize| {
        let h = step / (1 << level) as f64;
        (along(h) - along(-h)) * (0.5 / h)
    };
    let mut table: Vec<T> = (0..LEVELS).map(difference).collect();
    for order in 1..LEVELS {
        // Halving the step divides the leading error by 4, the next by 16, and so on.
        let factor = 4f64.powi(order as i32);
        for level in (order..LEVELS).rev() {
            let gained = (table[level].clone() - table[level - 1].clone()) * (1.0 / (factor - 1.0));
            table[level] = table[level].clone() + gained;
        }
    }
    table.swap_remove(LEVELS - 1)
}

/// Gradient of a number with respect to every entry of `x`.
pub fn gradient(f: impl Fn(&DVector<f64>) -> f64, x: &DVector<f64>, step: f64) -> DVector<f64> {
    DVector::from_fn(x.len(), |entry, _| derivative(|t| f(&moved(x, entry, t)), step))
}

/// Column k is the derivative of `f` with respect to entry k of `x`.
pub fn jacobian(f: impl Fn(&DVector<f64>) -> DVector<f64>, x: &DVector<f64>, step: f64) -> DMatrix<f64> {
    let columns: Vec<_> = (0..x.len()).map(|entry| derivative(|t| f(&moved(x, entry, t)), step)).collect();
    DMatrix::from_columns(&columns)
}

fn moved(x: &DVector<f64>, entry: usize, by: f64) -> DVector<f64> {
    let mut moved = x.clone();
    moved[entry] += by;
    moved
}
