//! Dependencies on other crates: each one explained, and no window under the grader or the engine.

use std::collections::BTreeSet;
use std::process::Command;

use super::{assert_none, files, read, root};

/// The page whose last table says what each dependency is for.
const TABLE: &str = "docs/decisions/dependencies.md";

/// Names of the crates that a Cargo.toml takes from elsewhere.
fn dependencies(manifest: &str) -> Vec<String> {
    let mut names = Vec::new();
    let mut is_list = false;
    for line in manifest.lines() {
        if let Some(table) = line.strip_prefix('[') {
            let table = table.trim_end_matches(']');
            is_list = table.ends_with("dependencies");
            names.extend(table.split_once("dependencies.").map(|(_, name)| name.to_owned()));
        } else if is_list && !line.contains("path = ") && !line.starts_with('#') {
            names.extend(line.split(['.', ' ', '=']).next().filter(|name| !name.is_empty()).map(str::to_owned));
        }
    }
    names
}

#[test]
fn every_dependency_has_a_line_in_its_table_and_every_line_a_dependency() {
    let text = read(TABLE);
    let section = text.split("\n## ").find(|section| section.starts_with("What each is for"));
    let section = section.expect("docs/decisions/dependencies.md has a section `What each is for`");
    let cells = section.lines().filter(|line| line.starts_with('|')).skip(2).filter_map(|row| row.split('|').nth(1));
    let told: BTreeSet<_> = cells.flat_map(|cell| cell.split(',')).map(|name| name.trim().replace('`', "")).collect();
    let manifests = files("toml").into_iter().filter(|path| path.ends_with("Cargo.toml"));
    let used: BTreeSet<_> = manifests.flat_map(|path| dependencies(&read(path))).collect();
    let untold = used.difference(&told).map(|name| format!("{TABLE}: tell what {name} does here, and why it"));
    let unused = told.difference(&used).map(|name| format!("{TABLE}: {name} is no dependency; remove its line"));
    assert_none(untold.chain(unused).collect());
}

/// The crates that a build of a package is made of, as cargo tells.
fn built_from(package: &str) -> BTreeSet<String> {
    let arguments = ["tree", "--offline", "--edges", "normal,build", "--prefix", "none", "--package", package];
    let output = Command::new(env!("CARGO")).args(arguments).current_dir(root()).output().expect("cargo starts");
    assert!(output.status.success(), "cargo tree: {}", String::from_utf8_lossy(&output.stderr));
    let text = String::from_utf8_lossy(&output.stdout).into_owned();
    text.lines().filter_map(|line| line.split(' ').next()).map(str::to_owned).collect()
}

#[test]
fn neither_the_grader_nor_the_engine_is_built_with_a_window() {
    let window = ["fem-viewer", "kiss3d", "wgpu", "winit", "egui", "image"];
    let demo = built_from("finite-elements-3d");
    assert!(window.iter().all(|name| demo.contains(*name)), "the demo has a window: {demo:?}");
    for package in ["grader", "grader-child", "fem-engine"] {
        let found: Vec<_> = built_from(package).into_iter().filter(|name| window.contains(&name.as_str())).collect();
        assert!(found.is_empty(), "{package} is built with {found:?}; take the feature `viewer` from its dependencies");
    }
    assert!(!built_from("grader").contains("fem-engine"), "the grader knows nothing of the engine");
}
