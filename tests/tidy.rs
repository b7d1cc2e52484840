//! The repository holds together: files that belong to each other exist and agree, and nothing untidy has crept in.
//!
//! Needs no feature: `cargo test --no-default-features --test tidy`. Every message ends with what to do.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use grader::submission::NAMES;

/// Exercises of two parts each – a search and what to do where it finds nothing, a ray and its hit, a direction and the step
/// along it – that would not be clearer in two files.
const LONGER_EXERCISES: [&str; 3] = ["build_skinning_matrix", "pick_nearest_vertices", "newtons_method"];

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

fn read(path: impl AsRef<Path>) -> String {
    let path = root().join(path);
    fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}; write this file", path.display()))
}

/// Every file of the repository with this extension, by its path from the root; neither hidden folders nor build products.
fn files(extension: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![root().to_owned()];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(folder).unwrap().flatten() {
            let (path, name) = (entry.path(), entry.file_name().to_string_lossy().into_owned());
            let is_built = name == "target" || path.join("CACHEDIR.TAG").exists();
            if path.is_dir() && !name.starts_with('.') && !is_built {
                folders.push(path);
            } else if path.extension().is_some_and(|found| found == extension) {
                found.push(path.strip_prefix(root()).unwrap().to_owned());
            }
        }
    }
    found.sort();
    found
}

/// Fails with all problems at once.
fn assert_none(problems: Vec<String>) {
    assert!(problems.is_empty(), "\n{}\n", problems.join("\n"));
}

fn stem(path: &Path) -> String {
    path.file_stem().unwrap().to_string_lossy().into_owned()
}

/// A file's text without its module of unit tests, which stands last.
fn without_unit_tests(text: &str) -> &str {
    text.find("\n#[cfg(test)]\nmod ").map_or(text, |end| &text[..end + 1])
}

#[test]
fn every_file_in_src_is_an_exercise_or_belongs_to_the_demo() {
    let rest = ["lib", "main", "assignment_setup"];
    let found: BTreeSet<_> =
        files("rs").iter().filter(|path| path.parent() == Some(Path::new("src"))).map(|path| stem(path)).collect();
    let expected: BTreeSet<_> = NAMES.iter().chain(&rest).map(|name| name.to_string()).collect();
    let both = format!("{:?}", found.symmetric_difference(&expected));
    assert_eq!(found, expected, "src/ and the list in tests/tidy.rs differ by {both}; add or remove the file");
}

#[test]
fn every_exercise_file_holds_one_public_function_that_is_named_like_it() {
    let mut problems = Vec::new();
    for name in NAMES {
        let text = read(format!("src/{name}.rs"));
        let public: Vec<_> = text.lines().filter(|line| line.starts_with("pub")).collect();
        let is_function =
            |line: &str| line.strip_prefix(&format!("pub fn {name}")).is_some_and(|rest| rest.starts_with(['(', '<']));
        if !matches!(public[..], [line] if is_function(line)) {
            problems.push(format!("src/{name}.rs: `pub fn {name}` must be its only public item; found {public:?}"));
        }
    }
    assert_none(problems);
}

#[test]
fn lib_rs_names_the_page_the_module_and_the_function_of_every_exercise() {
    let text = read("src/lib.rs");
    let lines: Vec<_> = text.lines().collect();
    let mut problems = Vec::new();
    for name in NAMES {
        let include = format!("#[doc = include_str!(\"../include-docs/{name}.md\")]");
        let (module, export) = (format!("pub mod {name};"), format!("pub use {name}::{name};"));
        for line in [&include, &module, &export] {
            if lines.iter().filter(|found| *found == line).count() != 1 {
                problems.push(format!("src/lib.rs: add the line `{line}`, once"));
            }
        }
        let place = |line: &String| lines.iter().position(|found| found == line);
        if let (Some(include), Some(module)) = (place(&include), place(&module))
            && !(include < module && lines[include..module].iter().all(|line| line.starts_with("#[")))
        {
            problems
                .push(format!("src/lib.rs: the page of {name} does not stand above `pub mod {name};`; move it there"));
        }
    }
    assert_none(problems);
}

#[test]
fn every_exercise_has_a_page_with_the_same_headings_in_the_same_order() {
    let headings = |name: &str| -> Vec<String> {
        let text = read(format!("include-docs/{name}.md"));
        text.lines().filter(|line| line.starts_with('#')).map(str::to_owned).collect()
    };
    let expected = headings(NAMES[0]);
    assert!(expected.len() >= 5, "include-docs/{}.md has the headings {expected:?} alone; complete it", NAMES[0]);
    let differs = |name: &&str| headings(name) != expected;
    let problem = |name| format!("include-docs/{name}.md: headings {:?}; make them {expected:?}", headings(name));
    assert_none(NAMES.into_iter().filter(differs).map(problem).collect());
}

#[test]
fn every_exercise_has_its_module_of_checks() {
    let list = read("grader/src/properties.rs");
    let mut problems = Vec::new();
    for name in NAMES {
        for line in [format!("pub mod {name};"), format!("    (\"{name}\", {name}::CHECKS),")] {
            if !list.lines().any(|found| found == line) {
                problems.push(format!("grader/src/properties.rs: add `{}`, with the checks of {name}", line.trim()));
            }
        }
    }
    assert_none(problems);
}

#[test]
fn the_readme_has_a_table_of_all_functions_in_the_order_of_the_course() {
    let text = read("README.md");
    let rows = text.lines().filter(|line| line.starts_with('|'));
    let named = |row: &str| NAMES.into_iter().find(|name| row.contains(&format!("`{name}`")));
    let found: Vec<_> = rows.filter_map(named).collect();
    assert_eq!(found, NAMES, "README.md: give every function one row of the table, its name in backquotes, in order");
}

#[test]
fn every_scene_is_in_the_readme() {
    let text = read("README.md");
    let is_scene = |path: &&PathBuf| path.starts_with("data/scenes");
    let scenes = files("toml");
    let names: Vec<_> = scenes.iter().filter(is_scene).map(|path| stem(path)).collect();
    assert!(!names.is_empty(), "there are no scenes in data/scenes");
    let missing = names.iter().filter(|name| !text.contains(&format!("`{name}`")));
    assert_none(missing.map(|name| format!("README.md: tell in the list of scenes what `{name}` is")).collect());
}

#[test]
fn exercises_are_short() {
    let mut problems = Vec::new();
    for name in NAMES {
        let (lines, most) =
            (read(format!("src/{name}.rs")).lines().count(), if LONGER_EXERCISES.contains(&name) { 85 } else { 60 });
        if lines > most {
            problems.push(format!("src/{name}.rs: {lines} lines; shorten it to {most}"));
        }
    }
    assert_none(problems);
}

#[test]
fn no_file_has_more_than_300_lines_apart_from_its_unit_tests() {
    let lines = |path: &PathBuf| without_unit_tests(&read(path)).lines().count();
    let too_long = files("rs").into_iter().map(|path| (lines(&path), path)).filter(|(lines, _)| *lines > 300);
    assert_none(
        too_long.map(|(n, path)| format!("{}: {n} lines; two things live there, part them", path.display())).collect(),
    );
}

#[test]
fn no_file_has_tabs_spaces_at_the_end_of_a_line_or_a_last_line_without_an_end() {
    let mut problems = Vec::new();
    for path in ["rs", "md", "toml"].iter().flat_map(|extension| files(extension)) {
        let text = read(&path);
        for (number, line) in text.lines().enumerate() {
            if line.contains('\t') || line.ends_with([' ', '\r']) {
                problems.push(format!(
                    "{}, line {}: remove the tab or the spaces at its end",
                    path.display(),
                    number + 1
                ));
            }
        }
        if !text.ends_with('\n') || text.ends_with("\n\n") {
            problems.push(format!("{}: let it end in one line end", path.display()));
        }
    }
    assert_none(problems);
}

#[test]
fn no_code_is_left_unfinished() {
    // Inside quotes a word is talked about, not used.
    let is_used = |line: &str, word: &str| line.find(word).is_some_and(|at| !line[..at].contains(['"', '`']));
    let note = concat!("FIX", "ME");
    let mut problems = Vec::new();
    for path in files("rs") {
        for (number, line) in read(&path).lines().enumerate() {
            if ["todo!", "unimplemented!", "dbg!"].iter().any(|word| is_used(line, word)) || line.contains(note) {
                problems.push(format!("{}, line {}: `{}`; finish it", path.display(), number + 1, line.trim()));
            }
        }
    }
    assert_none(problems);
}

#[test]
fn every_folder_of_data_is_in_provenance_md() {
    let text = read("data/PROVENANCE.md");
    let folders = fs::read_dir(root().join("data")).unwrap().flatten().filter(|entry| entry.path().is_dir());
    let names: Vec<_> = folders.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    // Scenes are our own text.
    let missing = names.iter().filter(|name| *name != "scenes" && !text.contains(&format!("{name}/")));
    assert_none(missing.map(|name| format!("data/PROVENANCE.md: tell where {name}/ is from, and its terms")).collect());
}

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
fn every_dependency_has_a_line_in_architecture_md_and_every_line_a_dependency() {
    let text = read("ARCHITECTURE.md");
    let section =
        text.split("\n## ").find(|section| section.starts_with("Dependencies")).expect("a section Dependencies");
    let cells = section.lines().filter(|line| line.starts_with('|')).skip(2).filter_map(|row| row.split('|').nth(1));
    let told: BTreeSet<_> = cells.flat_map(|cell| cell.split(',')).map(|name| name.trim().replace('`', "")).collect();
    let manifests = files("toml").into_iter().filter(|path| path.ends_with("Cargo.toml"));
    let used: BTreeSet<_> = manifests.flat_map(|path| dependencies(&read(path))).collect();
    let untold = used.difference(&told).map(|name| format!("ARCHITECTURE.md: tell what {name} does here, and why it"));
    let unused =
        told.difference(&used).map(|name| format!("ARCHITECTURE.md: {name} is no dependency; remove its line"));
    assert_none(untold.chain(unused).collect());
}

#[test]
fn links_to_files_lead_somewhere() {
    let mut problems = Vec::new();
    for path in files("md") {
        for (number, line) in read(&path).lines().enumerate() {
            let targets = line.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next());
            let is_local = |target: &&str| !target.is_empty() && !target.contains(':');
            for target in targets.filter(is_local) {
                // The page of the students' repository stands in its root.
                let place = if path.starts_with("grader/handout") { Path::new("README.md") } else { &path };
                if !root().join(place).parent().unwrap().join(target).exists() {
                    problems.push(format!(
                        "{}, line {}: there is no {target}; correct the link",
                        path.display(),
                        number + 1
                    ));
                }
            }
        }
    }
    assert_none(problems);
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
