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

/// Folders with files of the same names that are not the author's answers, and folders of build products.
const PASSED_OVER: [&str; 4] = ["tests", "grader", "target", "__MACOSX"];

/// Folders above one of the 22 files, `src` included, that are looked into.
pub const DEPTH: usize = 6;

/// Returns true if a folder of that name is never looked into.
pub fn is_passed_over(folder: &str) -> bool {
    folder.starts_with('.') || PASSED_OVER.contains(&folder)
}

/// Returns true if a path is that of one of the 22 files, wherever its folder lies. A reader of archives must keep these.
pub fn may_be_taken(path: &str) -> bool {
    place(path).is_some()
}

/// The folder of a file with one of the 22 names, which ends with `/`, or is empty at the top.
fn place(path: &str) -> Option<&str> {
    let end = path.rfind('/').map_or(0, |slash| slash + 1);
    let (folder, file) = path.split_at(end);
    let stem = file.strip_suffix(".rs")?;
    let is_looked_into = folder.matches('/').count() <= DEPTH && !folder.split('/').any(is_passed_over);
    (is_looked_into && NAMES.contains(&stem)).then_some(folder)
}

/// Returns true if a folder, as `place` gives it, is called `src`.
fn is_src(folder: &str) -> bool {
    folder == "src/" || folder.ends_with("/src/")
}

impl Submission {
    /// Takes the 22 files out of all entries.
    pub fn from_entries(name: String, entries: Vec<Entry>) -> Result<Self, Unreadable> {
        let source = source_folder(&entries)?;
        let top = source.strip_suffix("src/");
        let inside: Vec<Entry> = entries.into_iter().filter_map(|entry| moved(entry, &source, top)).collect();
        let macros = macros(inside.iter().filter_map(|(path, content)| match content {
            Content::File(bytes) if taken_name(path).is_some() => Some(bytes.as_slice()),
            _ => None,
        }));
        let (mut found, mut remarks) = (BTreeMap::new(), BTreeSet::new());
        if top.is_none() {
            let from = if source.is_empty() { "its top".to_owned() } else { shown(source.trim_end_matches('/')) };
            remarks.insert(format!("there is no folder `src` in it; the files were taken from {from}"));
        }
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

/// The folder of the 22 files: the uppermost `src` that has one of them, or, without such a folder, the uppermost other folder.
fn source_folder(entries: &[Entry]) -> Result<String, Unreadable> {
    let paths = || entries.iter().map(|(path, _)| path.as_str());
    let uppermost = |wanted: bool| {
        let folders: BTreeSet<&str> = paths().filter_map(place).filter(|folder| is_src(folder) == wanted).collect();
        let depth = |folder: &str| folder.matches('/').count();
        let least = folders.iter().map(|folder| depth(folder)).min();
        folders.into_iter().filter(|folder| Some(depth(folder)) == least).map(str::to_owned).collect::<BTreeSet<_>>()
    };
    let folders = Some(uppermost(true)).filter(|folders| !folders.is_empty()).unwrap_or_else(|| uppermost(false));
    match folders.len() {
        0 => without_functions(paths().map(|path| path.split('/').collect())),
        1 => Ok(folders.into_iter().next().unwrap_or_default()),
        _ if folders.iter().all(|folder| is_src(folder)) => {
            Err(several(&folders.iter().map(|folder| folder.trim_end_matches("/src/").to_owned()).collect()))
        }
        _ => Err(Unreadable(format!(
            "there is no folder `src` in it, and several folders have files of functions ({}); hand in one, called `src`",
            list(&folders)
        ))),
    }
}

/// The folder `src` of a submission without any of the 22 files, at the top or in a folder that wraps it.
fn without_functions<'a>(paths: impl Iterator<Item = Vec<&'a str>>) -> Result<String, Unreadable> {
    let (mut wraps, mut archive) = (BTreeSet::new(), None);
    for parts in paths {
        match parts[..] {
            ["src", _, ..] => return Ok("src/".to_owned()),
            [top, "src", _, ..] if !is_passed_over(top) => wraps.extend([top.to_owned()]),
            _ => {}
        }
        let file = parts.last().copied().unwrap_or_default();
        if ARCHIVES.iter().any(|ending| file.to_ascii_lowercase().ends_with(ending)) {
            archive = archive.or(Some(shown(file)));
        }
    }
    match (wraps.len(), archive) {
        (0, Some(archive)) => Err(Unreadable(format!(
            "there is no folder `src` in it, only the archive {archive}; hand in the files as src/NAME.rs"
        ))),
        (0, None) => Err(Unreadable("there is no folder `src` in it; hand in the files as src/NAME.rs".to_owned())),
        (1, _) => Ok(wraps.into_iter().map(|top| format!("{top}/src/")).collect()),
        _ => Err(several(&wraps)),
    }
}

fn several(tops: &BTreeSet<String>) -> Unreadable {
    Unreadable(format!("it holds several folders with `src` in them ({}); hand in one", list(tops)))
}

/// Endings of archives, those that cannot be read included.
const ARCHIVES: [&str; 7] = [".zip", ".tar", ".tar.gz", ".tgz", ".rar", ".7z", ".tar.xz"];

/// An entry with its path as if the 22 files lay in `src` at the top; `None` outside of a folder that wraps all.
fn moved((path, content): Entry, source: &str, top: Option<&str>) -> Option<Entry> {
    let file = path.strip_prefix(source).filter(|file| top.is_some() || !file.contains('/'));
    let path = match (file, top) {
        (Some(file), _) => format!("src/{file}"),
        (None, Some(top)) => path.strip_prefix(top)?.to_owned(),
        (None, None) => path,
    };
    Some((path, content))
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
        let is_given = path.split('/').any(is_passed_over);
        let cause = if in_src { "with the same capitals its name must be" } else { "the file must be" };
        return (!is_given).then(|| format!("{} is ignored: {cause} src/{name}.rs", shown(path)));
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
