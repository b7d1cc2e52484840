//! Escapes text from a submission for each output format.

/// Text without control sequences, control characters, marks that reverse the reading order and characters that XML
/// forbids. Line ends and tabs stay.
pub fn plain(text: &str) -> String {
    let mut kept = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        match c {
            '\u{1b}' => skip_sequence(&mut rest),
            '\r' if rest.peek() == Some(&'\n') => {}
            '\r' => kept.push('\n'),
            '\n' | '\t' => kept.push(c),
            _ if c.is_control() || is_invisible(c) => {}
            _ => kept.push(c),
        }
    }
    kept
}

/// [`plain`] on one line.
pub fn line(text: &str) -> String {
    plain(text).split_whitespace().collect::<Vec<_>>().join(" ")
}

/// Escapes a path as a relative link, so that no part of it can name another site or a script.
pub fn link(path: &str) -> String {
    let mut escaped = String::from("./");
    for &byte in path.trim_start_matches('/').as_bytes() {
        match byte {
            b'a'..=b'z' | b'A'..=b'Z' | b'0'..=b'9' | b'-' | b'_' | b'.' | b'~' | b'/' => {
                escaped.push(char::from(byte))
            }
            _ => escaped.push_str(&format!("%{byte:02X}")),
        }
    }
    escaped
}

/// Escapes text for Markdown and puts it on one line. Markdown, HTML, mentions and links in it have no effect.
pub fn markdown(text: &str) -> String {
    let text = line(text);
    let mut escaped = String::with_capacity(text.len());
    let mut rest = text.chars().peekable();
    while let Some(c) = rest.next() {
        let mark =
            matches!(c, '\\' | '`' | '*' | '_' | '{' | '}' | '[' | ']' | '<' | '>' | '#' | '|' | '~' | '&' | '@' | '!');
        let begins_list = escaped.is_empty() && matches!(c, '-' | '+' | '=');
        // Most sites turn a bare address into a link.
        let address = c == ':' && rest.peek() == Some(&'/') || c == '.' && escaped.ends_with("www");
        if mark || begins_list || address || matches!(c, '$' | '^') {
            escaped.push('\\');
        }
        escaped.push(c);
    }
    escaped
}

/// A Markdown block that shows the text as it is: its fence is longer than any in the text.
pub fn fenced(text: &str) -> String {
    let text = plain(text);
    let longest = text.split(|c| c != '`').map(str::len).max().unwrap_or(0);
    let fence = "`".repeat(longest.max(2) + 1);
    format!("{fence}text\n{}\n{fence}\n", text.trim_end())
}

/// Escapes text for a cell of a spreadsheet and puts it on one line, so that no program runs it as a formula.
pub fn cell(text: &str) -> String {
    let text = line(text);
    // The last four are the same signs at full width, which some spreadsheets read alike.
    if text.starts_with(['=', '+', '-', '@', '＝', '＋', '－', '＠']) { format!("'{text}") } else { text }
}

/// Marks that reverse the reading order, byte-order marks, and what XML forbids.
fn is_invisible(c: char) -> bool {
    let reverses = matches!(c, '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    reverses || matches!(c, '\u{feff}' | '\u{fffe}' | '\u{ffff}')
}

/// Skips the control sequence after an escape character, which a terminal would execute.
fn skip_sequence(rest: &mut std::iter::Peekable<std::str::Chars>) {
    match rest.next() {
        Some('[') => {
            rest.by_ref().find(|c| ('\u{40}'..='\u{7e}').contains(c));
        }
        Some(']' | 'P' | 'X' | '^' | '_') => {
            rest.by_ref().find(|c| matches!(c, '\u{7}' | '\u{1b}' | '\u{9c}' | '\n'));
        }
        _ => {}
    }
}
