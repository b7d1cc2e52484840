//! Sums and updates of vectors of nodes. Sums run in double and in a fixed order, so that they depend on nothing but the numbers.

use crate::number::Real;

/// Sums side by side: an addition need not wait for the one before.
const SUMS: usize = 8;

/// x·y, summed in double.
pub fn dot<T: Real>(x: &[[T; 3]], y: &[[T; 3]]) -> f64 {
    let (x, x_rest) = x.as_flattened().as_chunks::<SUMS>();
    let (y, y_rest) = y.as_flattened().as_chunks::<SUMS>();
    let mut sums = [0.0; SUMS];
    for (x, y) in x.iter().zip(y) {
        for lane in 0..SUMS {
            sums[lane] += x[lane].as_f64() * y[lane].as_f64();
        }
    }
    let rest: f64 = x_rest.iter().zip(y_rest).map(|(x, y)| x.as_f64() * y.as_f64()).sum();
    sums.iter().sum::<f64>() + rest
}

/// ‖x‖₂, summed in double.
pub fn norm<T: Real>(x: &[[T; 3]]) -> f64 {
    dot(x, x).sqrt()
}

/// y += a x
pub(super) fn add_multiple<T: Real>(a: f64, x: &[[T; 3]], y: &mut [[T; 3]]) {
    let a = <T as Real>::of(a);
    for (y, x) in y.as_flattened_mut().iter_mut().zip(x.as_flattened()) {
        *y += a * *x;
    }
}

/// p = z + b p
pub(super) fn add_to_multiple<T: Real>(z: &[[T; 3]], b: f64, p: &mut [[T; 3]]) {
    let b = <T as Real>::of(b);
    for (p, z) in p.as_flattened_mut().iter_mut().zip(z.as_flattened()) {
        *p = *z + b * *p;
    }
}

/// r = b − r
pub(super) fn subtract_from<T: Real>(b: &[[T; 3]], r: &mut [[T; 3]]) {
    for (r, b) in r.as_flattened_mut().iter_mut().zip(b.as_flattened()) {
        *r = *b - *r;
    }
}

#[cfg(test)]
mod tests {
    use super::{dot, norm};

    #[test]
    fn a_sum_counts_every_entry_once() {
        for nodes in 0..20 {
            let x: Vec<[f64; 3]> = (0..nodes).map(|i| [f64::from(i), 1.0, -2.0]).collect();
            let direct: f64 = x.as_flattened().iter().map(|x| x * x).sum();
            assert_eq!(dot(&x, &x), direct);
            assert_eq!(norm(&x), direct.sqrt());
        }
    }
}
