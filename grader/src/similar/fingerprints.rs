//! Fingerprints of texts by winnowing: of each few neighbouring pieces the one with the smallest hash.
//! (S. Schleimer, D. S. Wilkerson, A. Aiken, Winnowing: local algorithms for document fingerprinting, SIGMOD 2003.)

use std::collections::{HashMap, HashSet};

use super::tokens::{Kind, Token, tokens};

/// Tokens of one piece: a shorter run that two texts share is coincidence.
pub const PIECE: usize = 24;

/// Neighbouring pieces of which one is kept: each shared run of `PIECE + WINDOW − 1` tokens is found.
const WINDOW: usize = 8;

/// Neighbouring pieces of the given libraries that make a run: among so many lines a single piece is found by chance.
const LIBRARY_RUN: usize = PIECE + 1;

/// Pieces of the text that students were given.
#[derive(Default)]
pub struct Given {
    /// Of the files that they work on and read.
    pub exercises: HashSet<u64>,
    /// Of the libraries beside them, which count in longer runs alone.
    pub libraries: HashSet<u64>,
}

impl Given {
    /// Returns for each piece of a text, in its order, whether it was given.
    pub fn places(&self, hashes: &[u64]) -> Vec<bool> {
        let mut given: Vec<bool> = hashes.iter().map(|hash| self.exercises.contains(hash)).collect();
        let mut begin = 0;
        for end in 0..=hashes.len() {
            if hashes.get(end).is_some_and(|hash| given[end] || self.libraries.contains(hash)) {
                continue;
            }
            if end - begin >= LIBRARY_RUN {
                given[begin..end].fill(true);
            }
            begin = end + 1;
        }
        given
    }
}

/// One file of a submission.
#[derive(Clone)]
pub struct File {
    pub name: &'static str,
    pub text: String,
    pub tokens: Vec<Token>,
    /// True for each token of the author: a token in no piece that the handout has too.
    pub is_own: Vec<bool>,
}

/// A submission as it is compared.
#[derive(Clone)]
pub struct Document {
    pub submission: String,
    pub students: Vec<String>,
    pub files: Vec<File>,
    /// Places of the pieces that are kept: file and token, by hash.
    pub pieces: HashMap<u64, Vec<(usize, usize)>>,
}

impl Document {
    /// Takes the fingerprints of the files of a submission, without the pieces of the `handout`.
    pub fn new(submission: String, students: Vec<String>, texts: Vec<(&'static str, String)>, handout: &Given) -> Self {
        let files: Vec<File> = texts.into_iter().map(|(name, text)| File::new(name, text, handout)).collect();
        let mut pieces: HashMap<u64, Vec<(usize, usize)>> = HashMap::new();
        for (index, file) in files.iter().enumerate() {
            let hashes = hashes(&file.tokens);
            let given = handout.places(&hashes);
            for (hash, place) in winnowed(&hashes) {
                if !given[place] {
                    pieces.entry(hash).or_default().push((index, place));
                }
            }
        }
        Self { submission, students, files, pieces }
    }

    /// Number of the author's tokens.
    pub fn size(&self) -> usize {
        self.files.iter().flat_map(|file| &file.is_own).filter(|own| **own).count()
    }
}

impl File {
    fn new(name: &'static str, text: String, handout: &Given) -> Self {
        let tokens = tokens(&text);
        let mut is_own = vec![true; tokens.len()];
        for (place, is_given) in handout.places(&hashes(&tokens)).into_iter().enumerate() {
            if is_given {
                is_own[place..place + PIECE].fill(false);
            }
        }
        Self { name, text, tokens, is_own }
    }
}

/// All pieces of a text, kept or not.
pub fn all_pieces(text: &str) -> Vec<u64> {
    hashes(&tokens(text))
}

/// The hash of each piece, by its first token.
pub fn hashes(tokens: &[Token]) -> Vec<u64> {
    let hash = |piece: &[Token]| piece.iter().fold(0xcbf2_9ce4_8422_2325, |hash, token| mixed(hash, token.kind));
    tokens.windows(PIECE).map(hash).collect()
}

fn mixed(hash: u64, kind: Kind) -> u64 {
    let next = (hash ^ u64::from(kind)).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    next ^ (next >> 29)
}

/// Of each window the smallest hash, the last one of equal ones, with its place.
fn winnowed(hashes: &[u64]) -> Vec<(u64, usize)> {
    let mut kept: Vec<(u64, usize)> = Vec::new();
    for (start, window) in hashes.windows(WINDOW.min(hashes.len()).max(1)).enumerate() {
        let smallest = window.iter().enumerate().rev().min_by_key(|(_, hash)| **hash);
        let Some((place, hash)) = smallest.map(|(offset, hash)| (start + offset, *hash)) else { continue };
        if kept.last().is_none_or(|last| last.1 != place) {
            kept.push((hash, place));
        }
    }
    kept
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn names_numbers_comments_and_layout_leave_no_trace() {
        let one = "/// Energy.\nfn energy(x: f64) -> f64 { let y = 2.0 * x; // twice\n y.sqrt() + 1.0 }";
        let two = "fn e(q: f32) -> f32 {\n    let abc = 3.5 * q;\n\n    abc.abs() + 2e9\n}";
        let kinds = |text| tokens(text).iter().map(|token| token.kind).collect::<Vec<_>>();
        assert_eq!(kinds(one), kinds(two));
        assert_ne!(kinds(one), kinds(&two.replace('*', "-")));
    }

    #[test]
    fn each_long_run_of_two_texts_keeps_a_piece_in_both() {
        let shared: String = (0..PIECE + WINDOW).map(|i| ["a", "+", "1", "*"][(i * i) % 4].to_owned() + " ").collect();
        let (one, two) = (format!("[ ] ; {shared} if x"), format!("let z ; {shared} ( b )"));
        let kept = |text: &str| winnowed(&all_pieces(text)).into_iter().map(|(hash, _)| hash).collect::<HashSet<_>>();
        assert!(!kept(&one).is_disjoint(&kept(&two)));
    }
}
