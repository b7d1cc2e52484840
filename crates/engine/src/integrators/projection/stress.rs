//! The stress of an element as the unknown of a constraint.
//!
//! With M/Δt² (x − x̃) = −Σ_e V_e Π_e ∇φ, with the positions x̃ of inertia and loads alone, the unknowns of a step of implicit Euler
//! are the stresses Π_e, which have to be those of the material, Π_e = P(F_e(x)). A Gauss–Seidel sweep over these equations corrects
//! one element after the other, and the positions of its nodes with it, so that the equation of motion holds at all times: Chaudhary,
//! Pokhariya and Narain, Towards Generalized Position-Based Dynamics (2025); for a material with a linear stress it is XPBD with the
//! strain as constraint. Newton's method for one element, ΔΠ = P(F) − Π + H ΔF with ΔF_i = −L_i L_iᵀ ΔΠ_i for each coordinate i, is
//! symmetric in y = Lᵀ ΔΠ: (1 + Lᵀ H L) y = Lᵀ (P − Π), ΔΠ = P − Π − H L y.

use fem_elements::materials::Law;
use fem_elements::number::{Lanes, Number, constant};
use fem_elements::tensor::{Tensor, Tensor4, volume_change, zero};

/// Smallest pivot that makes the exact Hessian of an element good enough.
const SMALLEST_PIVOT: f64 = 0.1;

/// ΔΠ of an element.
#[inline(always)]
pub(super) fn change_of_stress<L: Lanes>(
    law: &dyn Law<L>,
    allows_inversion: bool,
    G: &Tensor<L>,
    stress: &Tensor<L>,
    factors: &[Tensor<L>; 3],
) -> Tensor<L> {
    let is_upright = (volume_change(G).0 + L::one()).gt(L::zero());
    let needs_rest = !allows_inversion && !L::all(is_upright);
    // Where the law has no stress, the element is treated as a linear one until it is upright again.
    let H_rest = if needs_rest { law.derivative(&zero()) } else { [[L::zero(); 9]; 9] };
    let replace = |H: &mut Tensor4<L>| {
        for (row, rest) in H.iter_mut().zip(&H_rest) {
            for (entry, rest) in row.iter_mut().zip(rest) {
                *entry = entry.select(is_upright, *rest);
            }
        }
    };
    let mut P = law.stress(G);
    if needs_rest {
        for row in 0..9 {
            let mut linear = L::zero();
            for column in 0..9 {
                linear = H_rest[row][column].times_plus(G[column / 3][column % 3], linear);
            }
            P[row / 3][row % 3] = P[row / 3][row % 3].select(is_upright, linear);
        }
    }
    let mut residual = [L::zero(); 9];
    for row in 0..9 {
        residual[row] = P[row / 3][row % 3] - stress[row / 3][row % 3];
    }
    let mut H = law.derivative(G);
    if needs_rest {
        replace(&mut H);
    }
    let (mut A, mut is_definite) = factorized(&H, factors);
    if !is_definite {
        H = law.projected_derivative(G);
        if needs_rest {
            replace(&mut H);
        }
        (A, is_definite) = factorized(&H, factors);
        // NaN if the displacements are not finite: the check of the state ends the step.
        let _ = is_definite;
    }
    let y = substitute(&A, &to_coordinates(factors, &residual));
    let s = from_coordinates(factors, &y);
    let mut change = zero::<L>();
    for row in 0..9 {
        let mut sum = residual[row];
        for column in 0..9 {
            sum -= H[row][column] * s[column];
        }
        change[row / 3][row % 3] = sum;
    }
    change
}

/// Lᵀ r
#[inline(always)]
fn to_coordinates<L: Number>(factors: &[Tensor<L>; 3], r: &[L; 9]) -> [L; 9] {
    let mut y = [L::zero(); 9];
    for i in 0..3 {
        for k in 0..3 {
            for j in k..3 {
                y[3 * i + k] = factors[i][j][k].times_plus(r[3 * i + j], y[3 * i + k]);
            }
        }
    }
    y
}

/// L y
#[inline(always)]
fn from_coordinates<L: Number>(factors: &[Tensor<L>; 3], y: &[L; 9]) -> [L; 9] {
    let mut s = [L::zero(); 9];
    for i in 0..3 {
        for j in 0..3 {
            for k in 0..=j {
                s[3 * i + j] = factors[i][j][k].times_plus(y[3 * i + k], s[3 * i + j]);
            }
        }
    }
    s
}

/// Cholesky's factor of 1 + Lᵀ H L in the lower half, with inverse pivots, and whether it is definite enough in every lane.
#[inline(always)]
fn factorized<L: Lanes>(H: &Tensor4<L>, factors: &[Tensor<L>; 3]) -> (Tensor4<L>, bool) {
    let mut A = [[L::zero(); 9]; 9];
    for row in 0..9 {
        A[row] = to_coordinates(factors, &H[row]);
    }
    for column in 0..9 {
        let mut of_column = [L::zero(); 9];
        for row in 0..9 {
            of_column[row] = A[row][column];
        }
        of_column = to_coordinates(factors, &of_column);
        of_column[column] += L::one();
        for row in 0..9 {
            A[row][column] = of_column[row];
        }
    }
    let smallest = constant::<L>(SMALLEST_PIVOT);
    let mut least = L::one();
    for k in 0..9 {
        let mut pivot = A[k][k];
        for m in 0..k {
            pivot -= A[k][m] * A[k][m];
        }
        least = least.select(least.lt(pivot), pivot);
        let inverse = L::one() / pivot.sqrt();
        A[k][k] = inverse;
        for row in k + 1..9 {
            let mut entry = A[row][k];
            for m in 0..k {
                entry -= A[row][m] * A[k][m];
            }
            A[row][k] = entry * inverse;
        }
    }
    (A, L::all(least.gt(smallest)))
}

/// Solves with the factor.
#[inline(always)]
fn substitute<L: Number>(A: &Tensor4<L>, b: &[L; 9]) -> [L; 9] {
    let mut y = *b;
    for k in 0..9 {
        for m in 0..k {
            let known = A[k][m] * y[m];
            y[k] -= known;
        }
        y[k] *= A[k][k];
    }
    for k in (0..9).rev() {
        for m in k + 1..9 {
            let known = A[m][k] * y[m];
            y[k] -= known;
        }
        y[k] *= A[k][k];
    }
    y
}
