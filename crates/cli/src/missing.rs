//! Functions that are not written yet: one message lists them when a scene needs one.

use std::any::Any;
use std::fs;
use std::panic::{self, AssertUnwindSafe};
use std::path::Path;

use crate::course::Course;
use crate::end::End;

/// Start of the panic message of a function of the handout.
const NOT_WRITTEN: &str = "not yet implemented";

/// Text in the handout's `todo!` of a function that this assignment does not ask for.
const LATER: &str = "a later assignment asks for it";

/// Runs code that calls the exercises. Turns the panic of a function that is not written yet into an error that lists all such
/// functions; any other panic goes on.
pub fn caught(course: &Course, run: impl FnOnce() -> Result<(), End>) -> Result<(), End> {
    let default_hook = panic::take_hook();
    panic::set_hook(Box::new(move |info| {
        if !text(info.payload()).starts_with(NOT_WRITTEN) {
            default_hook(info);
        }
    }));
    match panic::catch_unwind(AssertUnwindSafe(run)) {
        // The window catches panics itself and passes their messages on.
        Ok(Err(End::Stopped(message))) if message.contains(NOT_WRITTEN) => Err(explained(course, &message)),
        Ok(result) => result,
        Err(payload) if text(&*payload).starts_with(NOT_WRITTEN) => Err(explained(course, text(&*payload))),
        Err(payload) => panic::resume_unwind(payload),
    }
}

fn text(payload: &(dyn Any + Send)) -> &str {
    payload.downcast_ref::<String>().map(String::as_str).or_else(|| payload.downcast_ref().copied()).unwrap_or_default()
}

/// An error with the list of missing functions, or with the panic message if the sources are not at hand.
fn explained(course: &Course, message: &str) -> End {
    let src = course.folder.join("src");
    let names = unwritten(course.first_page, &src, |line| !line.contains(LATER));
    let Some(first) = names.first() else {
        if unwritten(course.first_page, &src, |_| true).is_empty() {
            return End::Stopped(message.to_owned());
        }
        return End::Stopped(
            "the scene needs functions that a later assignment asks for; those of this one are written".to_owned(),
        );
    };
    let width = names.iter().map(String::len).max().unwrap_or_default();
    let lines: String = names.iter().map(|name| format!("\n  {name:width$}  include-docs/{name}.md")).collect();
    End::Stopped(format!(
        "the scene needs a function that is not written yet; these functions are missing, each with its page:{lines}\n\
         begin with src/{first}.rs; `cargo run -p grader -- check --only {first}` tells when it is right"
    ))
}

/// Exercises whose file still contains a `todo!` of the handout that `counts`, in the order of the first page.
fn unwritten(first_page: &str, src: &Path, counts: impl Fn(&str) -> bool) -> Vec<String> {
    let stub = |path: &Path| {
        let text = fs::read_to_string(path).unwrap_or_default();
        text.lines().any(|line| line.trim_start().starts_with("todo!(") && counts(line))
    };
    let entries = fs::read_dir(src).into_iter().flatten().flatten().map(|entry| entry.path());
    let mut names: Vec<_> = entries
        .filter(|path| path.extension().is_some_and(|extension| extension == "rs") && stub(path))
        .filter_map(|path| Some(path.file_stem()?.to_string_lossy().into_owned()))
        .collect();
    names.sort_by_key(|name| place(first_page, name));
    names
}

/// Position of a function in the table of the first page; functions that it does not list come last.
fn place(first_page: &str, name: &str) -> usize {
    first_page.find(&format!("[{name}](")).unwrap_or(usize::MAX)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn missing_functions_are_listed_in_teaching_order() {
        let page = include_str!("../../../include-docs/course.md");
        let src = tempfile::tempdir().unwrap();
        for name in ["assemble_forces", "newtons_method", "phi_linear_tetrahedron", "psi_neo_hookean"] {
            fs::write(src.path().join(format!("{name}.rs")), "    todo!(\"read the page\")\n").unwrap();
        }
        fs::write(src.path().join("dpsi_neo_hookean_dF.rs"), "fn solved() {}\n").unwrap();
        fs::write(src.path().join("implicit_euler.rs"), format!("    todo!(\"{LATER}; read the page\")\n")).unwrap();
        let asked = ["phi_linear_tetrahedron", "psi_neo_hookean", "assemble_forces", "newtons_method"];
        assert_eq!(unwritten(page, src.path(), |line| !line.contains(LATER)), asked);
        assert_eq!(unwritten(page, src.path(), |_| true).len(), asked.len() + 1);
    }
}
