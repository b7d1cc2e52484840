//! Errors of rustc, sorted by the file that causes them.

use std::collections::BTreeMap;

use grader_child::{Exercise, wire};
use serde::Deserialize;

use super::paths::without_paths;
use super::sources::signature;

/// Limit of the compiler's text that is kept for one function, bytes.
const MOST_TEXT: usize = 4000;

#[derive(Deserialize)]
struct Message {
    level: String,
    message: String,
    spans: Vec<Span>,
    rendered: Option<String>,
}

#[derive(Deserialize)]
struct Span {
    file_name: String,
    #[serde(default)]
    text: Vec<Line>,
    expansion: Option<Box<Expansion>>,
}

#[derive(Deserialize)]
struct Line {
    text: String,
}

/// The place of an error.
#[derive(Clone, Copy)]
enum Place {
    /// The function's file.
    File,
    /// The line that calls the function.
    Call,
    /// The line that imports the function from its file.
    Import,
}

#[derive(Deserialize)]
struct Expansion {
    span: Span,
}

/// Messages for the functions with an error in their file or in the line that calls them, by function.
pub fn faults(messages: &str) -> BTreeMap<&'static str, String> {
    let mut found: BTreeMap<&'static str, String> = BTreeMap::new();
    // Lines that are not messages come from a linker or a panicking compiler, and concern no file.
    for message in messages.lines().filter_map(|line| serde_json::from_str::<Message>(line).ok()) {
        if message.level != "error" {
            continue;
        }
        let Some((function, place)) = message.spans.iter().find_map(blamed) else { continue };
        let text = match place {
            Place::File => without_paths(&message.rendered.unwrap_or(message.message)),
            Place::Call => format!("the signature is not the course's, which is `{}`", signature(function)),
            Place::Import => {
                format!("the file has no public function of this name; write `{}`", signature(function))
            }
        };
        let told = found.entry(function.name()).or_default();
        if told.len() + text.len() < MOST_TEXT && !told.contains(&text) {
            told.push_str(&text);
            told.push('\n');
        } else if told.is_empty() {
            told.push_str(wire::start(&text, MOST_TEXT));
        }
    }
    found
}

/// The function that a place belongs to.
fn blamed(span: &Span) -> Option<(Exercise, Place)> {
    // Windows divides paths in its own way.
    let file_name = span.file_name.replace('\\', "/");
    let file = file_name.strip_prefix("src/");
    let here = match file {
        Some("main.rs") => span.text.iter().find_map(imported).map(|function| (function, Place::Import)),
        _ => file.and_then(|file| {
            let (place, file) = file.strip_prefix("calls/").map_or((Place::File, file), |file| (Place::Call, file));
            Exercise::from_name(file.strip_suffix(".rs")?).map(|function| (function, place))
        }),
    };
    here.or_else(|| span.expansion.as_ref().and_then(|expansion| blamed(&expansion.span)))
}

/// The function that the line `pub use NAME::NAME;` imports.
fn imported(line: &Line) -> Option<Exercise> {
    let (module, name) = line.text.trim().strip_prefix("pub use ")?.strip_suffix(';')?.split_once("::")?;
    Exercise::from_name(name).filter(|_| module == name)
}
