//! Cholesky factorisation A = L Lᵀ: ours for small bodies, faer's, which uses several threads, for large ones.

use super::Breakdown;
use super::large::Large;
use super::supernodal::Supernodal;
use crate::number::Real;
use crate::sparse::Pattern;

/// Up to so many rows ours is faster: measured on beams, where both take as long at 8 000 rows, faer with two threads.
const ROWS_FOR_OURS: usize = 5_000;

/// A factor.
pub(super) enum Cholesky<T> {
    Ours(Box<Supernodal<T>>),
    Large(Box<Large<T>>),
}

impl<T: Real> Cholesky<T> {
    /// Finds the entries of L, for the order that the rows are in; `pattern` holds the lower half.
    pub(super) fn new(pattern: &Pattern) -> Self {
        if pattern.rows() <= ROWS_FOR_OURS {
            Self::Ours(Box::new(Supernodal::new(pattern)))
        } else {
            Self::Large(Box::new(Large::new(pattern)))
        }
    }

    /// Computes L.
    pub(super) fn prepare(&mut self, values: &[[[T; 3]; 3]]) -> Result<(), Breakdown> {
        match self {
            Self::Ours(factor) => factor.prepare(values),
            Self::Large(factor) => factor.prepare(values),
        }
    }

    /// z = A⁻¹ r
    pub(super) fn apply(&mut self, r: &[[T; 3]], z: &mut [[T; 3]]) {
        match self {
            Self::Ours(factor) => factor.apply(r, z),
            Self::Large(factor) => factor.apply(r, z),
        }
    }

    pub(super) fn bytes(&self) -> usize {
        match self {
            Self::Ours(factor) => factor.bytes(),
            Self::Large(factor) => factor.bytes(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::{Large, Supernodal};
    use crate::solvers::beam::{Beam, random};
    use crate::sparse::Stored;

    #[test]
    fn both_factors_solve_alike() {
        let beam = Beam::new(5, Stored::Lower);
        let values = beam.values::<f64>();
        let b = random(beam.pattern.rows(), 9);
        let (mut x, mut y) = (b.clone(), b.clone());
        let (mut ours, mut large) = (Supernodal::new(&beam.pattern), Large::new(&beam.pattern));
        ours.prepare(&values).unwrap();
        large.prepare(&values).unwrap();
        ours.apply(&b, &mut x);
        large.apply(&b, &mut y);
        for (x, y) in x.as_flattened().iter().zip(y.as_flattened()) {
            approx::assert_relative_eq!(x, y, max_relative = 1e-8, epsilon = 1e-16);
        }
    }

    #[test]
    fn both_factors_refuse_alike() {
        let beam = Beam::new(3, Stored::Lower);
        let indefinite = beam.scaled::<f64>(|element| if element % 5 == 0 { -1.5 } else { 1.0 }, 0.0);
        let mut infinite = beam.values::<f64>();
        infinite[7][1][1] = f64::INFINITY;
        for values in [indefinite, infinite] {
            let ours = Supernodal::new(&beam.pattern).prepare(&values);
            assert!(ours.is_err());
            assert_eq!(ours, Large::new(&beam.pattern).prepare(&values));
        }
    }
}
