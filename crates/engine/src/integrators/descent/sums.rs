//! Gradient and block of the incremental potential at the nodes of a batch.

use fem_elements::number::Float;
use fem_elements::number::{Lanes, Number};

/// Rows and columns of the upper half of a block, in the order in which its entries are kept.
pub(super) const UPPER: [(usize, usize); 6] = [(0, 0), (1, 1), (2, 2), (0, 1), (0, 2), (1, 2)];

/// Gradient and block at the node in each lane. `L` is a lane type, or the form in which its lanes are stored.
#[derive(Clone, Copy)]
pub(super) struct Sums<L> {
    /// N
    pub gradient: [L; 3],
    /// Entries of the symmetric block in the order of [`UPPER`], N/m.
    pub block: [L; 6],
    /// Square of the largest change of an element's shape with the node, 1/m²: of F, and for a law with a barrier of det F over itself.
    pub sharpness: L,
}

impl<L: Number> Sums<L> {
    /// No sums yet.
    #[inline(always)]
    pub fn zero() -> Self {
        let zero = L::zero();
        Self { gradient: [zero; 3], block: [zero; 6], sharpness: zero }
    }
}

impl<L: Lanes> Sums<L> {
    /// A part of stored sums.
    #[inline(always)]
    pub fn load(stored: &Sums<<L::Element as Float>::Lanes>, part: usize) -> Self {
        let (one, mut sums) = (L::one(), Self::zero());
        for i in 0..3 {
            sums.gradient[i] = one.load(&stored.gradient[i], part);
        }
        for i in 0..6 {
            sums.block[i] = one.load(&stored.block[i], part);
        }
        sums.sharpness = one.load(&stored.sharpness, part);
        sums
    }

    /// Replaces a part of stored sums.
    #[inline(always)]
    pub fn store(&self, stored: &mut Sums<<L::Element as Float>::Lanes>, part: usize) {
        for i in 0..3 {
            self.gradient[i].store(&mut stored.gradient[i], part);
        }
        for i in 0..6 {
            self.block[i].store(&mut stored.block[i], part);
        }
        self.sharpness.store(&mut stored.sharpness, part);
    }
}
