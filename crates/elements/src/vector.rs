//! Inner products, norms and updates of nodal vectors, one `[T; 3]` per node.
//!
//! Inner products accumulate in double precision and in a fixed order, so that results do not depend on the number of threads.

use crate::number::Float;
use crate::threads::{join, over_parts};

/// Number of independent partial sums, so that an addition does not wait for the one before it.
const PARTIAL_SUMS: usize = 8;

/// Largest number of nodes whose terms one thread sums up. Longer vectors are halved in whole chunks, whatever the number of threads.
const CHUNK: usize = 8192;

/// The vector of the entries `entry(i)`: three calls in a row, a tenth of the code that the compiler gets from `std::array::from_fn`.
#[inline(always)]
pub fn triple<T>(mut entry: impl FnMut(usize) -> T) -> [T; 3] {
    [entry(0), entry(1), entry(2)]
}

/// x·y, accumulated in double precision.
pub fn dot<T: Float>(x: &[[T; 3]], y: &[[T; 3]]) -> f64 {
    let nodes = x.len().min(y.len());
    if nodes <= CHUNK {
        return dot_of_chunk(&x[..nodes], &y[..nodes]);
    }
    let middle = nodes.div_ceil(CHUNK) / 2 * CHUNK;
    let (x, y) = (x.split_at(middle), y.split_at(middle));
    let (a, b) = join(|| dot(x.0, y.0), || dot(x.1, y.1));
    a + b
}

fn dot_of_chunk<T: Float>(x: &[[T; 3]], y: &[[T; 3]]) -> f64 {
    let (x, x_rest) = x.as_flattened().as_chunks::<PARTIAL_SUMS>();
    let (y, y_rest) = y.as_flattened().as_chunks::<PARTIAL_SUMS>();
    let mut sums = [0.0; PARTIAL_SUMS];
    for (x, y) in x.iter().zip(y) {
        for lane in 0..PARTIAL_SUMS {
            sums[lane] += x[lane].as_f64() * y[lane].as_f64();
        }
    }
    let rest: f64 = x_rest.iter().zip(y_rest).map(|(x, y)| x.as_f64() * y.as_f64()).sum();
    sums.iter().sum::<f64>() + rest
}

/// Euclidean norm ‖x‖₂, accumulated in double precision.
pub fn norm<T: Float>(x: &[[T; 3]]) -> f64 {
    dot(x, x).sqrt()
}

/// a · b of one node, in double precision.
#[inline]
pub fn dot3<T: Float>(a: &[T; 3], b: &[T; 3]) -> f64 {
    a[0].as_f64() * b[0].as_f64() + a[1].as_f64() * b[1].as_f64() + a[2].as_f64() * b[2].as_f64()
}

/// Sum of the absolute values of all entries, Σ |xᵢ|.
pub fn sum_of_sizes<T: Float>(x: &[[T; 3]]) -> f64 {
    x.as_flattened().iter().map(|x| x.as_f64().abs()).sum()
}

/// Maximum norm ‖x‖∞, the largest absolute value of an entry that is not NaN.
pub fn max_norm<T: Float>(x: &[[T; 3]]) -> f64 {
    // NaN fails the comparison.
    let larger = |max: f64, x: &T| if x.as_f64().abs() > max { x.as_f64().abs() } else { max };
    let (chunks, rest) = x.as_flattened().as_chunks::<PARTIAL_SUMS>();
    let mut maxima = [0.0; PARTIAL_SUMS];
    for x in chunks {
        for lane in 0..PARTIAL_SUMS {
            maxima[lane] = larger(maxima[lane], &x[lane]);
        }
    }
    rest.iter().fold(maxima.into_iter().fold(0.0, f64::max), larger)
}

/// Nodes that a thread updates at a time, where there are more of them.
const UPDATED: usize = 2048;

/// Calls `update` for every number of y with that of x, in several threads for long vectors.
fn update<T: Float>(x: &[[T; 3]], y: &mut [[T; 3]], update: impl Fn(T, &mut T) + Sync) {
    let nodes = x.len().min(y.len());
    let (x, y) = (&x[..nodes], &mut y[..nodes]);
    let over = |x: &[[T; 3]], y: &mut [[T; 3]]| {
        y.as_flattened_mut().iter_mut().zip(x.as_flattened()).for_each(|(y, x)| update(*x, y));
    };
    if nodes <= CHUNK {
        over(x, y);
    } else {
        over_parts(y, UPDATED, &|first, y| over(&x[first..][..y.len()], y));
    }
}

/// Sets all numbers to zero, in several threads for a large matrix.
pub fn clear<X: Copy + Default + Send>(x: &mut [X]) {
    if x.len() <= CHUNK {
        x.fill(X::default());
    } else {
        over_parts(x, CHUNK, &|_, x| x.fill(X::default()));
    }
}

/// Makes x as many zeros, in the memory that it has.
pub fn set_zero<X: Copy + Default>(x: &mut Vec<X>, len: usize) {
    x.clear();
    x.resize(len, X::default());
}

/// y += a x
pub fn axpy<T: Float>(a: f64, x: &[[T; 3]], y: &mut [[T; 3]]) {
    let a = <T as Float>::of(a);
    update(x, y, |x, y| *y += a * x);
}

/// x = a x
pub fn scale<T: Float>(a: f64, x: &mut [[T; 3]]) {
    let a = <T as Float>::of(a);
    x.as_flattened_mut().iter_mut().for_each(|x| *x *= a);
}

/// y = x + b y
pub fn xpby<T: Float>(x: &[[T; 3]], b: f64, y: &mut [[T; 3]]) {
    let b = <T as Float>::of(b);
    update(x, y, |x, y| *y = x + b * *y);
}

/// y = x − y
pub fn subtract_from<T: Float>(x: &[[T; 3]], y: &mut [[T; 3]]) {
    update(x, y, |x, y| *y = x - *y);
}
