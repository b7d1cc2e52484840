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
    expansion: Option<Box<Expansion>>,
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
        let Some((function, is_call)) = message.spans.iter().find_map(blamed) else { continue };
        let text = if is_call {
            format!("the signature is not the course's, which is `{}`", signature(function))
        } else {
            without_paths(&message.rendered.unwrap_or(message.message))
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

/// The function whose file a place is in, and whether it is the line that calls the function.
fn blamed(span: &Span) -> Option<(Exercise, bool)> {
    // Windows divides paths in its own way.
    let file_name = span.file_name.replace('\\', "/");
    let here = file_name.strip_prefix("src/").and_then(|file| {
        let (is_call, file) = file.strip_prefix("calls/").map_or((false, file), |file| (true, file));
        let stem = file.strip_suffix(".rs")?;
        Exercise::from_name(stem).map(|function| (function, is_call))
    });
    here.or_else(|| span.expansion.as_ref().and_then(|expansion| blamed(&expansion.span)))
}
