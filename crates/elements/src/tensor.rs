//! 3×3 matrices of kernel numbers, `a[i][j]` in row i and column j, with the operations that materials need.

use nalgebra::{Matrix3, SMatrix, SymmetricEigen, U3};

use crate::number::{Number, constant};

/// A 3×3 matrix.
pub type Tensor<T> = [[T; 3]; 3];

/// The derivative of one 3×3 matrix with respect to another, both flattened row by row.
pub type Tensor4<T> = [[T; 9]; 9];

/// The zero matrix.
#[inline(always)]
pub fn zero<T: Number>() -> Tensor<T> {
    [[T::zero(); 3]; 3]
}

/// The matrix of the entries `entry(i, j)`.
#[inline(always)]
pub fn from_fn<T: Number>(mut entry: impl FnMut(usize, usize) -> T) -> Tensor<T> {
    let mut a = zero();
    for i in 0..3 {
        for j in 0..3 {
            a[i][j] = entry(i, j);
        }
    }
    a
}

/// The matrix of a function of each entry. In kernels the function is marked `inline(always)`.
#[inline(always)]
pub fn map<A: Copy, B>(a: &Tensor<A>, mut f: impl FnMut(A) -> B) -> Tensor<B> {
    let [[a, b, c], [d, e, g], [h, i, j]] = *a;
    [[f(a), f(b), f(c)], [f(d), f(e), f(g)], [f(h), f(i), f(j)]]
}

/// The deformation gradient F = 1 + G of a displacement gradient G.
#[inline(always)]
pub fn plus_identity<T: Number>(G: &Tensor<T>) -> Tensor<T> {
    let mut F = *G;
    for i in 0..3 {
        F[i][i] += T::one();
    }
    F
}

/// Σ a_ij b_ij
#[inline(always)]
pub fn dot<T: Number>(a: &Tensor<T>, b: &Tensor<T>) -> T {
    // Three sums, so that not every product waits for the one before.
    let mut sums = [a[0][0] * b[0][0], a[1][0] * b[1][0], a[2][0] * b[2][0]];
    for i in 0..3 {
        for j in 1..3 {
            sums[i] = a[i][j].times_plus(b[i][j], sums[i]);
        }
    }
    sums[0] + sums[1] + sums[2]
}

/// a_00 + a_11 + a_22
#[inline(always)]
pub fn trace<T: Number>(a: &Tensor<T>) -> T {
    a[0][0] + a[1][1] + a[2][2]
}

/// Cofactors, det(a) a^(−T): the derivative of the determinant.
#[inline(always)]
pub fn cofactor<T: Number>(a: &Tensor<T>) -> Tensor<T> {
    from_fn(
        #[inline(always)]
        |i, j| {
            let (i1, i2, j1, j2) = ((i + 1) % 3, (i + 2) % 3, (j + 1) % 3, (j + 2) % 3);
            a[i1][j1].times_plus(a[i2][j2], -(a[i1][j2] * a[i2][j1]))
        },
    )
}

/// The inverse of a 3×3 matrix by its cofactors; zero where the matrix is singular.
pub fn inverse(a: &Matrix3<f64>) -> Matrix3<f64> {
    let determinant = a.determinant();
    if determinant == 0.0 {
        return Matrix3::zeros();
    }
    let cofactors = cofactor(&from_fn(|i, j| a[(i, j)]));
    Matrix3::from_fn(|i, j| cofactors[j][i] / determinant)
}

/// Eigenvalues and eigenvectors of a symmetric 3×3 matrix. nalgebra's code is long, and compiled once here.
pub fn symmetric_eigen(a: Matrix3<f64>) -> SymmetricEigen<f64, U3> {
    a.symmetric_eigen()
}

/// A symmetric 9×9 matrix with its negative eigenvalues raised to zero; `None` where an entry is not finite.
pub fn raised(H: SMatrix<f64, 9, 9>) -> Option<SMatrix<f64, 9, 9>> {
    let mut eigen = SymmetricEigen::try_new(H, f64::EPSILON, 1000)?;
    eigen.eigenvalues.apply(|value| *value = value.max(0.0));
    Some(eigen.recompose())
}

/// a b
#[inline(always)]
pub fn product<T: Number>(a: &Tensor<T>, b: &Tensor<T>) -> Tensor<T> {
    from_fn(
        #[inline(always)]
        |i, j| a[i][2].times_plus(b[2][j], a[i][1].times_plus(b[1][j], a[i][0] * b[0][j])),
    )
}

/// aᵀ
#[inline(always)]
pub fn transpose<T: Number>(a: &Tensor<T>) -> Tensor<T> {
    from_fn(
        #[inline(always)]
        |i, j| a[j][i],
    )
}

/// H : a
#[inline(always)]
pub fn contracted<T: Number>(H: &Tensor4<T>, a: &Tensor<T>) -> Tensor<T> {
    from_fn(
        #[inline(always)]
        |i, j| {
            let mut sum = H[3 * i + j][0] * a[0][0];
            for c in 1..9 {
                sum += H[3 * i + j][c] * a[c / 3][c % 3];
            }
            sum
        },
    )
}

/// Adds b ∂cof(F)/∂F, the second derivative of the determinant: entries ±b F_ln.
#[inline(always)]
pub fn add_cofactor_derivative<T: Number>(H: &mut Tensor4<T>, b: T, F: &Tensor<T>) {
    for i in 0..3 {
        for step in 1..3 {
            let (k, l) = ((i + step) % 3, (i + 3 - step) % 3);
            for j in 0..3 {
                let (next, last) = ((j + 1) % 3, (j + 2) % 3);
                let (plus, minus) = if step == 1 { (next, last) } else { (last, next) };
                H[3 * i + j][3 * k + plus] += b * F[l][minus];
                H[3 * i + j][3 * k + minus] -= b * F[l][plus];
            }
        }
    }
}

/// J − 1 = tr G + tr cof G + det G, without the cancellation of det(1 + G) − 1; and its terms of second order and above,
/// tr cof G + det G.
#[inline(always)]
pub fn volume_change<T: Number>(G: &Tensor<T>) -> (T, T) {
    let c = cofactor(G);
    let second_order = trace(&c) + (G[0][0] * c[0][0] + G[0][1] * c[0][1] + G[0][2] * c[0][2]);
    (trace(G) + second_order, second_order)
}

/// Green's strain E = ½ (FᵀF − 1) = ½ (G + Gᵀ + GᵀG), accurate near rest.
#[inline(always)]
pub fn green_strain<T: Number>(G: &Tensor<T>) -> Tensor<T> {
    from_fn(
        #[inline(always)]
        |i, j| half::<T>() * (G[i][j] + G[j][i] + (G[0][i] * G[0][j] + G[1][i] * G[1][j] + G[2][i] * G[2][j])),
    )
}

/// s a⊗a + t (a⊗b + b⊗a) + r b⊗b.
#[inline(always)]
pub fn outer_products<T: Number>(s: T, t: T, r: T, a: &Tensor<T>, b: &Tensor<T>) -> Tensor4<T> {
    let mut H = [[T::zero(); 9]; 9];
    for i in 0..9 {
        let (ai, bi) = (a[i / 3][i % 3], b[i / 3][i % 3]);
        let (of_a, of_b) = (s * ai + t * bi, t * ai + r * bi);
        for j in 0..9 {
            H[i][j] = of_a * a[j / 3][j % 3] + of_b * b[j / 3][j % 3];
        }
    }
    H
}

/// Adds s times the identity.
#[inline(always)]
pub fn add_diagonal<T: Number>(H: &mut Tensor4<T>, s: T) {
    for i in 0..9 {
        H[i][i] += s;
    }
}

/// ½
#[inline(always)]
pub fn half<T: Number>() -> T {
    constant(0.5)
}
