//! The lock file of the students' repository: ours without what is no longer needed, all versions as they are. What only a
//! feature of a dropped package asked for stays; cargo drops it with the first build.

use std::collections::{BTreeMap, BTreeSet};

const PACKAGE: &str = "[[package]]\n";

/// One package of a lock file, as text.
struct Package<'a> {
    name: &'a str,
    version: &'a str,
    text: &'a str,
}

/// Removes what no package of ours needs. `members` are the packages that are handed out, each with the dependencies that its
/// manifest asks for.
pub fn pruned(lock: &str, members: &BTreeMap<String, BTreeSet<String>>) -> String {
    let mut parts = lock.split(PACKAGE);
    let head = parts.next().unwrap_or_default();
    let packages: Vec<Package> = parts.map(package).collect();
    let cut: Vec<String> = packages.iter().map(|package| without_dropped(package, members)).collect();

    let mut needed = BTreeSet::new();
    let mut open: Vec<usize> = (0..packages.len()).filter(|&at| members.contains_key(packages[at].name)).collect();
    while let Some(at) = open.pop() {
        if needed.insert(at) {
            let wanted: Vec<_> = cut[at].lines().filter_map(dependency).collect();
            open.extend((0..packages.len()).filter(|&other| wanted.iter().any(|line| is(&packages[other], line))));
        }
    }
    let several = |name: &str| needed.iter().filter(|&&at| packages[at].name == name).count() > 1;
    let kept = needed.iter().map(|&at| format!("{PACKAGE}{}", with_short_names(&cut[at], several)));
    format!("{head}{}", kept.collect::<String>().trim_end()) + "\n"
}

fn package(text: &str) -> Package<'_> {
    let field = |key: &str| {
        let line = text.lines().find_map(|line| line.strip_prefix(key)?.strip_prefix(" = "));
        line.unwrap_or_default().trim_matches('"')
    };
    Package { name: field("name"), version: field("version"), text }
}

/// `name` or `name version` of a line in a list of dependencies.
fn dependency(line: &str) -> Option<&str> {
    line.strip_prefix(" \"")?.strip_suffix("\",")
}

fn is(package: &Package, dependency: &str) -> bool {
    let mut words = dependency.split(' ');
    words.next() == Some(package.name) && words.next().is_none_or(|version| version == package.version)
}

fn without_dropped(package: &Package, members: &BTreeMap<String, BTreeSet<String>>) -> String {
    let Some(asked) = members.get(package.name) else { return package.text.to_owned() };
    let stays = |line: &&str| match dependency(line) {
        Some(dependency) => asked.contains(dependency.split(' ').next().unwrap_or_default()),
        None => true,
    };
    package.text.lines().filter(stays).flat_map(|line| [line, "\n"]).collect()
}

/// Cargo tells the version of a dependency only where there are several.
fn with_short_names(text: &str, several: impl Fn(&str) -> bool) -> String {
    let short = |line: &str| match dependency(line).and_then(|dependency| dependency.split_once(' ')) {
        Some((name, _)) if !several(name) => format!(" \"{name}\",\n"),
        _ => format!("{line}\n"),
    };
    text.lines().map(short).collect()
}
