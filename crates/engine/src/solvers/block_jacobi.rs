//! The preconditioner of the diagonal blocks alone.

use super::Breakdown;
use crate::number::Real;
use crate::sparse::Pattern;

/// The inverse of each diagonal block.
pub(super) struct BlockJacobi<T> {
    /// Number of each diagonal block in the matrix.
    diagonal: Vec<u32>,
    inverses: Vec<[[T; 3]; 3]>,
}

impl<T: Real> BlockJacobi<T> {
    pub(super) fn new(pattern: &Pattern) -> Self {
        let diagonal: Vec<u32> = pattern.diagonal().map(|block| block as u32).collect();
        Self { inverses: vec![Default::default(); diagonal.len()], diagonal }
    }

    pub(super) fn prepare(&mut self, values: &[[[T; 3]; 3]]) -> Result<(), Breakdown> {
        for (inverse, &block) in self.inverses.iter_mut().zip(&self.diagonal) {
            *inverse = invert(&values[block as usize])?;
        }
        Ok(())
    }

    pub(super) fn apply(&self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        for ((z, r), inverse) in z.iter_mut().zip(r).zip(&self.inverses) {
            *z = inverse.map(|row| row[0] * r[0] + row[1] * r[1] + row[2] * r[2]);
        }
    }

    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.diagonal.as_slice()) + size_of_val(self.inverses.as_slice())
    }
}

/// Inverse of a symmetric positive definite D×D block, of which the lower triangle is read: by A = L Lᵀ, A⁻¹ = L⁻ᵀ L⁻¹.
pub(super) fn invert<T: Real, const D: usize>(A: &[[T; D]; D]) -> Result<[[T; D]; D], Breakdown> {
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

/// L of A = L Lᵀ, of which the lower triangle is read.
pub(super) fn factor<T: Real, const D: usize>(A: &[[T; D]; D]) -> Result<[[T; D]; D], Breakdown> {
    let mut L = [[T::default(); D]; D];
    for j in 0..D {
        let mut pivot = A[j][j];
        for k in 0..j {
            pivot -= L[j][k] * L[j][k];
        }
        L[j][j] = root(pivot, A[j][j])?;
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

/// √pivot, where the pivot is more than what rounding leaves of the diagonal entry that it began as.
pub(super) fn root<T: Real>(pivot: T, entry: T) -> Result<T, Breakdown> {
    if !pivot.is_finite() || !entry.is_finite() {
        return Err(Breakdown::Singular);
    }
    let doubt = T::EPSILON * entry.abs();
    match pivot {
        _ if pivot < -doubt => Err(Breakdown::NotPositiveDefinite),
        _ if pivot <= doubt => Err(Breakdown::Singular),
        _ => Ok(pivot.sqrt()),
    }
}

pub(super) fn invert_lower<T: Real, const D: usize>(L: &[[T; D]; D]) -> [[T; D]; D] {
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

#[cfg(test)]
mod tests {
    use super::invert;
    use crate::solvers::Breakdown;

    #[test]
    fn a_block_times_its_inverse_is_the_identity() {
        let A = [[4.0, 1.0, -0.5], [1.0, 3.0, 0.2], [-0.5, 0.2, 2.0]];
        let inverse = invert(&A).unwrap();
        for i in 0..3 {
            for j in 0..3 {
                let entry: f64 = (0..3).map(|k| A[i][k] * inverse[k][j]).sum();
                assert!((entry - f64::from(u8::from(i == j))).abs() < 1e-15, "({i}, {j}): {entry}");
            }
        }
    }

    #[test]
    fn blocks_without_an_inverse_are_named() {
        assert_eq!(invert(&[[-1.0, 0.0], [0.0, 1.0]]), Err(Breakdown::NotPositiveDefinite));
        assert_eq!(invert(&[[1.0, 1.0], [1.0, 1.0]]), Err(Breakdown::Singular));
        assert_eq!(invert(&[[f64::NAN, 0.0], [0.0, 1.0]]), Err(Breakdown::Singular));
    }
}
