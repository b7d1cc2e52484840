//! The law of each batch of elements: the same for all of them, or one that depends on their internal variables.

use crate::materials::{Law, Projected};
use crate::number::Number;

/// The laws of the elements of one material. Assembly asks for the law of a batch once.
pub trait BatchLaws<T: Number>: Copy + Sync {
    /// The law of a batch.
    type Law: Law<T>;

    /// The law of the batch with this number of a chunk with these elements, as many in each batch as there are lanes.
    fn of_batch(&self, elements: &[u32], batch: usize) -> Self::Law;
}

/// One law for all elements.
impl<'a, T: Number, L: Law<T> + ?Sized> BatchLaws<T> for &'a L {
    type Law = &'a L;

    #[inline(always)]
    fn of_batch(&self, _elements: &[u32], _batch: usize) -> &'a L {
        self
    }
}

impl<T: Number, B: BatchLaws<T>> BatchLaws<T> for Projected<B> {
    type Law = Projected<B::Law>;

    #[inline(always)]
    fn of_batch(&self, elements: &[u32], batch: usize) -> Projected<B::Law> {
        Projected(self.0.of_batch(elements, batch))
    }
}
