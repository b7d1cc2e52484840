//! Places at which a submission says that it panicked. Students read them, and a submission can forge them to reveal inputs, so only
//! lines that exist in its files are kept.

use std::collections::BTreeMap;

use super::Trouble;
use crate::submission::{Source, Submission};

/// Number of characters of each line of each file; `None` if every place is accepted.
#[derive(Clone, Debug, Default)]
pub struct Places(Option<BTreeMap<&'static str, Vec<usize>>>);

impl Places {
    /// The lines of a submission.
    pub fn of(submission: &Submission) -> Self {
        let written = submission.functions.iter().filter_map(|(name, source)| match source {
            Source::Written(text) => Some((*name, text.lines().map(|line| line.chars().count()).collect())),
            _ => None,
        });
        Self(Some(written.collect()))
    }

    /// The trouble, without a place that the submission does not have.
    pub fn checked(&self, trouble: Trouble) -> Trouble {
        match trouble {
            Trouble::Panicked { message, place } if !self.hold(&place) => {
                Trouble::Panicked { message, place: String::new() }
            }
            other => other,
        }
    }

    /// Returns true if `src/NAME.rs:LINE` or `src/NAME.rs:LINE:COLUMN` is a place in a file.
    fn hold(&self, place: &str) -> bool {
        let Some(files) = &self.0 else { return true };
        let mut parts = place.split(':');
        let name = parts.next().and_then(|file| file.strip_prefix("src/")?.strip_suffix(".rs"));
        let (line, column) = (parts.next().map(str::parse::<usize>), parts.next().map(str::parse::<usize>));
        let Some(lines) = name.and_then(|name| files.get(name)) else { return false };
        let width = line.and_then(Result::ok).and_then(|line| lines.get(line.checked_sub(1)?));
        // The end of a line is a place too.
        let is_on_line = |width: &usize| column.is_none_or(|column| column.is_ok_and(|n| (1..=width + 1).contains(&n)));
        width.is_some_and(is_on_line) && parts.next().is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_placed_on_a_line_that_the_file_has() {
        let text = "pub fn psi_neo_hookean() {\n    todo!()\n}\n".to_owned();
        let functions = BTreeMap::from([("psi_neo_hookean", Source::Written(text))]);
        let submission = Submission { name: "anna".to_owned(), functions, remarks: Vec::new() };
        let place = |text: &str| {
            let trouble = Trouble::Panicked { message: String::new(), place: text.to_owned() };
            match Places::of(&submission).checked(trouble) {
                Trouble::Panicked { place, .. } => place,
                other => panic!("{other}"),
            }
        };
        for known in ["src/psi_neo_hookean.rs:2", "src/psi_neo_hookean.rs:3:2", "src/psi_neo_hookean.rs:2:12"] {
            assert_eq!(place(known), known);
        }
        for (file, rest) in
            [("psi_neo_hookean", "4"), ("psi_neo_hookean", "0"), ("psi_neo_hookean", "2:13"), ("newtons_method", "1")]
        {
            assert_eq!(place(&format!("src/{file}.rs:{rest}")), "", "{file}:{rest}");
        }
    }
}
