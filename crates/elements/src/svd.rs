//! F = U diag(σ) Vᵀ with rotations U and V: the signed singular value decomposition, of one matrix or of lanes of them.
//!
//! σ_1 ≥ σ_2 ≥ |σ_3|, and σ_3 < 0 if det F < 0: Irving, Teran and Fedkiw, Invertible Finite Elements for Robust
//! Simulation of Large Deformation (2004). Rotations of pairs of columns make the columns of F orthogonal: Hestenes,
//! Inversion of Matrices by Biorthogonalization and Related Results (1958). Unlike eigenvalues of FᵀF, this loses no digits.

use pulp::{Simd, WithSimd};

use crate::number::{Float, Number, constant};
use crate::polar::PlaneRotation;
use crate::tensor::{Tensor, half};

/// A vector.
type Vector<T> = [T; 3];

/// Sweeps over the three pairs; each sweep squares the remaining angles.
const SWEEPS: usize = 5;

/// F = Σ σ_k u_k v_kᵀ.
#[derive(Clone, Copy, Debug)]
pub struct Svd<T> {
    /// u_0, u_1, u_2: the columns of U.
    pub U: [[T; 3]; 3],
    /// Principal stretches; only the last may be negative.
    pub sigma: [T; 3],
    /// v_0, v_1, v_2: the columns of V.
    pub V: [[T; 3]; 3],
}

impl<T: Number> Svd<T> {
    /// Σ p_k u_k v_kᵀ
    #[inline(always)]
    pub fn with_values(&self, p: &[T; 3]) -> Tensor<T> {
        crate::tensor::from_fn(
            #[inline(always)]
            |i, j| {
                p[0] * self.U[0][i] * self.V[0][j]
                    + p[1] * self.U[1][i] * self.V[1][j]
                    + p[2] * self.U[2][i] * self.V[2][j]
            },
        )
    }
}

/// Decomposes any finite F, to round-off relative to its largest entry.
#[inline(never)] // one instance for each number type
pub fn svd<T: Number>(F: &Tensor<T>) -> Svd<T> {
    T::vectorize(Decomposition(F))
}

struct Decomposition<'a, T>(&'a Tensor<T>);

impl<T: Number> WithSimd for Decomposition<'_, T> {
    type Output = Svd<T>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> Svd<T> {
        decompose(self.0)
    }
}

#[inline(always)]
fn decompose<T: Number>(F: &Tensor<T>) -> Svd<T> {
    let size = largest_entry(F);
    let inverse = T::one() / size;
    let mut B = crate::tensor::from_fn(
        #[inline(always)]
        |k, i| F[i][k] * inverse,
    );
    let mut V = unit();
    for _ in 0..SWEEPS {
        for (i, j) in [(0, 1), (1, 2), (2, 0)] {
            let (c, s) = rotation(inner(&B[i], &B[j]), inner(&B[j], &B[j]) - inner(&B[i], &B[i]));
            turn(&mut B, i, j, c, s);
            turn(&mut V, i, j, c, s);
        }
    }
    for (i, j) in [(0, 1), (1, 2), (0, 1)] {
        sort(&mut B, &mut V, i, j);
    }
    let U = basis(&B);
    let sigma = [size * inner(&U[0], &B[0]), size * inner(&U[1], &B[1]), size * inner(&U[2], &B[2])];
    Svd { U, sigma, V }
}

/// Decomposes F = 1 + G of a flat body, where G has zeros in the third row and column: σ_1 and σ_2, of which the second is negative if
/// det F < 0, belong to the plane, and σ_3 = 1. Polar decomposition in closed form, then the eigenvectors of a symmetric 2×2 matrix.
#[inline(always)]
pub fn svd_in_plane<T: Number>(G: &Tensor<T>) -> Svd<T> {
    let R = PlaneRotation::of(G);
    let (c, s) = (R.cos, R.sin);
    let F = crate::tensor::plus_identity(G);
    // S = RᵀF
    let p = half::<T>() * (c * (F[0][1] + F[1][0]) + s * (F[1][1] - F[0][0]));
    let (x, y) = (c * F[0][0] + s * F[1][0], c * F[1][1] - s * F[0][1]);
    let size = x.abs().max(y.abs()).max(p.abs());
    let inverse = T::one() / size.select(size.gt(T::zero()), T::one());
    let (cos, sin) = rotation(p * inverse, (y - x) * inverse);
    let change = sin / cos * p;
    let mut V = unit();
    turn(&mut V, 0, 1, cos, sin);
    let mut sigma = [x - change, y + change, T::one()];
    let in_order = sigma[0].ge(sigma[1]);
    let (keep, swap) = (T::one().select(in_order, T::zero()), T::zero().select(in_order, T::one()));
    turn(&mut V, 0, 1, keep, -swap);
    sigma = [sigma[0].select(in_order, sigma[1]), sigma[1].select(in_order, sigma[0]), sigma[2]];
    let mut U = V;
    for k in 0..3 {
        (U[k][0], U[k][1]) = (c * V[k][0] - s * V[k][1], s * V[k][0] + c * V[k][1]);
    }
    Svd { U, sigma, V }
}

/// The largest |entry|, or one if all are zero.
#[inline(always)]
pub(crate) fn largest_entry<T: Number>(a: &Tensor<T>) -> T {
    let mut largest = T::zero();
    for row in a {
        for entry in row {
            largest = largest.max(entry.abs());
        }
    }
    largest.select(largest.gt(T::zero()), T::one())
}

/// The three unit vectors.
#[inline(always)]
pub(crate) fn unit<T: Number>() -> Tensor<T> {
    crate::tensor::plus_identity(&crate::tensor::zero())
}

/// Cosine and sine of the smaller angle that turns a symmetric [[x, p], [p, x + d]] diagonal, entries of size one.
///
/// If both are below round-off the angle is too small, by no more than round-off.
#[inline(always)]
pub(crate) fn rotation<T: Number>(p: T, d: T) -> (T, T) {
    let epsilon = Float::as_f64(<T::Element as Float>::EPSILON);
    let twice = p + p;
    let denominator = (d.abs() + (d * d + twice * twice).sqrt()).max(constant(epsilon * epsilon));
    let tangent = twice.copysign(p * d) / denominator;
    let c = T::one() / (T::one() + tangent * tangent).sqrt();
    (c, c * tangent)
}

/// Rotates the vectors i and j in their plane.
#[inline(always)]
pub(crate) fn turn<T: Number>(a: &mut [Vector<T>; 3], i: usize, j: usize, c: T, s: T) {
    for k in 0..3 {
        let (x, y) = (a[i][k], a[j][k]);
        a[i][k] = c * x - s * y;
        a[j][k] = s * x + c * y;
    }
}

/// Rotates i and j by a quarter turn if j is the longer one.
#[inline(always)]
fn sort<T: Number>(B: &mut [Vector<T>; 3], V: &mut [Vector<T>; 3], i: usize, j: usize) {
    let keep = inner(&B[i], &B[i]).ge(inner(&B[j], &B[j]));
    let (c, s) = (T::one().select(keep, T::zero()), T::zero().select(keep, T::one()));
    turn(B, i, j, c, -s);
    turn(V, i, j, c, -s);
}

/// A right-handed orthonormal basis along the first two columns, which are orthogonal; in any direction if one vanishes.
#[inline(always)]
fn basis<T: Number>(B: &[Vector<T>; 3]) -> [Vector<T>; 3] {
    let [x, y, _] = unit::<T>();
    let (zero, epsilon) = (T::zero(), Float::as_f64(<T::Element as Float>::EPSILON));
    let first = normalized(&choose(inner(&B[0], &B[0]).gt(zero), &B[0], &x));
    // Of the axes x and y, one is at least 45° away from it.
    let axis = choose(first[0].abs().lt(constant(0.7)), &x, &y);
    let second = without(&B[1], &first);
    let is_long = inner(&second, &second).gt(constant(epsilon * epsilon * epsilon * epsilon));
    let second = normalized(&choose(is_long, &second, &without(&axis, &first)));
    // A second pass: the rest of a short column may still have a part along the first.
    let second = normalized(&without(&second, &first));
    let third = [
        first[1] * second[2] - first[2] * second[1],
        first[2] * second[0] - first[0] * second[2],
        first[0] * second[1] - first[1] * second[0],
    ];
    [first, second, third]
}

#[inline(always)]
fn inner<T: Number>(a: &Vector<T>, b: &Vector<T>) -> T {
    a[0] * b[0] + a[1] * b[1] + a[2] * b[2]
}

/// a without its part along the unit vector u.
#[inline(always)]
fn without<T: Number>(a: &Vector<T>, u: &Vector<T>) -> Vector<T> {
    let along = inner(a, u);
    [a[0] - along * u[0], a[1] - along * u[1], a[2] - along * u[2]]
}

#[inline(always)]
fn normalized<T: Number>(a: &Vector<T>) -> Vector<T> {
    let factor = T::one() / inner(a, a).sqrt();
    [a[0] * factor, a[1] * factor, a[2] * factor]
}

/// `a` in lanes with the condition, else `b`.
#[inline(always)]
fn choose<T: Number>(condition: T::Mask, a: &Vector<T>, b: &Vector<T>) -> Vector<T> {
    [a[0].select(condition, b[0]), a[1].select(condition, b[1]), a[2].select(condition, b[2])]
}
