//! Removes paths outside of `src` from the compiler's text, because they are paths of the instructor's machine.

/// Lines of one message that are kept.
const MOST_LINES: usize = 60;

/// Text in place of a path.
const ELSEWHERE: &str = "…";

/// A message of the compiler, without paths outside of `src` and with an end.
pub fn without_paths(text: &str) -> String {
    let mut lines: Vec<_> = text.lines().take(MOST_LINES).map(line).collect();
    if text.lines().nth(MOST_LINES).is_some() {
        lines.push(ELSEWHERE.to_owned());
    }
    lines.join("\n")
}

/// Cleans a line. The compiler writes the location of a message as `--> src/x.rs:1:2`.
fn line(line: &str) -> String {
    let place = [" --> ", " ::: "].into_iter().find_map(|arrow| Some((line.find(arrow)? + arrow.len(), arrow)));
    match place {
        Some((at, _)) if line[..at].trim_start().len() <= 4 && !line[at..].trim_start().starts_with("src/") => {
            format!("{}{ELSEWHERE}", &line[..at])
        }
        _ => without_absolute(line),
    }
}

/// Replaces what looks like an absolute path: `/rustc/…/mod.rs`, `C:\…`.
fn without_absolute(line: &str) -> String {
    let mut kept = String::with_capacity(line.len());
    let mut rest = line;
    while let Some(c) = rest.chars().next() {
        let is_start = kept.chars().next_back().is_none_or(|before| before.is_whitespace() || OPENING.contains(before));
        let length = if is_start { path_length(rest) } else { 0 };
        if length > 0 {
            kept.push_str(ELSEWHERE);
            rest = &rest[length..];
        } else {
            kept.push(c);
            rest = &rest[c.len_utf8()..];
        }
    }
    kept
}

const OPENING: &str = "'\"`([{<=,;:";
const CLOSING: &str = "'\"`)]}>,;";

/// Bytes of the absolute path that a text begins with, zero if it begins with another thing, such as a comment or a division.
fn path_length(text: &str) -> usize {
    let end = text.find(|c: char| c.is_whitespace() || CLOSING.contains(c)).unwrap_or(text.len());
    let word = &text[..end];
    let (bytes, is_letter) =
        (word.as_bytes(), |at: usize| word.as_bytes().get(at).is_some_and(u8::is_ascii_alphabetic));
    let is_unix = bytes.first() == Some(&b'/')
        && (is_letter(1) || matches!(bytes.get(1), Some(b'.' | b'_')))
        && word[1..].contains('/');
    let is_windows = is_letter(0) && bytes.get(1) == Some(&b':') && matches!(bytes.get(2), Some(b'/' | b'\\'));
    if is_unix || is_windows { end } else { 0 }
}

#[cfg(test)]
mod tests {
    use super::without_paths;

    #[test]
    fn paths_outside_of_src_are_taken_out_and_the_rest_stays() {
        let text = "error[E0277]: no `Add`\n  --> src/psi_neo_hookean.rs:3:5\n   |\n3  |     a / b // 1/2 or x /2.0/ y\n   |\n  \
            ::: /rustc/59807616/library/core/src/ops/arith.rs:76:5\n   |\nnote: required by\n  --> C:\\nalgebra\\x.rs:1:1\n  = note: \
            the full name for the type has been written to '/tmp/grader-x/program.long-type-1.txt'\n  = note: see (/opt/rust/lib.rs:1:2)";
        let told = without_paths(text);
        for path in ["rustc/", "arith", "nalgebra", "tmp", "long-type", "opt"] {
            assert!(!told.contains(path), "{path} in {told}");
        }
        for kept in ["src/psi_neo_hookean.rs:3:5", "a / b // 1/2 or x /2.0/ y", "::: …", "written to '…'", "see (…)"]
        {
            assert!(told.contains(kept), "{kept} not in {told}");
        }
        assert_eq!(without_paths(&"x\n".repeat(1000)).lines().count(), 61);
    }
}
