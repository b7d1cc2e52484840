//! Recognises a function whose body is still that of the stub.

use proc_macro2::{Delimiter, TokenTree};

use super::scan;

/// Returns true if the function `name` of this text still has the body of a stub.
///
/// It looks at tokens only, because a hostile text could overflow the stack of a parser.
pub fn is_stub(name: &str, text: &str) -> bool {
    scan::with_tokens(text, |tokens| {
        let tokens: Vec<_> = tokens.into_iter().collect();
        let start = tokens.windows(2).position(|pair| is_word(&pair[0], "fn") && is_word(&pair[1], name))?;
        let body = tokens[start..].iter().find_map(|token| match token {
            TokenTree::Group(group) if group.delimiter() == Delimiter::Brace => Some(group.stream()),
            _ => None,
        })?;
        Some(is_unwritten(&body.into_iter().collect::<Vec<_>>()))
    })
    .flatten()
    .unwrap_or(false)
}

fn is_word(token: &TokenTree, word: &str) -> bool {
    matches!(token, TokenTree::Ident(ident) if ident == word)
}

fn is_mark(token: &TokenTree, mark: char) -> bool {
    matches!(token, TokenTree::Punct(punct) if punct.as_char() == mark)
}

/// A last `todo!` or `unimplemented!`, and before it at most `let _ = …;`, which silences warnings.
fn is_unwritten(body: &[TokenTree]) -> bool {
    let mut statements = body.split(|token| is_mark(token, ';')).filter(|statement| !statement.is_empty());
    let Some(last) = statements.next_back() else { return false };
    let silences = |statement: &[TokenTree]| match statement {
        [first, second, ..] => is_word(first, "let") && is_word(second, "_"),
        _ => false,
    };
    statements.all(silences) && says_so(last)
}

fn says_so(statement: &[TokenTree]) -> bool {
    let [path @ .., word, mark, TokenTree::Group(_)] = statement else { return false };
    let is_path = path.iter().all(|token| is_mark(token, ':') || is_word(token, "std") || is_word(token, "core"));
    is_path && (is_word(word, "todo") || is_word(word, "unimplemented")) && is_mark(mark, '!')
}
