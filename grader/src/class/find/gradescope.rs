//! `submission_metadata.yml`, which Gradescope puts among exported submissions: the students of each folder and its time.
//!
//! Gradescope's program writes it with Ruby's Psych, always in this layout, of which no more is read:
//!
//! ```yaml
//! ---
//! submission_123456:
//!   :submitters:
//!   - :name: Jane Doe
//!     :sid: '1001'
//!     :email: jane@example.org
//!   :created_at: 2026-05-04 18:32:11.262843000 Z
//! ```
//!
//! Texts of students (output of tests) stand further to the right, so that no such text can pass for one of these lines.

use super::rosters::Listed;
use super::students::Time;

pub const METADATA: &str = "submission_metadata.yml";

/// The students of all submissions; a student of two has two entries.
pub fn read(text: &str) -> Vec<Listed> {
    let mut listed: Vec<Listed> = Vec::new();
    let (mut folder, mut begin, mut in_submitters) = (String::new(), 0, false);
    for line in text.lines() {
        let indent = line.len() - line.trim_start_matches(' ').len();
        let item = line.trim_start_matches(' ');
        match indent {
            0 if !item.starts_with(['-', '#']) => {
                folder = scalar(item.trim_end().trim_end_matches(':'));
                (begin, in_submitters) = (listed.len(), false);
            }
            2 if item.starts_with("- ") && in_submitters => {
                listed.push(Listed { submission: folder.clone(), ..Listed::default() });
                set(&mut listed[begin..], &item[2..]);
            }
            2 => {
                in_submitters = item.trim_end() == ":submitters:";
                if let Some(time) = item.strip_prefix(":created_at: ") {
                    let time = Time::read(scalar(time));
                    listed[begin..].iter_mut().for_each(|listed| listed.time = Some(time.clone()));
                }
            }
            4 if in_submitters => set(&mut listed[begin..], item),
            _ => {}
        }
    }
    listed
}

/// Sets one field of the last student.
fn set(students: &mut [Listed], item: &str) {
    let (Some((key, value)), Some(student)) = (item.split_once(": "), students.last_mut()) else { return };
    match key {
        ":name" => student.person.name = scalar(value),
        ":sid" => student.person.id = scalar(value),
        ":email" => student.person.email = scalar(value),
        _ => {}
    }
}

/// A value on one line: plain, in single or in double quotes. An anchor before it has no meaning here.
fn scalar(text: &str) -> String {
    let text = text.trim();
    let text = text.strip_prefix('&').and_then(|text| text.split_once(' ')).map_or(text, |(_, value)| value);
    let quoted = |mark: char| text.strip_prefix(mark)?.strip_suffix(mark);
    if let Some(inner) = quoted('\'') {
        return inner.replace("''", "'");
    }
    if let Some(inner) = quoted('"') {
        return unescaped(inner);
    }
    if matches!(text, "~" | "null") { String::new() } else { text.to_owned() }
}

/// The text of a scalar in double quotes.
fn unescaped(text: &str) -> String {
    let mut plain = String::new();
    let mut rest = text.chars();
    while let Some(c) = rest.next() {
        let digits = match c {
            '\\' => match rest.next() {
                Some('x') => 2,
                Some('u') => 4,
                Some('U') => 8,
                Some('n' | 't') => {
                    plain.push(' ');
                    continue;
                }
                other => {
                    plain.extend(other);
                    continue;
                }
            },
            _ => {
                plain.push(c);
                continue;
            }
        };
        let code: String = rest.by_ref().take(digits).collect();
        plain.extend(u32::from_str_radix(&code, 16).ok().and_then(char::from_u32));
    }
    plain
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn groups_times_and_quoted_names_are_read_and_output_of_students_is_not() {
        let text = "---\nsubmission_1:\n  :submitters:\n  - :name: Solo Student\n    :sid: '100'\n    :email: solo@x.org\n  \
            :created_at: 2026-05-04 18:32:11.262843000 Z\n  :score: 1.0\n  :results:\n    :output: |\n      x\n      submission_2:\n\
            \x20       :submitters:\n        - :name: Mallory\n  :history:\n  - :id: 7\n    :name: Eve\nsubmission_2:\n  :submitters:\n  - \
            :name: \"J\\xF6rg \\\"J\\\" M\"\n    :sid: &1 'o''1'\n    :email: j@x.org\n  - :name: Pair Two\n    :sid:\n    :email: two@x.org\n";
        let found = read(text);
        let rows: Vec<_> = found
            .iter()
            .map(|listed| {
                (
                    listed.submission.as_str(),
                    listed.person.name.as_str(),
                    listed.person.id.as_str(),
                    listed.person.email.as_str(),
                )
            })
            .collect();
        let expected = [
            ("submission_1", "Solo Student", "100", "solo@x.org"),
            ("submission_2", "Jörg \"J\" M", "o'1", "j@x.org"),
            ("submission_2", "Pair Two", "", "two@x.org"),
        ];
        assert_eq!(rows, expected);
        let time = found[0].time.as_ref().and_then(Time::moment).map(|moment| moment.to_string());
        assert_eq!(time.as_deref(), Some("2026-05-04T18:32:11.262843Z"));
        assert!(found[1].time.is_none());
        assert!(read("").is_empty() && read("submission_1").is_empty());
    }
}
