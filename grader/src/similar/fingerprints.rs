//! Fingerprints of texts by winnowing: of each few neighbouring pieces the one with the smallest hash.
//! (S. Schleimer, D. S. Wilkerson, A. Aiken, Winnowing: local algorithms for document fingerprinting, SIGMOD 2003.)

use std::collections::{HashMap, HashSet};

use super::tokens::{Kind, Token, tokens};

/// Tokens of one piece: a shorter run that two texts share is coincidence.
pub const PIECE: usize = 24;

/// Neighbouring pieces of which one is kept: each shared run of `PIECE + WINDOW − 1` tokens is found.
const WINDOW: usize = 8;

/// One file of a submission.
pub struct File {
    pub name: &'static str,
    pub text: String,
    pub tokens: Vec<Token>,
    /// True for each token of the author: a token in no piece that the handout has too.
    pub is_own: Vec<bool>,
}

/// A submission as it is compared.
pub struct Document {
    pub submission: String,
    pub students: Vec<String>,
    pub files: Vec<File>,
    /// Places of the pieces that are kept: file and token, by hash.
    pub pieces: HashMap<u64, Vec<(usize, usize)>>,
}

impl Document {
    /// Takes the fingerprints of the files of a submission, without the pieces of the `handout`.
    pub fn new(
        submission: String,
        students: Vec<String>,
        texts: Vec<(&'static str, String)>,
        handout: &HashSet<u64>,
    ) -> Self {
        let files: Vec<File> = texts.into_iter().map(|(name, text)| File::new(name, text, handout)).collect();
        let mut pieces: HashMap<u64, Vec<(usize, usize)>> = HashMap::new();
        for (index, file) in files.iter().enumerate() {
            for (hash, place) in winnowed(&hashes(&file.tokens)) {
                if !handout.contains(&hash) {
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
    fn new(name: &'static str, text: String, handout: &HashSet<u64>) -> Self {
        let tokens = tokens(&text);
        let mut is_own = vec![true; tokens.len()];
        for (place, hash) in hashes(&tokens).into_iter().enumerate() {
            if handout.contains(&hash) {
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
fn hashes(tokens: &[Token]) -> Vec<u64> {
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
