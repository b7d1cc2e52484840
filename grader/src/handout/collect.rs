//! The files that are handed out, and their contents.

use std::borrow::Cow;
use std::fs;
use std::path::{Path, PathBuf};

use grader::check::HANDED_OUT;
use grader::submission::{LATER, NAMES};
use syn::Item;

use super::{Files, HandoutError, manifest, stub};
use crate::rubric::{Role, Rubric};

/// Files and folders that are handed out whole. The tests of the repository, its map and its history are not.
const WHOLE: [&str; 19] = [
    ".gitignore",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "rustfmt.toml",
    "Cargo.toml",
    "Cargo.lock",
    "crates/chart",
    "crates/cli",
    "crates/features",
    "crates/mesh",
    "crates/model",
    "crates/output",
    "crates/scene",
    "crates/viewer",
    "data",
    "grader/child",
    "include-docs",
    "src",
    "tests/functions",
];

/// Parts of these folders that show what the engine computes, or write and compare pages that students do not receive.
const LEFT_OUT: [&str; 4] =
    ["include-docs/methods.md", "crates/scene/examples", "crates/scene/tests/reference.rs", "data/studies"];

const README: &str = include_str!("../../handout/README.md");
const PROGRAM: &str = include_str!("../../handout/main.rs");

/// All files of the handout.
pub fn collect(root: &Path, rubric: &Rubric) -> Result<Files, HandoutError> {
    let mut files = Files::new();
    for name in WHOLE {
        add(root, Path::new(name), &mut files)?;
    }
    for name in NAMES {
        edit(&mut files, &format!("src/{name}.rs"), |text| match rubric.role(name) {
            Role::Asked => stub::stub(name, text),
            Role::Given => Ok(stub::marked(text)),
            Role::Later => Ok(stub::stub(name, text)?.replace("write this function", LATER)),
        })?;
    }
    for name in NAMES {
        // The files that `reset` restores.
        if let Some(text) = files.get(Path::new(&format!("src/{name}.rs"))).cloned() {
            files.insert(format!("{HANDED_OUT}/{name}.rs").into(), text);
        }
    }
    edit(&mut files, "src/lib.rs", lenient)?;
    leave_out_the_engine(&mut files);
    add_module(root, Path::new("grader/src/lib.rs"), &mut files)?;
    files.insert("grader/src/main.rs".into(), PROGRAM.into());
    add(root, Path::new("grader/Cargo.toml"), &mut files)?;
    let is_source = |path: &Path| path.starts_with("grader/src") && path.extension().is_some_and(|end| end == "rs");
    let sources = files.iter().filter(|(path, _)| is_source(path)).map(|(_, text)| String::from_utf8_lossy(text));
    let sources: Vec<String> = sources.map(Cow::into_owned).collect();
    edit(&mut files, "grader/Cargo.toml", |text| {
        manifest::with_used_dependencies(text, sources.iter().map(String::as_str))
    })?;
    let has: Vec<_> = files.keys().cloned().collect();
    let is_there = |path: &str| has.iter().any(|found| found == Path::new(path));
    let mut gone = Vec::new();
    edit(&mut files, "crates/cli/Cargo.toml", |text| {
        let (manifest, features) = manifest::program_manifest(text, is_there)?;
        gone = features;
        Ok(manifest)
    })?;
    edit(&mut files, "Cargo.toml", |text| manifest::root_manifest(text, is_there, &gone))?;
    files.insert("README.md".into(), readme(root, rubric)?.into_bytes());
    Ok(files)
}

/// The line of our library that holds us to documentation, and in its place what lets every function build that `check` accepts.
const STRICT: &str = "#![deny(missing_docs)]\n";
const LENIENT: &str = "#![warn(warnings)] // no warning stops the build, not even where RUSTFLAGS denies them\n";

/// The first line below the attributes, and above it in the handout: `check` compiles files that name this crate from within.
const FIRST: &str = "// In teaching order";
const OWN_NAME: &str =
    "extern crate self as finite_elements_3d; // `use finite_elements_3d::…` is the same as `use crate::…`\n\n";

/// The students' library: ours, but no lint is an error in what students write.
fn lenient(text: &str) -> Result<String, String> {
    if !text.contains(STRICT) || !text.contains(FIRST) {
        return Err(format!("lacks `{}` or `{FIRST}`, which the handout replaces", STRICT.trim_end()));
    }
    Ok(text.replacen(STRICT, LENIENT, 1).replacen(FIRST, &format!("{OWN_NAME}{FIRST}"), 1))
}

/// The engine computes what students are to write, and its scenes run on nothing else. The program does without the feature `engine`.
fn leave_out_the_engine(files: &mut Files) {
    let needs_it = |path: &Path, text: &[u8]| {
        path.starts_with("data/scenes") && String::from_utf8_lossy(text).contains("pipeline = \"engine\"")
    };
    files.retain(|path, text| !LEFT_OUT.iter().any(|own| path.starts_with(own)) && !needs_it(path, text));
}

/// Adds a file or a folder, without hidden files and build products.
pub fn add(root: &Path, path: &Path, files: &mut Files) -> Result<(), HandoutError> {
    let full = root.join(path);
    if !full.is_dir() {
        files.insert(path.to_owned(), fs::read(&full).map_err(HandoutError::io(&full))?);
        return Ok(());
    }
    for entry in fs::read_dir(&full).map_err(HandoutError::io(&full))? {
        let name = entry.map_err(HandoutError::io(&full))?.file_name();
        let is_left_out = name.to_string_lossy().starts_with('.') || name == "target";
        if !is_left_out && !full.join(&name).join("CACHEDIR.TAG").exists() {
            add(root, &path.join(&name), files)?;
        }
    }
    Ok(())
}

fn edit(
    files: &mut Files,
    path: &str,
    change: impl FnOnce(&str) -> Result<String, String>,
) -> Result<(), HandoutError> {
    let unusable = |problem: String| HandoutError::unusable(path, problem);
    let bytes = files.get_mut(Path::new(path)).ok_or_else(|| unusable("is not there".to_owned()))?;
    let text = std::str::from_utf8(bytes).map_err(|error| unusable(error.to_string()))?;
    *bytes = change(text).map_err(unusable)?.into_bytes();
    Ok(())
}

/// Adds a file of the grader's library, the modules that it declares, and the texts that it includes.
fn add_module(root: &Path, path: &Path, files: &mut Files) -> Result<(), HandoutError> {
    add(root, path, files)?;
    let text = String::from_utf8_lossy(&files[path]).into_owned();
    let file = syn::parse_file(&text).map_err(|error| HandoutError::unusable(path, error))?;
    let folder = path.parent().unwrap_or(Path::new(""));
    let inside = match path.file_stem().map(|stem| stem.to_string_lossy().into_owned()) {
        Some(stem) if stem != "lib" && stem != "mod" => folder.join(stem),
        _ => folder.to_owned(),
    };
    for item in &file.items {
        if let Item::Mod(module) = item
            && module.content.is_none()
        {
            let (beside, within) =
                (inside.join(format!("{}.rs", module.ident)), inside.join(format!("{}/mod.rs", module.ident)));
            let next = if root.join(&beside).exists() { beside } else { within };
            add_module(root, &next, files)?;
        }
    }
    for included in text.split("include_str!(\"").skip(1).filter_map(|rest| rest.split('"').next()) {
        let included = normal(&folder.join(included));
        if root.join(&included).is_file() {
            add(root, &included, files)?;
        }
    }
    Ok(())
}

/// A path without `..`.
fn normal(path: &Path) -> PathBuf {
    path.components().fold(PathBuf::new(), |mut normal, part| {
        if part.as_os_str() == ".." {
            normal.pop();
        } else {
            normal.push(part)
        }
        normal
    })
}

/// The students' first page, with the table of functions and that of scenes as they stand on ours.
fn readme(root: &Path, rubric: &Rubric) -> Result<String, HandoutError> {
    let path = root.join("README.md");
    let ours = fs::read_to_string(&path).map_err(HandoutError::io(&path))?;
    let table = |head: &str| -> String {
        let lines = ours.lines().skip_while(|line| !line.starts_with(head)).take_while(|line| line.starts_with('|'));
        let handed_out = |line: &&str| !line.contains("engine");
        lines.filter(handed_out).flat_map(|line| [line, "\n"]).collect()
    };
    let functions: String = table("| | function |").lines().map(|line| with_role(line, rubric) + "\n").collect();
    Ok(README.replace("{functions}\n", &functions).replace("{scenes}\n", &table("| scene |")))
}

/// A line of the table of functions; one that is not asked for says so.
fn with_role(line: &str, rubric: &Rubric) -> String {
    let name = NAMES.into_iter().find(|name| line.contains(&format!("[`{name}`]")));
    let note = match name.map(|name| rubric.role(name)) {
        Some(Role::Given) => " (given solved)",
        Some(Role::Later) => " (a later assignment)",
        Some(Role::Asked) | None => return line.to_owned(),
    };
    format!("{}{note} |", line.trim_end().trim_end_matches('|').trim_end())
}
