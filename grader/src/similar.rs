//! Compares the texts of the submissions of a class with each other, without running them.

pub mod fingerprints;
pub mod origin;
pub mod pairs;
#[cfg(test)]
mod tests;
mod tokens;

use grader::submission::{Source, Submission};

use crate::handout::Files;
use fingerprints::{Document, Given, all_pieces};
use origin::Origin;
use pairs::Pair;

/// Pairs that share less of their own text have no page: independent solutions share up to 0.21, and whole copies in disguise at least
/// 0.7.
pub const LEAST_SHARE: f64 = 0.25;

/// Folders of the handout with code that students use and need not read.
const LIBRARIES: [&str; 2] = ["crates", "grader"];

/// Bytes of all functions of one submission that are compared; the solutions have 60 000.
const MOST_TEXT: usize = 1 << 20;

/// The result of a comparison of a class with itself.
pub struct Found {
    pub pairs: Vec<Pair>,
    /// Submissions that pairs of at least [`LEAST_SHARE`] join, as their places in the class.
    pub groups: Vec<Vec<usize>>,
    /// The text of each function that was left out, and the text that most of the class has alike.
    pub origins: Vec<Origin>,
}

impl Found {
    /// Compares all submissions of a class.
    pub fn in_class(class: &[Document]) -> Self {
        let pairs = pairs::pairs(class);
        let groups = pairs::groups(class, &pairs, LEAST_SHARE);
        Self { pairs, groups, origins: origin::origins(class) }
    }
}

/// The pieces of what students were given: of the handout's sources, and of the code on its pages.
pub fn given(handout: &Files) -> Given {
    let mut given = Given::default();
    for (path, bytes) in handout {
        let text = String::from_utf8_lossy(bytes);
        let is_library = LIBRARIES.iter().any(|folder| path.starts_with(folder));
        let pieces = if is_library { &mut given.libraries } else { &mut given.exercises };
        match path.extension().and_then(|ending| ending.to_str()) {
            Some("rs") => pieces.extend(all_pieces(&text)),
            Some("md") => pieces.extend(code_blocks(&text).flat_map(all_pieces)),
            _ => {}
        }
    }
    given
}

/// The blocks of a page of Markdown between lines of three backticks.
fn code_blocks(page: &str) -> impl Iterator<Item = &str> {
    page.split("```").skip(1).step_by(2).filter_map(|block| Some(block.split_once('\n')?.1))
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
