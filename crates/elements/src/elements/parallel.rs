//! Chunks in parallel, each with its own part of the output.

use super::Chunk;
use crate::number::Float;
use crate::threads::join;

/// The work on one chunk and its part of the output. One call per chunk takes no measurable time, and the loop is compiled once.
pub(super) type Work<'a, T, X, const D: usize, const E: usize, const N: usize> =
    &'a (dyn Fn(&Chunk<T, D, E, N>, &mut [X]) -> f64 + Sync);

/// Calls `work` for each chunk with its part of `output`, in parallel where there is more than one, and adds up what it
/// returns, in the same order with any number of threads. `end` gives the end of a chunk's part.
pub(super) fn over_chunks<T: Float, X: Send, const D: usize, const E: usize, const N: usize>(
    chunks: &[Chunk<T, D, E, N>],
    output: &mut [X],
    end: fn(&Chunk<T, D, E, N>) -> usize,
    work: Work<T, X, D, E, N>,
) -> f64 {
    recurse(chunks, output, 0, end, work)
}

fn recurse<T: Float, X: Send, const D: usize, const E: usize, const N: usize>(
    chunks: &[Chunk<T, D, E, N>],
    output: &mut [X],
    start: usize,
    end: fn(&Chunk<T, D, E, N>) -> usize,
    work: Work<T, X, D, E, N>,
) -> f64 {
    match chunks {
        [] => 0.0,
        [chunk] => {
            let length = end(chunk) - start;
            work(chunk, &mut output[..length])
        }
        _ => {
            let (first, second) = chunks.split_at(chunks.len() / 2);
            let middle = first.last().map_or(start, end);
            let (left, right) = output.split_at_mut(middle - start);
            let (a, b) = join(|| recurse(first, left, start, end, work), || recurse(second, right, middle, end, work));
            a + b
        }
    }
}
