//! The students' repository: whole, and without a solution. That it compiles without a warning, `.ci/handout` checks.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};
use std::sync::LazyLock;

use grader::submission::{NAMES, is_stub};

use super::{Files, leaks, write};
use crate::rubric::{Role, Rubric};

fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).parent().unwrap().to_owned()
}

fn whole_course() -> Rubric {
    Rubric::load(None).unwrap()
}

/// The handout of the whole course, written by whichever test comes first.
static WRITTEN: LazyLock<tempfile::TempDir> = LazyLock::new(|| {
    let folder = tempfile::tempdir().unwrap();
    write(&root(), &whole_course(), folder.path()).unwrap_or_else(|error| panic!("{error}"));
    folder
});

fn names(folder: &Path) -> BTreeSet<String> {
    let entries = fs::read_dir(folder).unwrap().flatten();
    entries.map(|entry| entry.file_name().to_string_lossy().into_owned()).collect()
}

#[test]
fn the_handout_has_no_strays() {
    let folder = &*WRITTEN;
    let expected = [
        ".gitignore",
        "Cargo.lock",
        "Cargo.toml",
        "LICENSE-APACHE",
        "LICENSE-MIT",
        "README.md",
        "crates",
        "data",
        "grader",
        "include-docs",
        "rustfmt.toml",
        "src",
        "tests",
    ];
    assert_eq!(names(folder.path()), expected.map(str::to_owned).into());
    assert_eq!(names(&folder.path().join("tests")), ["functions".to_owned()].into());
    assert_eq!(
        names(&folder.path().join("grader")),
        ["Cargo.toml", "child", "handed_out", "src"].map(str::to_owned).into()
    );
    for private in ["reference.rs", "reference", "variants.rs", "variants", "grade.rs", "handout.rs", "archive.rs"] {
        assert!(!folder.path().join("grader/src").join(private).exists(), "{private} is the instructor's");
    }
}

#[test]
fn every_function_is_empty_and_names_its_page() {
    let folder = &*WRITTEN;
    for name in NAMES {
        let text = fs::read_to_string(folder.path().join(format!("src/{name}.rs"))).unwrap();
        assert!(is_stub(name, &text), "{text}");
        assert!(text.contains(&format!("include-docs/{name}.md")), "{text}");
        assert!(folder.path().join(format!("include-docs/{name}.md")).exists());
        assert!(text.lines().count() < 25 && !text.contains("(_"), "{text}");
        assert_eq!(text.matches("fn ").count(), 1, "a helper is half a solution:\n{text}");
    }
}

#[test]
fn no_lint_stops_the_build_of_what_students_write() {
    let folder = &*WRITTEN;
    let library = fs::read_to_string(folder.path().join("src/lib.rs")).unwrap();
    assert!(
        library.contains("#![warn(warnings)]") && library.contains("extern crate self as finite_elements_3d;"),
        "{library}"
    );
    for entry in fs::read_dir(folder.path().join("src")).unwrap().flatten().filter(|entry| entry.path().is_file()) {
        let text = fs::read_to_string(entry.path()).unwrap();
        assert!(!text.contains("![deny(") && !text.contains("![forbid("), "{}", entry.path().display());
    }
}

#[test]
fn a_solution_in_any_text_is_found() {
    let solved = fs::read_to_string(root().join("src/newtons_method.rs")).unwrap();
    let inside = format!("# Hints\n\n{}", solved.replace("    ", " ").replace('\n', "  \n"));
    let files = Files::from([("include-docs/hints.md".into(), inside.into_bytes())]);
    assert_eq!(leaks(&root(), &whole_course(), &files).unwrap().len(), 1);
}

#[test]
fn links_of_its_pages_lead_somewhere() {
    let folder = &*WRITTEN;
    let pages = fs::read_dir(folder.path().join("include-docs")).unwrap().flatten().map(|entry| entry.path());
    for page in
        pages.chain([folder.path().join("README.md")]).filter(|path| path.extension().is_some_and(|e| e == "md"))
    {
        let text = fs::read_to_string(&page).unwrap();
        for target in text.split("](").skip(1).filter_map(|rest| rest.split([')', '#']).next()) {
            let is_local = !target.is_empty() && !target.contains(':');
            assert!(!is_local || page.parent().unwrap().join(target).exists(), "{}: {target}", page.display());
        }
    }
}

#[test]
fn commands_on_its_pages_fit_a_window_of_1280_pixels() {
    // Beside the list of sections such a window has room for so many letters of code.
    const MOST: usize = 95;
    let folder = root().join("include-docs");
    for name in names(&folder).into_iter().filter(|name| name.ends_with(".md")) {
        let page = fs::read_to_string(folder.join(&name)).unwrap();
        let blocks = page.split("```").skip(1).step_by(2).filter(|block| !block.starts_with("math"));
        let long = blocks.flat_map(str::lines).find(|line| line.chars().count() > MOST);
        assert_eq!(long, None, "{name} has a line of code that is cut off");
    }
}

#[test]
fn folders_that_hold_something_or_lie_in_the_sources_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    fs::write(folder.path().join("mine"), "").unwrap();
    assert!(write(&root(), &whole_course(), folder.path()).is_err_and(|error| error.to_string().contains("not empty")));
    let inside = root().join("src/handout");
    assert!(write(&root(), &whole_course(), &inside).is_err_and(|error| error.to_string().contains("inside")));
    assert!(!inside.exists());
}

#[test]
fn an_assignment_gives_some_functions_solved_and_leaves_some_for_later() {
    for file in ["first.toml", "second.toml"] {
        let rubric = Rubric::load(Some(&root().join("grader/rubrics").join(file))).unwrap();
        let folder = tempfile::tempdir().unwrap();
        write(&root(), &rubric, folder.path()).unwrap_or_else(|error| panic!("{error}"));
        let readme = fs::read_to_string(folder.path().join("README.md")).unwrap();
        for name in NAMES {
            let text = fs::read_to_string(folder.path().join(format!("src/{name}.rs"))).unwrap();
            let solved = fs::read_to_string(root().join(format!("src/{name}.rs"))).unwrap();
            let line = readme.lines().find(|line| line.contains(&format!("[`{name}`]"))).unwrap();
            match rubric.role(name) {
                Role::Asked => assert!(is_stub(name, &text) && !line.contains("assignment"), "{text}\n{line}"),
                Role::Later => assert!(is_stub(name, &text) && line.ends_with("(a later assignment) |"), "{line}"),
                Role::Given => {
                    assert!(text.starts_with("// Given solved") && line.ends_with("(given solved) |"), "{line}");
                    assert_eq!(super::unmarked(&text), solved);
                }
            }
        }
    }
}

#[test]
fn a_given_solution_hides_no_leak_of_another() {
    let rubric = Rubric::load(Some(&root().join("grader/rubrics/second.toml"))).unwrap();
    let read = |name: &str| fs::read(root().join(format!("src/{name}.rs"))).unwrap();
    let inside = |name: &str| Files::from([("include-docs/hints.md".into(), read(name))]);
    assert_eq!(leaks(&root(), &rubric, &inside("psi_neo_hookean")).unwrap(), []);
    assert_eq!(leaks(&root(), &rubric, &inside("newtons_method")).unwrap().len(), 1);
}
