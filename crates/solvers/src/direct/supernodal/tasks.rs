//! Subtrees of the supernodes that several threads factorise side by side.

use std::ops::Range;

use super::symbolic::SymbolicFactor;

/// Consecutive supernodes. The parts of a task are factorised side by side, then one thread goes on with the supernodes after them. Tasks depend
/// on the pattern alone, and update matrices are added up in the order of the supernodes: results do not depend on the number of threads.
pub struct Task {
    pub supernodes: Range<usize>,
    /// Subtrees at its beginning.
    pub parts: Vec<Task>,
    /// Scalars for its update matrices. At its end the one of its root is at the beginning.
    pub len_updates: usize,
}

impl Task {
    /// The whole factorisation.
    pub fn new(symbolic: &SymbolicFactor) -> Self {
        Self::over(symbolic, 0..symbolic.supernodes.len(), &symbolic.roots)
    }

    /// The subtrees with these roots.
    fn over<'a>(symbolic: &'a SymbolicFactor, supernodes: Range<usize>, mut roots: &'a [usize]) -> Self {
        // Down to where there are two large subtrees. Large ones come first.
        let large = loop {
            match roots.iter().take_while(|&&root| symbolic.supernodes[root].is_large).count() {
                1 => roots = symbolic.children(roots[0]),
                large => break &roots[..large],
            }
        };
        let mut first = supernodes.start;
        let mut parts = Vec::with_capacity(large.len());
        for &root in large {
            parts.push(Self::over(symbolic, first..root + 1, &[root]));
            first = root + 1;
        }
        let of_parts = parts.iter().map(|part| part.len_updates).sum();
        let mut task = Self { supernodes, parts, len_updates: of_parts };
        let mut len = task.parts.iter().map(|part| part.len_update(symbolic)).sum::<usize>();
        for number in task.rest() {
            let own = symbolic.supernodes[number].len_update();
            task.len_updates = task.len_updates.max(len + own);
            len += own;
            len -= symbolic.len_updates_of(symbolic.children(number));
        }
        task
    }

    /// The supernodes after the parts.
    pub fn rest(&self) -> Range<usize> {
        self.parts.last().map_or(self.supernodes.start, |part| part.supernodes.end)..self.supernodes.end
    }

    /// Scalars of the update matrix of its last supernode.
    pub fn len_update(&self, symbolic: &SymbolicFactor) -> usize {
        self.supernodes.clone().next_back().map_or(0, |last| symbolic.supernodes[last].len_update())
    }

    /// Its columns in L, scalars.
    pub fn columns(&self, symbolic: &SymbolicFactor) -> usize {
        symbolic.supernodes[self.supernodes.clone()].iter().map(|supernode| supernode.columns.len()).sum()
    }

    /// Its part of a vector, scalars.
    pub fn diagonal(&self, symbolic: &SymbolicFactor) -> usize {
        symbolic.supernodes[self.supernodes.clone()].iter().map(|supernode| supernode.diagonal.len()).sum()
    }
}
