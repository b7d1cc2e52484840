//! Selects the files of a submission from a folder or an archive.

use std::collections::{BTreeMap, BTreeSet};

use super::scan::Macros;
use super::{MAX_FILE_BYTES, NAMES, Source, Submission, macros, source};

/// One thing in a folder or an archive.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum Content {
    /// A file that may be one of the 22.
    File(Vec<u8>),
    /// A file that is too large, or one that is never looked into.
    Unread,
    /// A symbolic or hard link.
    Link,
    /// A file that cannot be read; the reason.
    Broken(String),
}

/// One entry: its path from the top with `/` between its parts, and what is there.
pub type Entry = (String, Content);

/// Reason why a submission cannot be read.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
#[error("{0}")]
pub struct Unreadable(pub String);

/// Files of a repository that decide how code is built; an author who changed them is told that they are ignored.
const IGNORED: [&str; 5] = ["build.rs", ".cargo", "rust-toolchain.toml", "rust-toolchain", "src/build.rs"];

/// Returns true if a path is that of one of the 22 files, in `src` or in `TOP/src`. A reader of archives must keep these.
pub fn may_be_taken(path: &str) -> bool {
    let parts: Vec<_> = path.split('/').collect();
    let file = match parts[..] {
        ["src", file] | [_, "src", file] => file,
        _ => return false,
    };
    NAMES.iter().any(|name| file.strip_suffix(".rs") == Some(name))
}

impl Submission {
    /// Takes the 22 files out of all entries.
    pub fn from_entries(name: String, entries: Vec<Entry>) -> Result<Self, Unreadable> {
        let top = top(&entries)?;
        let inside: Vec<Entry> = entries
            .into_iter()
            .filter_map(|(path, content)| Some((path.strip_prefix(&top)?.to_owned(), content)))
            .collect();
        let macros = macros(inside.iter().filter_map(|(path, content)| match content {
            Content::File(bytes) if taken_name(path).is_some() => Some(bytes.as_slice()),
            _ => None,
        }));
        let (mut found, mut remarks) = (BTreeMap::new(), BTreeSet::new());
        for (path, content) in inside {
            match taken_name(&path) {
                Some(name) => {
                    let source = judged(name, content, &macros);
                    let twice = |_: &mut Source| Source::Refused {
                        line: None,
                        reason: "the file is there twice; hand in one".to_owned(),
                    };
                    found.entry(name).and_modify(|old| *old = twice(old)).or_insert(source);
                }
                None => remarks.extend(remark(&path)),
            }
        }
        let missing = |name| Source::Missing(format!("there is no src/{name}.rs"));
        let functions = NAMES.map(|name| (name, found.remove(name).unwrap_or_else(|| missing(name)))).into();
        Ok(Self { name, functions, remarks: first(remarks) })
    }
}

/// Largest number of remarks on ignored files.
const MOST_REMARKS: usize = 20;

/// The first remarks, and how many more there would be.
fn first(remarks: BTreeSet<String>) -> Vec<String> {
    let more = remarks.len().saturating_sub(MOST_REMARKS);
    let told = (more > 0).then(|| format!("{more} more files are ignored"));
    remarks.into_iter().take(MOST_REMARKS).chain(told).collect()
}

/// The part before `src/` in the paths of a submission: empty, or one folder that wraps it all.
fn top(entries: &[Entry]) -> Result<String, Unreadable> {
    let paths = || entries.iter().map(|(path, _)| path.as_str());
    if paths().any(|path| path.starts_with("src/")) {
        return Ok(String::new());
    }
    let wraps = |path: &str| {
        let (top, inside) = path.split_once('/')?;
        (inside.starts_with("src/") && top != "__MACOSX" && !top.starts_with('.')).then(|| format!("{top}/"))
    };
    let tops: BTreeSet<_> = paths().filter_map(wraps).collect();
    match tops.len() {
        0 => Err(Unreadable("there is no folder `src` in it; hand in the files as src/NAME.rs".to_owned())),
        1 => Ok(tops.into_iter().next().unwrap_or_default()),
        _ => Err(Unreadable(format!("it holds several folders with `src` in them ({}); hand in one", list(&tops)))),
    }
}

fn list(tops: &BTreeSet<String>) -> String {
    let shown: Vec<_> = tops.iter().take(3).map(|top| shown(top.trim_end_matches('/'))).collect();
    format!("{}{}", shown.join(", "), if tops.len() > 3 { ", …" } else { "" })
}

fn taken_name(path: &str) -> Option<&'static str> {
    let stem = path.strip_prefix("src/")?.strip_suffix(".rs")?;
    NAMES.into_iter().find(|name| *name == stem)
}

fn judged(name: &str, content: Content, macros: &Macros) -> Source {
    let refused = |reason: String| Source::Refused { line: None, reason };
    match content {
        Content::File(bytes) => source(name, &bytes, macros),
        Content::Unread => refused(format!("the file is larger than {} MiB; shorten it", MAX_FILE_BYTES >> 20)),
        Content::Link => refused("the file is a link; hand in the file itself".to_owned()),
        Content::Broken(why) => refused(format!("the file cannot be read: {}", shown(&why))),
    }
}

/// A remark on an ignored file whose author may think that it counts.
fn remark(path: &str) -> Option<String> {
    if let Some(name) = IGNORED.iter().find(|name| path == **name || path.starts_with(&format!("{name}/"))) {
        return Some(format!("{name} is ignored: all submissions are built in the same way"));
    }
    let file = path.rsplit('/').next().unwrap_or(path);
    if let Some(name) = NAMES.iter().find(|name| file.eq_ignore_ascii_case(&format!("{name}.rs"))) {
        let in_src = path.strip_prefix("src/").is_some_and(|rest| rest == file);
        let in_tests = path.starts_with("tests/") || path.starts_with("grader/");
        let cause = if in_src { "with the same capitals its name must be" } else { "the file must be" };
        return (!in_tests).then(|| format!("{} is ignored: {cause} src/{name}.rs", shown(path)));
    }
    let given = ["src/lib.rs", "src/main.rs", "src/assignment_setup.rs"];
    let stray = path.strip_prefix("src/").is_some_and(|rest| !rest.contains('/') && rest.ends_with(".rs"));
    (stray && !given.contains(&path))
        .then(|| format!("{} is ignored: put helpers into the function's own file", shown(path)))
}

/// A path as it may stand in a report: no control characters, no book.
fn shown(path: &str) -> String {
    path.chars().map(|c| if c.is_control() { '?' } else { c }).take(120).collect()
}

#[cfg(test)]
mod tests;
