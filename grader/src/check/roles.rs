//! The part of each function in the assignment of a repository.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use super::HANDED_OUT;
use crate::submission::{GIVEN, LATER, NAMES, Source, Submission, is_stub};

/// The part of a function in an assignment.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Role {
    /// The student writes it.
    Asked,
    /// It was handed out solved.
    Given,
    /// A later assignment asks for it.
    Later,
}

/// The part of each function.
pub type Roles = BTreeMap<&'static str, Role>;

/// The part of each function, as its file tells that was handed out, or else the present one.
pub fn roles(folder: &Path, submission: &Submission) -> Roles {
    NAMES.map(|name| (name, role(folder, name, submission.functions.get(name)))).into()
}

fn role(folder: &Path, name: &str, source: Option<&Source>) -> Role {
    let present = || match source {
        Some(Source::Written(text)) => text.clone(),
        _ => String::new(),
    };
    let text = fs::read_to_string(folder.join(HANDED_OUT).join(format!("{name}.rs"))).unwrap_or_else(|_| present());
    let is_later = matches!(source, Some(Source::Missing(why)) if why == LATER);
    if text.starts_with(GIVEN) {
        Role::Given
    } else if is_later || (text.contains(LATER) && is_stub(name, &text)) {
        Role::Later
    } else {
        Role::Asked
    }
}
