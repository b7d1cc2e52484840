//! The polar decomposition F = R S: the rotation R nearest to F, within the plane and in space, without singular values.

use crate::number::{Float, Number, constant};
use crate::tensor::{Tensor, cofactor, dot, from_fn, green_strain, plus_identity, trace, volume_change};

/// The rotation R of the plane nearest to a deformation gradient.
#[derive(Clone, Copy)]
pub struct PlaneRotation<T> {
    /// cos θ
    pub cos: T,
    /// sin θ
    pub sin: T,
    /// cos θ − 1 with the digits of a small angle.
    pub cos_minus_1: T,
    /// r = tr(RᵀF)
    pub trace: T,
    /// r − 2, with the digits of a small strain.
    pub strain: T,
}

impl<T: Number> PlaneRotation<T> {
    /// The rotation nearest to 1 + G; no rotation where all are as near, F_11 + F_22 = F_21 − F_12 = 0.
    #[inline(always)]
    pub fn of(G: &Tensor<T>) -> Self {
        let (one, two) = (T::one(), constant::<T>(2.0));
        let g = G[0][0] + G[1][1];
        let (a, b) = (two + g, G[1][0] - G[0][1]);
        let square = b * b;
        let trace = (a * a + square).sqrt();
        let is_turned = trace.gt(T::zero());
        let inverse = one / trace.select(is_turned, one);
        let cos = (a * inverse).select(is_turned, one);
        let sin = b * inverse;
        let of_small_angle = -square * inverse / (trace + a);
        let cos_minus_1 = of_small_angle.select(a.gt(T::zero()), cos - one);
        let strain = (g * (constant::<T>(4.0) + g) + square) / (trace + two);
        Self { cos, sin, cos_minus_1, trace, strain }
    }
}

/// The rotation R nearest to F = 1 + G in space.
///
/// x = tr(RᵀF), the sum of the signed singular values, is the largest root of x⁴ − 2 I x² − 8 J x + I² − 4 II, I = tr(FᵀF),
/// II = |cof F|², J = det F, and R = ∂x/∂F = ((x² + I) F − 2 F FᵀF + 2 x cof F)/D with D = x³ − I x − 2 J = 2 Π_{i<j} (σ_i + σ_j):
/// Lin, Chitalu and Komura, Isotropic ARAP Energy Using Cauchy–Green Invariants (2022). All is written in terms of G, so that the
/// strain x − 3 and R − 1 keep their digits near rest.
#[derive(Clone, Copy)]
pub struct SpaceRotation<T> {
    /// R − 1
    pub change: Tensor<T>,
    /// tr(RᵀF) − 3, with the digits of a small strain.
    pub strain: T,
    /// D = 2 (σ_1 + σ_2) (σ_2 + σ_3) (σ_3 + σ_1)
    denominator: T,
}

/// Smallest D, in units of x³ of which it is 16/27 at rest, for which R comes from the closed form: where two singular values cancel,
/// R jumps, and near there the root loses its digits.
const SMALLEST: f64 = 0.05;

/// Largest number of Newton's iterations for the root. Most elements need three; more are needed next to [`SMALLEST`].
const ITERATIONS: usize = 16;

impl<T: Number> SpaceRotation<T> {
    /// The rotation nearest to 1 + G; `None` where it is ill-conditioned, or not finite, in some lane.
    #[inline(always)]
    pub fn of(G: &Tensor<T>) -> Option<Self> {
        let (two, three, four) = (constant::<T>(2.0), constant::<T>(3.0), constant::<T>(4.0));
        let squares = dot(G, G);
        let i = two * trace(G) + squares;
        let (j, _) = volume_change(G);
        let mut K = cofactor(G);
        let trace_of_G = trace(G);
        for row in 0..3 {
            for column in 0..3 {
                K[row][column] -= G[column][row];
            }
            K[row][row] += trace_of_G;
        }
        let k = two * trace(&K) + dot(&K, &K);
        let y = largest_root(i, j, k, squares)?;
        let x = three + y;
        let square = y * y;
        let denominator =
            constant::<T>(16.0) + constant::<T>(24.0) * y + constant::<T>(9.0) * square + square * y - i * x - two * j;
        if !T::all(denominator.gt(constant::<T>(SMALLEST) * x * x * x)) {
            return None;
        }
        let inverse = T::one() / denominator;
        let of_one = -y * (constant::<T>(16.0) + y * (constant::<T>(8.0) + y)) + i * (four + y) + two * j;
        let of_G = x * x + i + T::one();
        let E = green_strain(G);
        let mut change = from_fn(
            #[inline(always)]
            |r, c| {
                let GE = G[r][0] * E[0][c] + G[r][1] * E[1][c] + G[r][2] * E[2][c];
                (of_G * G[r][c] - four * (E[r][c] + GE) + two * x * K[r][c]) * inverse
            },
        );
        for r in 0..3 {
            change[r][r] += of_one * inverse;
        }
        Some(Self { change, strain: y, denominator })
    }

    /// R
    #[inline(always)]
    pub fn rotation(&self) -> Tensor<T> {
        plus_identity(&self.change)
    }

    /// (tr S 1 − S)⁻¹, S = RᵀF, whose eigenvalues are 1/(σ_i + σ_j): with t_k = R \[e_k\]×, ∂R/∂F = Σ B_kl t_k ⊗ t_l.
    #[inline(always)]
    pub fn spin(&self, G: &Tensor<T>) -> Tensor<T> {
        let (R, F) = (self.rotation(), plus_identity(G));
        self.spin_of(&crate::tensor::product(&crate::tensor::transpose(&R), &F))
    }

    /// The same from S.
    #[inline(always)]
    pub fn spin_of(&self, S: &Tensor<T>) -> Tensor<T> {
        let x = constant::<T>(3.0) + self.strain;
        let mut A = from_fn(
            #[inline(always)]
            |i, j| -S[i][j],
        );
        for k in 0..3 {
            A[k][k] += x;
        }
        let inverse = constant::<T>(2.0) / self.denominator;
        let cofactors = cofactor(&A);
        from_fn(
            #[inline(always)]
            |i, j| cofactors[i][j] * inverse,
        )
    }
}

/// y = x − 3 for the largest root x, from I − 3, J − 1, II − 3 and G:G: Newton's method from √(3 I) − 3, which lies above it, so that
/// it descends to the root. `None` if it does not arrive in some lane.
#[inline(always)]
fn largest_root<T: Number>(i: T, j: T, k: T, squares: T) -> Option<T> {
    let (two, four, twelve) = (constant::<T>(2.0), constant::<T>(4.0), constant::<T>(12.0));
    let i12 = twelve * i;
    let linear = constant::<T>(64.0) - i12 - constant::<T>(8.0) * j;
    let quadratic = constant::<T>(48.0) - two * i;
    let absolute = i * i - i12 - constant::<T>(24.0) * j - four * k;
    // The square of an update after which one more is enough.
    let small = constant::<T>(1e-2 * Float::as_f64(<T::Element as Float>::EPSILON)) * squares;
    let triple = constant::<T>(3.0) * i;
    let mut y = triple / ((constant::<T>(9.0) + triple).sqrt() + constant::<T>(3.0));
    let mut is_found = false;
    for _ in 0..ITERATIONS {
        let value = absolute + y * (linear + y * (quadratic + y * (twelve + y)));
        let slope = linear + y * (two * quadratic + y * (constant::<T>(36.0) + four * y));
        let update = value / slope;
        y -= update;
        if is_found {
            return Some(y);
        }
        is_found = T::all((update * update).le(small));
    }
    None
}
