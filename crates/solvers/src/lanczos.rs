//! The largest eigenvalue of a matrix that is known by its products alone, by Lanczos's method: Golub and Van Loan, Matrix Computations
//! (2013), §10.1.

use nalgebra::DMatrix;

use fem_elements::Real;
use fem_elements::vector::{axpy, triple};

/// Iterations between two looks at the eigenvalues.
const BLOCK: usize = 8;

/// Writes M⁻¹ A x for a vector x and returns xᵀ A x; `None` if it fails.
pub type Apply<'a, T> = dyn FnMut(&[[T; 3]], &mut [[T; 3]]) -> Option<f64> + 'a;

/// The largest eigenvalue of M⁻¹ A for a symmetric A and a positive definite M, approached from below; `norm` returns √(xᵀ M x). It ends
/// where `BLOCK` iterations change the eigenvalue by less than this part, or after so many. `None` where `apply` fails.
pub fn largest_eigenvalue<T: Real>(
    mut x: Vec<[T; 3]>,
    (change, iterations): (f64, usize),
    apply: &mut Apply<T>,
    norm: &mut dyn FnMut(&[[T; 3]]) -> f64,
) -> Option<f64> {
    let zero = vec![[T::default(); 3]; x.len()];
    let (mut before, mut next) = (zero.clone(), zero);
    scale(1.0 / norm(&x), &mut x);
    let (mut diagonal, mut beside) = (Vec::new(), Vec::new());
    let (mut found, mut last) = (0.0, 0.0);
    while diagonal.len() < iterations {
        let alpha = apply(&x, &mut next)?;
        axpy(-alpha, &x, &mut next);
        axpy(-last, &before, &mut next);
        diagonal.push(alpha);
        last = norm(&next);
        // A body of few degrees of freedom has no further direction.
        let is_exhausted = !(last > 1e-9 * alpha.abs());
        if is_exhausted || diagonal.len() % BLOCK == 0 {
            let eigenvalue = largest_of_tridiagonal(&diagonal, &beside);
            let is_settled = (eigenvalue - found).abs() <= change * eigenvalue;
            found = eigenvalue;
            if is_exhausted || is_settled {
                break;
            }
        }
        beside.push(last);
        scale(1.0 / last, &mut next);
        std::mem::swap(&mut before, &mut x);
        std::mem::swap(&mut x, &mut next);
    }
    Some(found)
}

/// The largest eigenvalue of a symmetric tridiagonal matrix; NaN where an entry is.
fn largest_of_tridiagonal(diagonal: &[f64], beside: &[f64]) -> f64 {
    if !diagonal.iter().chain(beside).all(|x| x.is_finite()) {
        return f64::NAN;
    }
    let matrix = DMatrix::from_fn(diagonal.len(), diagonal.len(), |i, j| match i.abs_diff(j) {
        0 => diagonal[i],
        1 => beside[i.min(j)],
        _ => 0.0,
    });
    matrix.symmetric_eigenvalues().max()
}

/// A start vector with a component along every vibration: multiples of the golden ratio, modulo 1.
pub fn irregular<T: Real>(nodes: usize) -> Vec<[T; 3]> {
    let entry = |k: usize| T::of((k as f64 * 0.618_033_988_749_894_9).fract() - 0.5);
    (0..nodes).map(|node| triple(|i| entry(3 * node + i + 1))).collect()
}

fn scale<T: Real>(factor: f64, x: &mut [[T; 3]]) {
    for x in x.as_flattened_mut() {
        *x *= T::of(factor);
    }
}
