//! Sorting by a small integer: linear time, where a comparison sort of millions of faces takes many seconds.

/// Entries by their bucket, sorted within each.
pub(crate) struct Buckets<E> {
    /// The entries of bucket i are `starts[i]..starts[i + 1]`.
    starts: Vec<usize>,
    entries: Vec<E>,
}

impl<E: Copy + Default + Ord> Buckets<E> {
    /// Puts entries into their buckets.
    pub(crate) fn new(entries: impl Iterator<Item = (usize, E)> + Clone) -> Self {
        let buckets = entries.clone().map(|(bucket, _)| bucket + 1).max().unwrap_or(0);
        let mut starts = vec![0; buckets + 1];
        entries.clone().for_each(|(bucket, _)| starts[bucket + 1] += 1);
        (0..buckets).for_each(|bucket| starts[bucket + 1] += starts[bucket]);
        let mut sorted = vec![E::default(); starts[buckets]];
        let mut ends = starts.clone();
        for (bucket, entry) in entries {
            sorted[ends[bucket]] = entry;
            ends[bucket] += 1;
        }
        starts.windows(2).for_each(|range| sorted[range[0]..range[1]].sort_unstable());
        Self { starts, entries: sorted }
    }

    /// The sorted entries of each bucket.
    pub(crate) fn iter(&self) -> impl Iterator<Item = &[E]> {
        self.starts.windows(2).map(|range| &self.entries[range[0]..range[1]])
    }
}
