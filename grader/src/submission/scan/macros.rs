//! Macros of a submission. A word that is harmless where it stands can become dangerous where a macro puts it.

use std::collections::BTreeSet;

use proc_macro2::{TokenStream, TokenTree};

/// Macros that put their arguments nowhere but into expressions, texts and patterns.
const KNOWN: [&str; 36] = [
    "assert",
    "assert_eq",
    "assert_ne",
    "cfg",
    "column",
    "compile_error",
    "concat",
    "dbg",
    "debug_assert",
    "debug_assert_eq",
    "debug_assert_ne",
    "dmatrix",
    "dvector",
    "eprint",
    "eprintln",
    "file",
    "format",
    "format_args",
    "line",
    "matches",
    "matrix",
    "module_path",
    "panic",
    "point",
    "print",
    "println",
    "stack",
    "stringify",
    "thread_local",
    "todo",
    "unimplemented",
    "unreachable",
    "vec",
    "vector",
    "write",
    "writeln",
];

/// Words that may stand before `!` and brackets without being the name of a macro.
const KEYWORDS: [&str; 8] = ["if", "while", "match", "return", "in", "else", "break", "move"];

/// The names of macros that a submission defines, in whichever of its files.
#[derive(Debug, Default)]
pub struct Macros {
    own: BTreeSet<String>,
    /// A name is made by a macro or cannot be read, so it can be any.
    is_any: bool,
}

impl Macros {
    /// The macros of some files.
    pub fn of<'a>(texts: impl IntoIterator<Item = &'a str>) -> Self {
        let mut macros = Self::default();
        for text in texts {
            let find = |tokens: TokenStream| {
                let mut found = Self::default();
                found.collect(tokens);
                found
            };
            // The compiler may accept a text that this tokeniser cannot read.
            let found = super::with_tokens(text, find).unwrap_or(Self { own: BTreeSet::new(), is_any: true });
            macros.own.extend(found.own);
            macros.is_any |= found.is_any;
        }
        macros
    }

    fn collect(&mut self, tokens: TokenStream) {
        let tokens: Vec<_> = tokens.into_iter().collect();
        for (at, token) in tokens.iter().enumerate() {
            match token {
                TokenTree::Group(group) => self.collect(group.stream()),
                TokenTree::Ident(word) if word == "macro_rules" => self.name(tokens.get(at + 2)),
                // A macro may be imported under another name.
                TokenTree::Ident(word) if word == "as" => self.name(tokens.get(at + 1)),
                _ => {}
            }
        }
    }

    fn name(&mut self, token: Option<&TokenTree>) {
        match token {
            Some(TokenTree::Ident(name)) => {
                self.own.insert(plain(&name.to_string()).to_owned());
            }
            Some(TokenTree::Punct(mark)) if mark.as_char() == '$' => self.is_any = true,
            _ => {}
        }
    }

    fn may_rearrange(&self, name: &str) -> bool {
        self.is_any || !KNOWN.contains(&name) || self.own.contains(name)
    }

    /// Returns true if a group after these tokens is the argument of a macro, which may turn it into anything.
    pub fn gets(&self, before: &[TokenTree]) -> bool {
        match before {
            [.., TokenTree::Ident(name), TokenTree::Punct(mark)] if mark.as_char() == '!' => {
                let name = name.to_string();
                !KEYWORDS.contains(&name.as_str()) && self.may_rearrange(plain(&name))
            }
            _ => false,
        }
    }
}

/// Returns true if a group after these tokens defines a macro.
pub fn defines(before: &[TokenTree]) -> bool {
    let is = |token: &TokenTree| matches!(token, TokenTree::Ident(word) if word == "macro_rules");
    // `macro_rules ! name`, or `macro_rules ! $ name` in another macro.
    before.iter().rev().skip(2).take(2).any(is)
}

fn plain(name: &str) -> &str {
    name.trim_start_matches("r#")
}
