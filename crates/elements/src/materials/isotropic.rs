//! The stress derivative of an isotropic law in the basis of its principal stretches, and its projection.
//!
//! With F = U diag(σ) Vᵀ, p_i = ∂ψ/∂σ_i and (i, j, k) the three axes in any order, ∂P/∂F has the eigenvalues
//! (p_i + p_j)/(σ_i + σ_j) for the twist (u_i v_jᵀ − u_j v_iᵀ)/√2, (p_i − p_j)/(σ_i − σ_j) for the flip (u_i v_jᵀ + u_j v_iᵀ)/√2,
//! and those of ∂²ψ/∂σ_i∂σ_j for the scalings u_i v_iᵀ: Smith, de Goes and Kim, Analytic Eigensystems for Isotropic Distortion
//! Energies (2019). Laws give the ratios with their denominators divided out, so that equal stretches give
//! no 0/0.

use pulp::{Simd, WithSimd};

use crate::number::Number;
use crate::svd::{Svd, largest_entry, rotation, turn, unit};
use crate::tensor::{Tensor, Tensor4, zero};

/// Sweeps of Jacobi's iteration; each sweep squares the remaining angles.
const SWEEPS: usize = 5;

/// The derivative in the principal basis; the index of twist and flip of the axes i and j is the third axis.
#[derive(Clone, Copy)]
pub(crate) struct Principal<T> {
    /// ∂²ψ/∂σ_i∂σ_j
    pub scaling: Tensor<T>,
    /// (p_i + p_j)/(σ_i + σ_j)
    pub twist: [T; 3],
    /// (p_i − p_j)/(σ_i − σ_j)
    pub flip: [T; 3],
}

impl<T: Number> Principal<T> {
    #[inline(always)]
    pub fn zero() -> Self {
        Self { scaling: zero(), twist: [T::zero(); 3], flip: [T::zero(); 3] }
    }
}

/// The positive semi-definite projection: negative eigenvalues raised to zero.
#[inline(always)]
fn projected<T: Number>(principal: &Principal<T>) -> Principal<T> {
    let mut raised = *principal;
    for k in 0..3 {
        raised.twist[k] = raised.twist[k].max(T::zero());
        raised.flip[k] = raised.flip[k].max(T::zero());
    }
    add_negative_part(&mut raised.scaling);
    raised
}

/// A − Σ min(λ, 0) w wᵀ over the eigenvalues λ and eigenvectors w of A. A matrix without negative eigenvalues stays as it is.
#[inline(always)]
fn add_negative_part<T: Number>(A: &mut Tensor<T>) {
    let size = largest_entry(A);
    let (eigenvalues, w) = eigen(A, size);
    for k in 0..3 {
        let lift = -size * eigenvalues[k].min(T::zero());
        for i in 0..3 {
            for j in 0..3 {
                A[i][j] += lift * (w[k][i] * w[k][j]);
            }
        }
    }
}

/// Eigenvalues of a symmetric A/size, unsorted, and unit eigenvectors: Jacobi, Über ein leichtes Verfahren (1846).
#[inline(always)]
pub(super) fn eigen<T: Number>(A: &Tensor<T>, size: T) -> ([T; 3], [[T; 3]; 3]) {
    let inverse = T::one() / size;
    let mut diagonal = [A[0][0] * inverse, A[1][1] * inverse, A[2][2] * inverse];
    // The index of the entry of the axes i and j is the third axis.
    let mut beside = [A[1][2] * inverse, A[2][0] * inverse, A[0][1] * inverse];
    let mut w = unit();
    for _ in 0..SWEEPS {
        for (i, j, k) in [(0, 1, 2), (1, 2, 0), (2, 0, 1)] {
            let p = beside[k];
            let (c, s) = rotation(p, diagonal[j] - diagonal[i]);
            let change = s / c * p;
            diagonal[i] -= change;
            diagonal[j] += change;
            let (of_i, of_j) = (beside[j], beside[i]);
            beside[j] = c * of_i - s * of_j;
            beside[i] = s * of_i + c * of_j;
            beside[k] = T::zero();
            turn(&mut w, i, j, c, s);
        }
    }
    (diagonal, w)
}

/// ∂P/∂F with its negative eigenvalues raised to zero.
#[inline(never)]
pub(crate) fn projected_derivative_from<T: Number>(F: &Svd<T>, principal: &Principal<T>) -> Tensor4<T> {
    T::vectorize(DerivativeOf { F, principal, is_projected: true })
}

/// ∂P/∂F. All laws share its code, compiled once for each number type.
#[inline(never)]
pub(crate) fn derivative_from<T: Number>(F: &Svd<T>, principal: &Principal<T>) -> Tensor4<T> {
    T::vectorize(DerivativeOf { F, principal, is_projected: false })
}

struct DerivativeOf<'a, T> {
    F: &'a Svd<T>,
    principal: &'a Principal<T>,
    is_projected: bool,
}

impl<T: Number> WithSimd for DerivativeOf<'_, T> {
    type Output = Tensor4<T>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> Tensor4<T> {
        let principal = if self.is_projected { projected(self.principal) } else { *self.principal };
        derivative_of(self.F, &principal)
    }
}

#[inline(always)]
fn derivative_of<T: Number>(F: &Svd<T>, principal: &Principal<T>) -> Tensor4<T> {
    let half = crate::tensor::half::<T>();
    let q = basis(F);
    // With the same row of `images`, ∂P/∂F = Σ q ⊗ image.
    let mut images = [[T::zero(); 9]; 9];
    for i in 0..3 {
        for j in 0..3 {
            for entry in 0..9 {
                images[3 * i + j][entry] = if i == j {
                    let A = &principal.scaling[i];
                    A[0] * q[0][entry] + A[1] * q[4][entry] + A[2] * q[8][entry]
                } else {
                    let (twist, flip) = (principal.twist[3 - i - j], principal.flip[3 - i - j]);
                    half * ((flip + twist) * q[3 * i + j][entry] + (flip - twist) * q[3 * j + i][entry])
                };
            }
        }
    }
    symmetric_product(&q, &images)
}

/// ∂P/∂F of which `H` has the components in the basis u_k v_lᵀ.
#[inline(never)]
pub(crate) fn derivative_in_basis<T: Number>(F: &Svd<T>, H: &Tensor4<T>) -> Tensor4<T> {
    T::vectorize(InBasis { F, H })
}

struct InBasis<'a, T> {
    F: &'a Svd<T>,
    H: &'a Tensor4<T>,
}

impl<T: Number> WithSimd for InBasis<'_, T> {
    type Output = Tensor4<T>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _simd: S) -> Tensor4<T> {
        product_in_basis(self.F, self.H)
    }
}

#[inline(always)]
fn product_in_basis<T: Number>(F: &Svd<T>, H: &Tensor4<T>) -> Tensor4<T> {
    let q = basis(F);
    let mut images = [[T::zero(); 9]; 9];
    for row in 0..9 {
        for entry in 0..9 {
            for column in 0..9 {
                images[row][entry] += H[row][column] * q[column][entry];
            }
        }
    }
    symmetric_product(&q, &images)
}

/// The matrices u_i v_jᵀ, one in each row.
#[inline(always)]
fn basis<T: Number>(F: &Svd<T>) -> Tensor4<T> {
    let mut q = [[T::zero(); 9]; 9];
    for row in 0..9 {
        for column in 0..9 {
            q[row][column] = F.U[row / 3][column / 3] * F.V[row % 3][column % 3];
        }
    }
    q
}

/// Σ q ⊗ image, of which the upper half is computed and mirrored.
#[inline(always)]
fn symmetric_product<T: Number>(q: &Tensor4<T>, images: &Tensor4<T>) -> Tensor4<T> {
    let mut H = [[T::zero(); 9]; 9];
    for row in 0..9 {
        for column in row..9 {
            let mut sum = T::zero();
            for k in 0..9 {
                sum += q[k][row] * images[k][column];
            }
            H[row][column] = sum;
            H[column][row] = sum;
        }
    }
    H
}
