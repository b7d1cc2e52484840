//! Cholesky factors and inverses of dense D×D blocks.

use fem_elements::number::Float;
use fem_elements::sparse::Block;
use fem_model::simulation::Breakdown;

/// Inverse L⁻ᵀ L⁻¹ of a symmetric positive definite block, from its lower triangle.
#[inline(always)]
pub(crate) fn invert<T: Float, const D: usize>(A: &Block<T, D>) -> Result<Block<T, D>, Breakdown> {
    let inverse_L = invert_lower(&factor(A)?);
    let mut inverse = [[T::default(); D]; D];
    for i in 0..D {
        for j in 0..D {
            for k in i.max(j)..D {
                inverse[i][j] += inverse_L[k][i] * inverse_L[k][j];
            }
        }
    }
    Ok(inverse)
}

/// The factor L of A = L Lᵀ, from the lower triangle of A.
#[inline(always)]
pub(crate) fn factor<T: Float, const D: usize>(A: &Block<T, D>) -> Result<Block<T, D>, Breakdown> {
    let mut L = [[T::default(); D]; D];
    for j in 0..D {
        let mut pivot = A[j][j];
        for k in 0..j {
            pivot -= L[j][k] * L[j][k];
        }
        L[j][j] = sqrt_pivot(pivot, A[j][j])?;
        for i in j + 1..D {
            let mut entry = A[i][j];
            for k in 0..j {
                entry -= L[i][k] * L[j][k];
            }
            L[i][j] = entry / L[j][j];
        }
    }
    Ok(L)
}

/// √pivot. Fails unless the pivot exceeds the round-off of the diagonal entry from which contributions were subtracted.
#[inline(always)]
pub(crate) fn sqrt_pivot<T: Float>(pivot: T, entry: T) -> Result<T, Breakdown> {
    if !pivot.is_finite() || !entry.is_finite() {
        return Err(Breakdown::Singular);
    }
    let round_off = T::EPSILON * entry.abs();
    match pivot {
        _ if pivot < -round_off => Err(Breakdown::NotPositiveDefinite),
        _ if pivot <= round_off => Err(Breakdown::Singular),
        _ => Ok(pivot.sqrt()),
    }
}

/// Inverse of a lower triangular block.
#[inline(always)]
pub(crate) fn invert_lower<T: Float, const D: usize>(L: &Block<T, D>) -> Block<T, D> {
    let mut inverse = [[T::default(); D]; D];
    for j in 0..D {
        inverse[j][j] = T::one() / L[j][j];
        for i in j + 1..D {
            let mut sum = T::default();
            for k in j..i {
                sum += L[i][k] * inverse[k][j];
            }
            inverse[i][j] = -sum / L[i][i];
        }
    }
    inverse
}
