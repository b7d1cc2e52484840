//! Compares the texts of the submissions of a class with each other, without running them.

pub mod fingerprints;
pub mod pairs;
#[cfg(test)]
mod tests;
mod tokens;

use std::collections::HashSet;

use grader::submission::{Source, Submission};

use crate::handout::Files;
use fingerprints::all_pieces;

/// Pairs that share less of their own text have no page: independent solutions share up to 0.15, and whole copies in disguise at least
/// 0.7.
pub const LEAST_SHARE: f64 = 0.25;

/// Bytes of all functions of one submission that are compared; the solutions have 60 000.
const MOST_TEXT: usize = 1 << 20;

/// The pieces of what students were given.
pub fn given(handout: &Files) -> HashSet<u64> {
    let is_source = |path: &std::path::Path| path.extension().is_some_and(|ending| ending == "rs");
    let texts = handout.iter().filter(|(path, _)| is_source(path)).map(|(_, text)| String::from_utf8_lossy(text));
    texts.flat_map(|text| all_pieces(&text)).collect()
}

/// The functions of a submission that are compared: those that are written, whether they compile or not. A submission with
/// an implausible amount of text is left out.
pub fn texts(submission: &Submission) -> Vec<(&'static str, String)> {
    let written = submission.functions.iter().filter_map(|(name, source)| match source {
        Source::Written(text) => Some((*name, text.clone())),
        _ => None,
    });
    let texts: Vec<_> = written.collect();
    if texts.iter().map(|(_, text)| text.len()).sum::<usize>() > MOST_TEXT { Vec::new() } else { texts }
}
