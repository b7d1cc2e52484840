//! The part of each function's text that the handout gave, which is left out, and the part that most of a class has alike, which is
//! not.

use std::collections::{HashMap, HashSet};

use grader::submission::NAMES;

use super::fingerprints::{Document, PIECE, hashes};

/// Fewer submissions with the same text are a pair and no common text.
const FEWEST: usize = 3;

/// The origin of a function's text in a whole class, in tokens.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Origin {
    pub function: &'static str,
    /// All tokens of the function's files.
    pub tokens: usize,
    /// Tokens that the handout gave. They are left out.
    pub given: usize,
    /// Tokens of their authors that more than half of the submissions have alike. They count.
    pub common: usize,
}

impl Origin {
    /// The given part of the text.
    pub fn given_share(&self) -> f64 {
        self.given as f64 / self.tokens.max(1) as f64
    }

    /// The common part of the text.
    pub fn common_share(&self) -> f64 {
        self.common as f64 / self.tokens.max(1) as f64
    }
}

/// The origin of the text of each function that somebody has written, and of all functions together under the name `all`.
pub fn origins(class: &[Document]) -> Vec<Origin> {
    let mut owners: HashMap<u64, usize> = HashMap::new();
    for document in class {
        let own: HashSet<u64> = document.files.iter().flat_map(|file| hashes(&file.tokens)).collect();
        own.into_iter().for_each(|hash| *owners.entry(hash).or_default() += 1);
    }
    let is_common = |hash: &u64| owners[hash] >= FEWEST && 2 * owners[hash] > class.len();
    let mut origins: Vec<Origin> = NAMES.map(|function| Origin { function, ..Origin::default() }).to_vec();
    for file in class.iter().flat_map(|document| &document.files) {
        let mut common = vec![false; file.tokens.len()];
        for (place, _) in hashes(&file.tokens).iter().enumerate().filter(|(_, hash)| is_common(hash)) {
            common[place..place + PIECE].fill(true);
        }
        let Some(origin) = origins.iter_mut().find(|origin| origin.function == file.name) else { continue };
        origin.tokens += file.tokens.len();
        origin.given += file.is_own.iter().filter(|own| !**own).count();
        origin.common += file.is_own.iter().zip(common).filter(|(own, common)| **own && *common).count();
    }
    origins.retain(|origin| origin.tokens > 0);
    let sum = |part: fn(&Origin) -> usize| origins.iter().map(part).sum();
    let all = Origin {
        function: "all",
        tokens: sum(|origin| origin.tokens),
        given: sum(|origin| origin.given),
        common: sum(|origin| origin.common),
    };
    origins.push(all);
    origins
}
