//! Turns a solved function into the one that students receive.

use std::collections::BTreeSet;
use std::ops::Range;

use grader::submission::GIVEN;
use proc_macro2::{TokenStream, TokenTree};
use syn::spanned::Spanned;
use syn::{FnArg, Item, ItemFn, ItemUse, Pat, UseTree};

/// The file of the function `name` with its signature, its documentation and the imports that those need, and with a body that
/// names its page.
pub fn stub(name: &str, solved: &str) -> Result<String, String> {
    let file = syn::parse_file(solved).map_err(|error| error.to_string())?;
    let function = file.items.iter().find_map(|item| match item {
        Item::Fn(function) if function.sig.ident == name => Some(function),
        _ => None,
    });
    let function = function.ok_or_else(|| format!("holds no function `{name}`"))?;
    let signature = signature(function, solved);
    let tokens = signature.parse::<TokenStream>().map_err(|error| error.to_string())?;
    let imports = imports(&file.items, &words(tokens), solved);
    let page = format!("include-docs/{name}.md");
    let expectation = "#[expect(unused_variables, reason = \"not written yet: remove this line when you are done\")]\n";
    let body = format!("{{\n    todo!(\"write this function; read {page}\")\n}}\n");
    Ok(format!("{imports}{expectation_at}{body}", expectation_at = with_line(function, signature, expectation)))
}

/// A solved function as it is handed out.
pub fn marked(solved: &str) -> String {
    format!("{GIVEN}{solved}")
}

/// A text without the mark of a function that is given solved.
pub fn unmarked(text: &str) -> &str {
    text.strip_prefix(GIVEN).unwrap_or(text)
}

/// Documentation, attributes and signature as they are written, but without underscores that tell which argument is not needed.
fn signature(function: &ItemFn, text: &str) -> String {
    let start = function.span().byte_range().start;
    let end = function.block.span().byte_range().start;
    let mut written = text[start..end].to_owned();
    let marks = function.sig.inputs.iter().filter_map(|argument| match argument {
        FnArg::Typed(typed) => match &*typed.pat {
            Pat::Ident(pattern) if pattern.ident.to_string().starts_with('_') => {
                Some(pattern.ident.span().byte_range())
            }
            _ => None,
        },
        FnArg::Receiver(_) => None,
    });
    let marks: Vec<Range<usize>> = marks.collect();
    for mark in marks.into_iter().rev() {
        written.remove(mark.start - start);
    }
    written
}

/// Puts a line of attributes below the documentation.
fn with_line(function: &ItemFn, mut signature: String, line: &str) -> String {
    let start = function.span().byte_range().start;
    let at = function.vis.span().byte_range().start - start;
    signature.insert_str(at, line);
    signature
}

fn words(tokens: TokenStream) -> BTreeSet<String> {
    let words = tokens.into_iter().flat_map(|token| match token {
        TokenTree::Ident(ident) => BTreeSet::from([ident.to_string()]),
        TokenTree::Group(group) => words(group.stream()),
        _ => BTreeSet::new(),
    });
    words.collect()
}

/// The imports that bring one of the names, in their groups, with an empty line at the end.
fn imports(items: &[Item], names: &BTreeSet<String>, text: &str) -> String {
    let mut kept = String::new();
    let (mut last_end, mut is_new_group) = (0, false);
    for import in items.iter().filter_map(|item| if let Item::Use(import) = item { Some(import) } else { None }) {
        let range = ItemUse::span(import).byte_range();
        is_new_group |= text[last_end..range.start].contains("\n\n");
        last_end = range.end;
        if let Some(tree) = pruned(&import.tree, names) {
            if is_new_group && !kept.is_empty() {
                kept.push('\n');
            }
            is_new_group = false;
            kept.push_str(&format!("use {tree};\n"));
        }
    }
    if kept.is_empty() { kept } else { kept + "\n" }
}

/// An import reduced to the given names; `None` if it brings none of them.
fn pruned(tree: &UseTree, names: &BTreeSet<String>) -> Option<String> {
    match tree {
        UseTree::Path(path) => pruned(&path.tree, names).map(|rest| format!("{}::{rest}", path.ident)),
        UseTree::Name(name) => names.contains(&name.ident.to_string()).then(|| name.ident.to_string()),
        UseTree::Rename(name) => {
            names.contains(&name.rename.to_string()).then(|| format!("{} as {}", name.ident, name.rename))
        }
        UseTree::Glob(_) => None,
        UseTree::Group(group) => {
            let kept: Vec<_> = group.items.iter().filter_map(|item| pruned(item, names)).collect();
            match &kept[..] {
                [] => None,
                [one] => Some(one.clone()),
                several => Some(format!("{{{}}}", several.join(", "))),
            }
        }
    }
}
