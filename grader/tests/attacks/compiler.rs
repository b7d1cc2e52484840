//! Files that pass the scan for words, as one with a new trick would, and read others while they are compiled.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Duration;

use grader::compile::prebuilt::Prebuilt;
use grader::compile::{Plan, build};
use grader::sandbox::Sandbox;
use grader::status::Status;
use tempfile::TempDir;

use super::classroom::{repository, solutions};

#[test]
fn what_the_compiler_has_read_beside_the_submission_is_refused_after_all_macros() {
    let libraries = Prebuilt::new(&repository(), Sandbox::none()).unwrap_or_else(|error| panic!("{error}"));
    let outside = TempDir::new().expect("a folder");
    fs::write(outside.path().join("h.rs"), "pub fn f() {}").expect("a file");
    let file = outside.path().join("h.rs").display().to_string();
    let library = libraries.folder.join("given/libcourse_given.rlib").display().to_string();
    let solutions = solutions();
    let hostile = [
        ("psi_neo_hookean", format!("const X: &str = include_str!({file:?});")),
        ("phi_linear_tetrahedron", format!("const X: &[u8] = include_bytes!({library:?});")),
        ("quadrature_single_point", format!("#[path = {file:?}] mod h;")),
        (
            "fixed_point_constraints",
            format!("macro_rules! m {{ ($($t:tt)*) => {{ $($t)* }} }} m!(#[path = {file:?}] mod h;);"),
        ),
        ("newtons_method", "const X: &str = env!(\"PATH\");".to_owned()),
        ("pick_nearest_vertices", "const X: Option<&str> = option_env!(\"PATH\");".to_owned()),
        ("linearly_implicit_euler", String::new()),
    ];
    let own = hostile.iter().map(|(name, line)| (*name, format!("{line}\n{}", solutions[name]))).collect();
    let plan = Plan { own, reference: None, helpers: BTreeMap::new(), limit: Duration::from_secs(60) };
    let folder = TempDir::new().expect("a folder");
    let built = build(&libraries, &Sandbox::none(), &plan, folder.path()).unwrap_or_else(|error| panic!("{error}"));
    assert!(built.program.is_some());
    for (name, line) in &hostile[..6] {
        let fault = built.faults.get(name).unwrap_or_else(|| panic!("{name} is built with {line}"));
        assert_eq!(fault.status, Status::Refused, "{name}: {}", fault.message);
        assert!(!fault.message.contains(&file) && fault.message.contains("is not allowed"), "{}", fault.message);
    }
    assert!(!built.faults.contains_key("linearly_implicit_euler"));
}

/// Libraries with the reference below a level.
fn libraries(folder: &Path) -> Vec<PathBuf> {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten().map(|entry| entry.path());
    let (folders, files): (Vec<_>, Vec<_>) = entries.partition(|path| path.is_dir());
    let here = files.into_iter().filter(|path| path.ends_with("libcourse_below.rlib"));
    here.chain(folders.iter().flat_map(|folder| libraries(folder))).collect()
}

/// Asserts that the libraries that a compiler sees, which a grading has built, hold no line of a solution.
pub fn libraries_hold_no_line_of_a_solution() {
    let prebuilt = Prebuilt::new(&repository(), Sandbox::none()).unwrap_or_else(|error| panic!("{error}"));
    let found = libraries(&prebuilt.folder);
    assert!(found.len() >= 3, "{found:?}");
    let lines: Vec<String> =
        solutions().values().flat_map(|text| text.lines().map(|line| line.trim().to_owned())).collect();
    for library in found {
        let beside: Vec<_> = fs::read_dir(library.parent().expect("a folder")).expect("a folder").flatten().collect();
        assert_eq!(beside.len(), 1, "{beside:?}");
        let bytes = fs::read(&library).expect("a library");
        let text = String::from_utf8_lossy(&bytes);
        // Messages of panics are in every program.
        for line in lines.iter().filter(|line| line.len() > 30 && !line.contains('"')) {
            assert!(!text.contains(line.as_str()), "{} holds {line}", library.display());
        }
    }
}
