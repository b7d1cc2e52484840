//! Refuses files with code that leaves Rust's safety, runs before the program or reads files while compiling. Comments and string
//! literals do not count.
//!
//! This is the first line of defence; the sandbox confines code that passes it.

mod macros;
mod words;

use std::thread;

use proc_macro2::{Delimiter, TokenStream, TokenTree};

pub use macros::Macros;
use words::{ALWAYS, AS_MACROS, IN_ATTRIBUTES, as_text};

/// A refused word.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Found {
    /// Line in the file, counted from one.
    pub line: usize,
    /// The problem and the remedy.
    pub reason: String,
}

/// Deeper nesting of brackets is refused, so that a recursive walk fits on the stack.
const MAX_NESTING: usize = 256;

/// Stack of the thread that walks a file's tokens, bytes.
const STACK: usize = 64 << 20;

/// The first thing in a file that is refused, next to the `macros` of all files of its submission. A file that is not Rust is
/// left for the compiler to complain about, as long as no refused word is in it.
pub fn scan(text: &str, macros: &Macros) -> Option<Found> {
    if text.starts_with("#!") && !text[2..].trim_start().starts_with('[') {
        // The compiler skips such a line as a shell's; a tokeniser might see a comment begin there.
        return Some(found(1, "the first line is for a shell; remove it"));
    }
    if let Some(line) = too_deep(text) {
        return Some(found(line, "brackets are nested more than 256 deep; split the expression"));
    }
    with_tokens(text, |tokens| {
        let mut walk = Walk { macros, first: None };
        walk.stream(tokens, Place::default());
        walk.first
    })
    .unwrap_or_else(|| as_text(text))
}

/// Tokenises a text on a thread with a large stack and works on the tokens there; `None` if it is not Rust.
pub fn with_tokens<R: Send>(text: &str, work: impl FnOnce(TokenStream) -> R + Send) -> Option<R> {
    if too_deep(text).is_some() {
        return None;
    }
    thread::scope(|scope| {
        let run = move || text.parse::<TokenStream>().ok().map(work);
        let thread = thread::Builder::new().stack_size(STACK).spawn_scoped(scope, run).ok()?;
        thread.join().ok().flatten()
    })
}

fn found(line: usize, reason: &str) -> Found {
    Found { line, reason: reason.to_owned() }
}

/// The line where brackets are too deep, counting those in comments and strings as well.
fn too_deep(text: &str) -> Option<usize> {
    let (mut depth, mut line) = (0_usize, 1);
    for byte in text.bytes() {
        match byte {
            b'(' | b'[' | b'{' => depth += 1,
            b')' | b']' | b'}' => depth = depth.saturating_sub(1),
            b'\n' => line += 1,
            _ => {}
        }
        if depth > MAX_NESTING {
            return Some(line);
        }
    }
    None
}

struct Walk<'a> {
    macros: &'a Macros,
    first: Option<Found>,
}

impl Walk<'_> {
    fn stream(&mut self, tokens: TokenStream, place: Place) {
        let tokens: Vec<_> = tokens.into_iter().collect();
        let mut in_use = false;
        for (at, token) in tokens.iter().enumerate() {
            let (before, after) = (&tokens[..at], &tokens[at + 1..]);
            in_use = match token {
                TokenTree::Ident(word) => in_use || word == "use",
                _ => in_use && !ends_item(token),
            };
            let place = Place { in_use: place.in_use || in_use, ..place };
            match token {
                TokenTree::Group(group) => {
                    let is_attribute = group.delimiter() == Delimiter::Bracket && follows_hash(before);
                    let inside = Place {
                        in_attribute: place.in_attribute || is_attribute,
                        in_definition: place.in_definition || macros::defines(before),
                        in_arguments: place.in_arguments || self.macros.gets(before),
                        ..place
                    };
                    self.stream(group.stream(), inside);
                }
                TokenTree::Ident(ident) => {
                    let name = ident.to_string();
                    if let Some(reason) = self.reason(name.trim_start_matches("r#"), after, place) {
                        self.first = Some(Found { line: ident.span().start().line, reason });
                    }
                }
                _ => {}
            }
            if self.first.is_some() {
                return;
            }
        }
    }

    fn reason(&self, word: &str, after: &[TokenTree], place: Place) -> Option<String> {
        if ALWAYS.contains(&word) {
            return Some(format!("`{word}` is not allowed; do without it"));
        }
        if word == "mod" && place.in_arguments {
            return Some("`mod` is not allowed in what a macro gets; write the module without the macro".to_owned());
        }
        if word == "mod" && !has_body(after) {
            return Some("a `mod` without a body needs another file; write its body here".to_owned());
        }
        let (is_macro, is_attribute) = (AS_MACROS.contains(&word), IN_ATTRIBUTES.contains(&word));
        if is_macro && (is_called(after) || place.in_use) {
            return Some(format!("`{word}!` is not allowed; do without it"));
        }
        if is_attribute && place.in_attribute {
            return Some(format!("the attribute `{word}` is not allowed; do without it"));
        }
        // A macro can put a word together with what makes it dangerous, so there it counts as such.
        let in_macro = (is_macro || is_attribute) && (place.in_definition || place.in_arguments);
        in_macro.then(|| format!("`{word}` is not allowed in a macro of one's own; use another name"))
    }
}

/// Surroundings of a token.
#[derive(Clone, Copy, Default)]
struct Place {
    in_attribute: bool,
    in_use: bool,
    in_definition: bool,
    in_arguments: bool,
}

/// Returns true if the last token is `#` or `#!`.
fn follows_hash(before: &[TokenTree]) -> bool {
    let is = |token: Option<&TokenTree>, c| matches!(token, Some(TokenTree::Punct(punct)) if punct.as_char() == c);
    let before_last = before.len().checked_sub(2).map(|at| &before[at]);
    is(before.last(), '#') || is(before.last(), '!') && is(before_last, '#')
}

/// Returns true if a name and a pair of braces come next.
fn has_body(after: &[TokenTree]) -> bool {
    matches!(after, [TokenTree::Ident(_), TokenTree::Group(group), ..] if group.delimiter() == Delimiter::Brace)
}

/// Returns true if `!` and brackets come next.
fn is_called(after: &[TokenTree]) -> bool {
    matches!(after, [TokenTree::Punct(mark), TokenTree::Group(_), ..] if mark.as_char() == '!')
}

fn ends_item(token: &TokenTree) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == ';')
}

#[cfg(test)]
mod tests;
