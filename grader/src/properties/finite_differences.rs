//! Derivatives by central differences, extrapolated to step zero (Richardson), so that both the error of the formula
//! and round-off stay near 1e-10 of the values that were subtracted.

use std::ops::{Add, Mul, Sub};

use nalgebra::{DMatrix, DVector};

use super::outcome::Mistake;

const LEVELS: usize = 4;

/// Derivative of `along(t)` at t = 0. `along` must be smooth for some 20 steps around.
fn derivative<T>(along: impl Fn(f64) -> Result<T, Mistake>, step: f64) -> Result<T, Mistake>
where
    T: Clone + Add<Output = T> + Sub<Output = T> + Mul<f64, Output = T>,
{
    let difference = |level: usize| {
        let h = step / (1 << level) as f64;
        Ok((along(h)? - along(-h)?) * (0.5 / h))
    };
    let mut table = (0..LEVELS).map(difference).collect::<Result<Vec<T>, Mistake>>()?;
    for order in 1..LEVELS {
        // Halving the step divides the leading error by 4, the next by 16, and so on.
        let factor = 4f64.powi(order as i32);
        for level in (order..LEVELS).rev() {
            let gained = (table[level].clone() - table[level - 1].clone()) * (1.0 / (factor - 1.0));
            table[level] = table[level].clone() + gained;
        }
    }
    Ok(table.swap_remove(LEVELS - 1))
}

/// Gradient of a number with respect to every entry of `x`.
///
/// # Errors
/// Those of `f`.
pub fn gradient(
    f: impl Fn(&DVector<f64>) -> Result<f64, Mistake>,
    x: &DVector<f64>,
    step: f64,
) -> Result<DVector<f64>, Mistake> {
    let entries = (0..x.len()).map(|entry| derivative(|t| f(&moved(x, entry, t)), step));
    Ok(DVector::from_vec(entries.collect::<Result<_, _>>()?))
}

/// Column k is the derivative of `f`, whose answers are all of one length, with respect to entry k of `x`.
///
/// # Errors
/// Those of `f`.
pub fn jacobian(
    f: impl Fn(&DVector<f64>) -> Result<DVector<f64>, Mistake>,
    x: &DVector<f64>,
    step: f64,
) -> Result<DMatrix<f64>, Mistake> {
    let columns = (0..x.len()).map(|entry| derivative(|t| f(&moved(x, entry, t)), step));
    Ok(DMatrix::from_columns(&columns.collect::<Result<Vec<_>, _>>()?))
}

fn moved(x: &DVector<f64>, entry: usize, by: f64) -> DVector<f64> {
    let mut moved = x.clone();
    moved[entry] += by;
    moved
}
