//! Lists that must stand in several places by their nature agree with each other.

use std::fs;
use std::path::{Path, PathBuf};

use grader::submission::NAMES;

use super::{assert_none, files, read, root, stem};

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

/// The functions that lines of a file name, one each, by what stands around the name.
fn named(path: &str, around: impl Fn(&str) -> String) -> Vec<&'static str> {
    let text = read(path);
    text.lines().filter_map(|line| NAMES.into_iter().find(|name| line.contains(&around(name)))).collect()
}

#[test]
fn tables_of_the_functions_are_in_the_order_of_the_course() {
    let in_row = |name: &str| format!("| [`{name}`](include-docs/{name}.md) |");
    assert_eq!(named("README.md", in_row), NAMES, "README.md: give every function one row of the table, in order");
    let in_row = |name: &str| format!("| [{name}]({name}.md) |");
    assert_eq!(named("include-docs/course.md", in_row), NAMES, "include-docs/course.md: give every function one row");
    let module = |name: &str| format!("pub mod {name};");
    assert_eq!(named("src/lib.rs", module), NAMES, "src/lib.rs: put the modules in the order of the course");
    let in_table = |name: &str| format!("name = \"{name}\"");
    assert_eq!(
        named("grader/rubric.toml", in_table),
        NAMES,
        "grader/rubric.toml: give every function one [[function]]"
    );
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
fn every_folder_of_data_is_in_provenance_md() {
    let text = read("data/PROVENANCE.md");
    let folders = fs::read_dir(root().join("data")).unwrap().flatten().filter(|entry| entry.path().is_dir());
    let names: Vec<_> = folders.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect();
    // Scenes are our own text.
    let missing = names.iter().filter(|name| *name != "scenes" && !text.contains(&format!("{name}/")));
    assert_none(missing.map(|name| format!("data/PROVENANCE.md: tell where {name}/ is from, and its terms")).collect());
}

/// The places that are compiled for elements of so many nodes.
const DISPATCH: [&str; 4] = [
    "crates/model/src/body_mesh.rs",
    "crates/elements/src/solids/any_elements.rs",
    "crates/engine/src/integrators/descent/groups.rs",
    "crates/engine/src/integrators/projection/constraints.rs",
];

#[test]
fn every_file_of_an_element_is_in_their_list_and_no_other_place_asks_which_one_a_body_has() {
    let list = read("crates/model/src/element/mod.rs");
    let mut problems = Vec::new();
    for path in files("rs").iter().filter(|path| path.starts_with("crates/model/src/element")) {
        let name = stem(path);
        let is_listed = list.contains(&format!("&{name}::{}", name.to_uppercase()));
        if !(is_listed || ["mod", "shape_function", "shares", "tests"].contains(&&*name)) {
            problems.push(format!("{}: add the element to Element::ALL", path.display()));
        }
    }
    let is_product = |path: &&PathBuf| {
        !path.components().any(|part| ["tests", "benches"].iter().any(|name| part.as_os_str() == *name))
    };
    for path in files("rs").iter().filter(is_product).filter(|path| !path.ends_with("tests.rs")) {
        let is_dispatch = DISPATCH.iter().any(|place| path == Path::new(place));
        let asks = ["mesh.arrays", "element().name ==", "element().nodes() =="];
        let text = read(path);
        for (number, line) in text.lines().enumerate().filter(|_| !is_dispatch) {
            if asks.iter().any(|question| line.contains(question)) {
                let place = format!("{}, line {}", path.display(), number + 1);
                problems.push(format!("{place}: asks for a kind of element; ask for a fact of `Element`"));
            }
        }
    }
    assert_none(problems);
}
