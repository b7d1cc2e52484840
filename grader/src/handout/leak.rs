//! Searches the files of the handout for solutions.

use std::collections::{BTreeMap, BTreeSet, HashMap};
use std::fmt;
use std::fs;
use std::ops::Range;
use std::path::{Path, PathBuf};

use grader::submission::NAMES;
use proc_macro2::{TokenStream, TokenTree};
use syn::spanned::Spanned;
use syn::visit::Visit;

use super::{Files, HandoutError};
use crate::rubric::{Role, Rubric};

/// Number of consecutive tokens of a body that count as a piece of the solution. Every sign counts by itself – `::` is two, `2.0`
/// three – so this is about a line. It is the smallest number without a false alarm. With 23, three lines of the checks that say in
/// Rust what a page says in a formula would be solutions, such as `… - 3.0) + D * (J - 1.0).powi(2);`; with 16, twelve files, for
/// `let mut f = DVector::zeros(q.len());` and other idioms; with 12, thirty-five.
const WINDOW: usize = 24;

/// A piece of a solution that stands in a file of the handout.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Leak {
    /// The function whose solution it is.
    pub function: &'static str,
    /// The file, from the root of the handout.
    pub path: PathBuf,
    /// The piece.
    pub piece: String,
}

impl fmt::Display for Leak {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}: holds `{}` of {}", self.path.display(), self.piece, self.function)
    }
}

/// Pieces of the bodies in the repository `root` that these files contain; the first of each function in each file. A piece that is
/// also in a given function is no solution.
pub fn leaks(root: &Path, rubric: &Rubric, files: &Files) -> Result<Vec<Leak>, HandoutError> {
    let is_given = |name: &str| rubric.role(name) == Role::Given;
    // Words by number: most words of a handout are in no solution, and a window with one of them is none.
    let mut numbers = HashMap::new();
    let mut pieces: HashMap<Vec<usize>, &'static str> = HashMap::new();
    for name in NAMES.into_iter().filter(|name| !is_given(name)) {
        pieces.extend(windows(root, name, &mut numbers)?.into_iter().map(|window| (window, name)));
    }
    for name in NAMES.into_iter().filter(|name| is_given(name)) {
        for window in windows(root, name, &mut numbers)? {
            pieces.remove(&window);
        }
    }
    let lengths: BTreeSet<usize> = pieces.keys().map(Vec::len).collect();
    let mut found = BTreeMap::new();
    for (path, bytes) in files {
        let Ok(text) = std::str::from_utf8(bytes) else { continue };
        if path.starts_with("data") {
            continue; // figures
        }
        let words = words(text);
        let numbers: Vec<Option<usize>> = words.iter().map(|word| numbers.get(*word).copied()).collect();
        for &length in &lengths {
            let mut begin = 0;
            for run in numbers.split(Option::is_none) {
                let run_of_words = &words[begin..begin + run.len()];
                begin += run.len() + 1;
                if run.len() < length {
                    continue;
                }
                let run: Vec<usize> = run.iter().copied().flatten().collect();
                for (window, piece) in run.windows(length).zip(run_of_words.windows(length)) {
                    if let Some(&function) = pieces.get(window) {
                        let leak = || Leak { function, path: path.clone(), piece: piece.join(" ") };
                        found.entry((path, function)).or_insert_with(leak);
                    }
                }
            }
        }
    }
    Ok(found.into_values().collect())
}

/// All pieces of a function's solution, as numbers of their words. A body that is shorter than a window counts as a whole.
fn windows(root: &Path, name: &str, numbers: &mut HashMap<String, usize>) -> Result<Vec<Vec<usize>>, HandoutError> {
    let path = root.join(format!("src/{name}.rs"));
    let text = fs::read_to_string(&path).map_err(HandoutError::io(&path))?;
    let mut found = Vec::new();
    for body in bodies(&text).map_err(|error| HandoutError::unusable(&path, error))? {
        let mut number = |word: &str| {
            let next = numbers.len();
            *numbers.entry(word.to_owned()).or_insert(next)
        };
        let words: Vec<usize> = words(&body).into_iter().map(&mut number).collect();
        found.extend(words.windows(WINDOW.min(words.len())).map(<[usize]>::to_vec));
    }
    Ok(found)
}

/// The bodies of all functions in a file, without comments.
fn bodies(text: &str) -> syn::Result<Vec<String>> {
    struct Bodies(Vec<Range<usize>>);
    impl<'ast> Visit<'ast> for Bodies {
        fn visit_item_fn(&mut self, function: &'ast syn::ItemFn) {
            self.0.push(function.block.span().byte_range());
        }
    }
    let mut bodies = Bodies(Vec::new());
    bodies.visit_file(&syn::parse_file(text)?);
    let without_comments = |range: Range<usize>| Ok(source_of(text[range.clone()].parse()?, &text[range]));
    bodies.0.into_iter().map(without_comments).collect()
}

/// The tokens as written, separated by spaces.
fn source_of(tokens: TokenStream, text: &str) -> String {
    let written = tokens.into_iter().map(|token| match token {
        TokenTree::Group(group) => {
            let (open, close) = (group.span_open().byte_range(), group.span_close().byte_range());
            format!("{} {} {}", &text[open], source_of(group.stream(), text), &text[close])
        }
        other => text[other.span().byte_range()].to_owned(),
    });
    written.collect::<Vec<_>>().join(" ")
}

/// Words and signs, one by one. Works for any text, so that solutions are found in pages and tests as well.
fn words(text: &str) -> Vec<&str> {
    let is_in_word = |c: char| c.is_alphanumeric() || c == '_';
    let mut words = Vec::new();
    let mut rest = text.trim_start();
    while let Some(first) = rest.chars().next() {
        let word =
            if is_in_word(first) { rest.find(|c| !is_in_word(c)).unwrap_or(rest.len()) } else { first.len_utf8() };
        words.push(&rest[..word]);
        rest = rest[word..].trim_start();
    }
    words
}
