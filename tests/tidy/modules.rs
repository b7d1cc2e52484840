//! Folders are layers: no two of them need each other.
//!
//! A module is a folder, a file, or a `mod` with a body in one. A module needs another one beside it when something in it names that one or
//! something in it, by a path or by an import; a re-export leads to the module that it comes from. A module may name the modules that it
//! lies in, and these may name it. Beyond that, no chain of names from module to module may return to its start. Modules that stand
//! under `#[cfg(test)]` may name anything.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use proc_macro2::{Delimiter, TokenStream, TokenTree};

use super::{assert_none, files, read, root};

#[test]
fn no_two_modules_need_each_other() {
    let is_root = |path: &PathBuf| {
        path.parent().is_some_and(|folder| folder.ends_with("src"))
            && (path.ends_with("lib.rs") || path.ends_with("main.rs"))
    };
    let roots = files("rs").into_iter().filter(is_root);
    assert_none(roots.flat_map(|path| Crate::read(&path).cycles()).collect());
}

#[test]
fn a_cycle_is_found_through_imports_paths_and_re_exports() {
    let found = |text: &str| {
        let mut tree = Crate::default();
        tree.add(Vec::new(), Path::new("src/lib.rs"), text.parse().unwrap());
        tree.cycles()
    };
    let nested = "pub use a::T; mod a { use crate::b::f; pub struct T; } mod b { fn f(_: super::T) {} }";
    assert_eq!(found(nested), ["src/lib.rs: a -> b -> a; move what both need into a module of its own"]);
    assert!(found("mod a { use super::X; mod b { use super::super::X; } } struct X; fn f() { a::g() }").is_empty());
    assert!(
        found("mod a { pub fn f() {} #[cfg(test)] mod tests { use crate::b; } } mod b { use crate::a; }").is_empty()
    );
    let folders = "mod a { mod c { use crate::b::d; } mod e {} } mod b { mod d {} mod f { use crate::a::e; } }";
    assert_eq!(found(folders), ["src/lib.rs: a -> b -> a; move what both need into a module of its own"]);
    let inner = "mod a { pub struct T; mod c { use crate::{b, d}; } fn f() { c::g() } } mod b { fn f() { crate::a::T } } mod d {}";
    assert_eq!(found(inner).len(), 1);
}

/// Path of a module from the root of its crate.
type Name = Vec<String>;

/// The modules of a crate, with the paths that they name.
#[derive(Default)]
struct Crate {
    root: PathBuf,
    modules: BTreeMap<Name, Module>,
}

#[derive(Default)]
struct Module {
    /// Paths as they are written, those of imports included.
    paths: Vec<Name>,
    /// Names that imports bring, and their paths.
    imports: BTreeMap<String, Name>,
}

impl Crate {
    fn read(path: &Path) -> Self {
        let mut tree = Self { root: path.to_owned(), ..Self::default() };
        tree.add(Vec::new(), path, tokens(path));
        tree
    }

    /// Adds a module that stands in this file, and the modules in it.
    fn add(&mut self, name: Name, path: &Path, tokens: TokenStream) {
        if self.root == Path::new("") {
            path.clone_into(&mut self.root);
        }
        let mut module = Module::default();
        self.scan(&name, path, tokens, &mut module);
        self.modules.insert(name, module);
    }

    fn scan(&mut self, name: &Name, path: &Path, tokens: TokenStream, module: &mut Module) {
        let tokens: Vec<_> = tokens.into_iter().collect();
        let (mut at, mut is_test) = (0, false);
        while at < tokens.len() {
            let rest = &tokens[at..];
            match rest {
                [TokenTree::Punct(sign), TokenTree::Group(attribute), ..] if sign.as_char() == '#' => {
                    is_test |= attribute.stream().to_string().replace(' ', "").contains("cfg(test)")
                        || attribute.stream().to_string().contains("(test ,");
                    at += 2;
                    continue;
                }
                [TokenTree::Ident(word), TokenTree::Ident(child), body, ..] if word == "mod" => {
                    let child_name = [&name[..], &[child.to_string()]].concat();
                    match body {
                        _ if is_test => {}
                        TokenTree::Group(body) => self.add(child_name, path, body.stream()),
                        _ => {
                            let file = file_of(&self.root, &child_name);
                            self.add(child_name, &file, self::tokens(&file));
                        }
                    }
                    at += 3;
                }
                [TokenTree::Ident(word), ..] if word == "use" => {
                    let end = rest.iter().position(|token| is_sign(token, ';')).unwrap_or(rest.len());
                    let imports = if is_test { Vec::new() } else { imports(&rest[1..end], &[]) };
                    for (import, path) in imports {
                        module.paths.push(path.clone());
                        module.imports.insert(import, path);
                    }
                    at += end;
                }
                [TokenTree::Ident(_), ..] => {
                    let (path, length) = path_of(rest);
                    if path.len() > 1 {
                        module.paths.push(path);
                    }
                    at += length;
                }
                [TokenTree::Group(group), ..] => {
                    if !(is_test && group.delimiter() == Delimiter::Brace) {
                        self.scan(name, path, group.stream(), module);
                    }
                    at += 1;
                }
                _ => at += 1,
            }
            // An attribute belongs to what follows up to the end of an item.
            let ended = tokens[at - 1..at].iter().any(|token| match token {
                TokenTree::Group(group) => group.delimiter() == Delimiter::Brace,
                token => is_sign(token, ';'),
            });
            is_test &= !ended;
        }
    }

    /// The module that a path written in `from` leads to.
    fn target(&self, from: &Name, path: &[String], depth: usize) -> Option<Name> {
        let (first, rest) = path.split_first()?;
        let mut at = match first.as_str() {
            "crate" => Vec::new(),
            "self" => from.clone(),
            "super" => from.split_last()?.1.to_vec(),
            _ if self.child(from, first).is_some() => self.child(from, first)?,
            _ => match self.modules[from].imports.get(first) {
                Some(import) if depth < 20 && import.first() != Some(first) => self.target(from, import, depth + 1)?,
                _ => return None,
            },
        };
        for word in rest {
            if word == "super" {
                at.pop();
            } else if let Some(child) = self.child(&at, word) {
                at = child;
            } else if let Some(import) = self.modules.get(&at)?.imports.get(word).filter(|_| depth < 20) {
                return self.target(&at, import, depth + 1).or(Some(at));
            } else {
                break;
            }
        }
        Some(at)
    }

    fn child(&self, of: &Name, word: &str) -> Option<Name> {
        let name = [&of[..], &[word.to_owned()]].concat();
        self.modules.contains_key(&name).then_some(name)
    }

    /// Modules side by side that need each other, with all that lies in them: the shortest way around of each group.
    fn cycles(&self) -> Vec<String> {
        let mut needs: BTreeMap<Name, Vec<Name>> = BTreeMap::new();
        for (name, module) in &self.modules {
            needs.entry(name.clone()).or_default();
            for target in module.paths.iter().filter_map(|path| self.target(name, path, 0)) {
                let shared = name.iter().zip(&target).take_while(|(a, b)| a == b).count();
                // Parent and child may name each other.
                if shared < name.len().min(target.len()) {
                    let target = target[..=shared].to_vec();
                    let targets = needs.entry(name[..=shared].to_vec()).or_default();
                    if !targets.contains(&target) {
                        targets.push(target);
                    }
                }
            }
        }
        let mut cycles: Vec<Vec<Name>> = Vec::new();
        for name in needs.keys() {
            if !cycles.iter().flatten().any(|found| found == name)
                && let Some(cycle) = way_back(name, &needs)
            {
                cycles.push(cycle);
            }
        }
        let shown = |cycle: Vec<Name>| {
            let names: Vec<_> = cycle.iter().map(|name| name.join("::")).collect();
            format!("{}: {}; move what both need into a module of its own", self.root.display(), names.join(" -> "))
        };
        cycles.into_iter().map(shown).collect()
    }
}

/// The shortest way from a module to itself.
fn way_back(start: &Name, needs: &BTreeMap<Name, Vec<Name>>) -> Option<Vec<Name>> {
    let mut ways = vec![vec![start.clone()]];
    let mut seen: Vec<Name> = Vec::new();
    while !ways.is_empty() {
        let mut longer = Vec::new();
        for way in ways {
            for next in needs.get(way.last()?).into_iter().flatten() {
                let way = [&way[..], std::slice::from_ref(next)].concat();
                if next == start {
                    return Some(way);
                }
                if !seen.contains(next) {
                    seen.push(next.clone());
                    longer.push(way);
                }
            }
        }
        ways = longer;
    }
    None
}

fn tokens(path: &Path) -> TokenStream {
    read(path).parse().unwrap_or_else(|error| panic!("{}: {error}", path.display()))
}

/// The file of a module, beside the crate's root or in a folder there.
fn file_of(crate_root: &Path, name: &Name) -> PathBuf {
    let beside = crate_root.with_file_name(name.join("/")).with_extension("rs");
    if root().join(&beside).exists() { beside } else { beside.with_extension("").join("mod.rs") }
}

fn is_sign(token: &TokenTree, sign: char) -> bool {
    matches!(token, TokenTree::Punct(found) if found.as_char() == sign)
}

/// The words of a path at the start of these tokens, and the number of its tokens.
fn path_of(tokens: &[TokenTree]) -> (Name, usize) {
    let mut path = Vec::new();
    let mut at = 0;
    while let Some(TokenTree::Ident(word)) = tokens.get(at) {
        path.push(word.to_string());
        at += 1;
        match tokens.get(at..at + 2) {
            Some([a, b]) if is_sign(a, ':') && is_sign(b, ':') => at += 2,
            _ => break,
        }
    }
    (path, at)
}

/// The names that the tree of an import brings, and their paths. A glob brings `*`.
fn imports(tree: &[TokenTree], before: &[String]) -> Vec<(String, Name)> {
    let (path, at) = path_of(tree);
    let path = [before, &path].concat();
    match tree.get(at) {
        Some(TokenTree::Group(group)) => {
            let inner: Vec<_> = group.stream().into_iter().collect();
            inner.split(|token| is_sign(token, ',')).flat_map(|part| imports(part, &path)).collect()
        }
        Some(sign) if is_sign(sign, '*') => vec![("*".to_owned(), path)],
        _ => {
            let Some(mut last) = path.last().cloned() else { return Vec::new() };
            let own = path.len() > 1 && last == "self";
            let path = if own { path[..path.len() - 1].to_vec() } else { path };
            if own {
                last = path[path.len() - 1].clone();
            }
            // `a as b`: the path ends before `as`, which is a word of its own.
            let alias = tree.iter().skip(at).find_map(|token| match token {
                TokenTree::Ident(word) if word != "as" => Some(word.to_string()),
                _ => None,
            });
            vec![(alias.unwrap_or(last), path)]
        }
    }
}
