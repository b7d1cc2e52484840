//! The sources in a package: the library, its pages and the grader. The demo, the engine and the window are left out:
//! they would make the package six times as large, and grading does not need them.

use std::fs;
use std::path::Path;
use std::process::Command;

use toml::{Table, Value};

use super::{PackError, at, output};

/// Files that the grader is built from and works with.
const PARTS: [&str; 9] = [
    "Cargo.toml",
    "Cargo.lock",
    "LICENSE-APACHE",
    "LICENSE-MIT",
    "crates/chart",
    "crates/features",
    "grader",
    "include-docs",
    "src",
];

/// Copies the sources of the repository `root` into the folder `to`, with a manifest and a lock file that ask for no more.
pub fn copy(root: &Path, to: &Path) -> Result<(), PackError> {
    for name in PARTS.iter().filter(|name| root.join(name).exists()) {
        copy_one(&root.join(name), &to.join(name))?;
    }
    let path = to.join("Cargo.toml");
    let text = fs::read_to_string(&path).map_err(at(&path))?;
    let text = lean(&text, |member| to.join(member).join("Cargo.toml").exists())
        .map_err(|message| PackError::Manifest { path: root.join("Cargo.toml"), message })?;
    fs::write(&path, text).map_err(at(&path))?;
    prune(to)
}

/// Puts the sources of all dependencies into `vendor`, and tells cargo so.
pub fn vendor(files: &Path) -> Result<(), PackError> {
    let mut command = Command::new("cargo");
    let settings = output(command.args(["vendor", "--locked", "vendor"]).current_dir(files), "cargo vendor")?;
    let folder = files.join(".cargo");
    fs::create_dir(&folder).map_err(at(&folder))?;
    let path = folder.join("config.toml");
    fs::write(&path, settings).map_err(at(&path))
}

/// Copies a file or a folder: not what is hidden or built.
fn copy_one(from: &Path, to: &Path) -> Result<(), PackError> {
    if !from.is_dir() {
        return fs::copy(from, to).map(drop).map_err(at(from));
    }
    fs::create_dir_all(to).map_err(at(to))?;
    for entry in fs::read_dir(from).map_err(at(from))? {
        let entry = entry.map_err(at(from))?;
        let name = entry.file_name();
        let kind = entry.file_type().map_err(at(&entry.path()))?;
        let is_left_out = name.to_string_lossy().starts_with('.') || name == "target" || kind.is_symlink();
        if !is_left_out && !entry.path().join("CACHEDIR.TAG").exists() {
            copy_one(&entry.path(), &to.join(name))?;
        }
    }
    Ok(())
}

/// The root's manifest without programs, tests, optional dependencies and the members that are not there.
fn lean(manifest: &str, is_there: impl Fn(&str) -> bool) -> Result<String, String> {
    let mut table: Table = manifest.parse().map_err(|error: toml::de::Error| error.to_string())?;
    // Patched packages belong to the window.
    for kind in ["bin", "test", "bench", "example", "dev-dependencies", "patch"] {
        table.remove(kind);
    }
    if let Some(members) = table.get_mut("workspace").and_then(|workspace| workspace.get_mut("members")) {
        members.as_array_mut().into_iter().for_each(|members| members.retain(|m| m.as_str().is_some_and(&is_there)));
    }
    if let Some(Value::Table(package)) = table.get_mut("package") {
        package.insert("autobins".to_owned(), Value::Boolean(false));
    }
    if let Some(Value::Table(dependencies)) = table.get_mut("dependencies") {
        dependencies.retain(|_, dependency| dependency.get("optional") != Some(&Value::Boolean(true)));
    }
    // The names of features stay, since the code tests them; the packages that they enable are left out.
    if let Some(Value::Table(features)) = table.get_mut("features") {
        features.iter_mut().for_each(|(_, feature)| *feature = Value::Array(Vec::new()));
    }
    // It names packages of the window one by one.
    if let Some(Value::Table(profiles)) = table.get_mut("profile") {
        profiles.remove("dev");
    }
    toml::to_string(&table).map_err(|error| error.to_string())
}

/// Removes from the lock file the packages that are no longer needed; all versions stay the same.
fn prune(files: &Path) -> Result<(), PackError> {
    let cargo = |more: &[&str]| {
        let mut command = Command::new("cargo");
        command.args(["update", "--workspace", "--quiet"]).args(more).current_dir(files);
        output(&mut command, "cargo update").map(drop)
    };
    // The machine that built this grader has all sources, so the network is the second choice.
    cargo(&["--offline"]).or_else(|_| cargo(&[]))
}
