//! The law of each batch of elements: the same for all of them, or one that depends on their internal variables.

use crate::materials::Law;
use crate::number::Number;

/// The laws of the elements of one material. Assembly asks for the law of a batch once.
pub trait BatchLaws<T: Number>: Copy + Sync {
    /// The law of a batch.
    type Law: Law<T>;

    /// True if loops are compiled for the law itself. Such a loop uses the widest registers on every processor; around calls by reference
    /// they make no difference.
    const IS_INLINED: bool;

    /// The law of the batch with this number of a chunk with these elements, as many in each batch as there are lanes.
    fn of_batch(&self, elements: &[u32], batch: usize) -> Self::Law;
}

/// One law for all elements.
impl<'a, T: Number, L: Law<T>> BatchLaws<T> for &'a L {
    type Law = &'a L;
    const IS_INLINED: bool = true;

    #[inline(always)]
    fn of_batch(&self, _elements: &[u32], _batch: usize) -> &'a L {
        self
    }
}
