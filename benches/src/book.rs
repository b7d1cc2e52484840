//! Puts the output of a command into a page of the book: under the line that names the command, up to the line that ends it.

use std::fs;
use std::path::Path;
use std::process::Command;

use crate::end::End;
use crate::run::output_of;

/// The line above what a command has printed is this, its arguments and ` -->`; the line below is [`END`].
const START: &str = "<!-- $ cargo run -q --release -p fem-bench -- ";
const END: &str = "<!-- end -->";

/// Runs this program with these arguments and writes what it prints into a page. The page is written at once, after the command has succeeded.
pub fn write(page: &Path, arguments: &[String]) -> Result<(), End> {
    let unusable = |problem: String| End::unusable(format!("{}: {problem}", page.display()));
    let text = fs::read_to_string(page).map_err(|error| unusable(error.to_string()))?;
    let Some((before, after)) = around(&text, arguments) else {
        let line = format!("{START}{} -->", arguments.join(" "));
        return Err(unusable(format!(
            "has no line `{line}` with a line `{END}` below it; add both where the table goes"
        )));
    };
    let printed = output_of(Command::new(std::env::current_exe().map_err(End::unusable)?).args(arguments))?;
    let whole = format!("{before}\n{}\n\n{after}", printed.trim_end());
    fem_mesh::write::save_bytes(page, whole.as_bytes()).map_err(End::unusable)
}

/// The text up to the line of a command, and from the end of its output on.
fn around<'a>(text: &'a str, arguments: &[String]) -> Option<(&'a str, &'a str)> {
    let mut place = 0;
    for line in text.split_inclusive('\n') {
        place += line.len();
        let named = line.trim_end().strip_prefix(START).and_then(|rest| rest.strip_suffix(" -->"));
        if named.is_some_and(|named| is_same(named, arguments)) {
            let end = place + text[place - 1..].find(&format!("\n{END}"))?;
            // The end of another command is not this one's.
            return (!text[place..end].contains("<!-- $ ")).then(|| (&text[..place], &text[end..]));
        }
    }
    None
}

/// Returns true if a line names these arguments. A variable, such as `"$EIGEN"`, stands for any path.
fn is_same(line: &str, arguments: &[String]) -> bool {
    let words: Vec<&str> = line.split_whitespace().collect();
    let is_path = |word: &str| word.trim_matches('"').starts_with('$');
    words.len() == arguments.len() && words.iter().zip(arguments).all(|(word, own)| is_path(word) || word == own)
}

#[cfg(test)]
mod tests {
    use clap::Parser;

    use super::*;
    use crate::cli::Arguments;

    fn words(line: &str) -> Vec<String> {
        line.split_whitespace().map(str::to_owned).collect()
    }

    #[test]
    fn only_the_output_of_the_command_is_replaced() {
        let text = format!(
            "a\n{START}parts x -->\nold\n{END}\nb\n{START}peers --eigen \"$E\" -->\n{END}\nc\n{START}gpu -->\n"
        );
        let parts = around(&text, &words("parts x")).unwrap();
        assert_eq!(parts.0, format!("a\n{START}parts x -->\n"));
        assert_eq!(parts.0.len() + "old\n".len() + parts.1.len(), text.len());
        assert!(parts.1.starts_with(&format!("{END}\nb\n")), "{}", parts.1);
        assert!(around(&text, &words("peers --eigen /a/program")).is_some());
        for missing in ["parts", "parts y", "peers", "gpu"] {
            assert_eq!(around(&text, &words(missing)), None, "{missing}");
        }
    }

    #[test]
    fn every_command_of_the_book_is_one_of_this_program_and_has_an_end() {
        let mut commands = 0;
        for entry in fs::read_dir(concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/book")).unwrap() {
            let path = entry.unwrap().path();
            let Ok(text) = fs::read_to_string(&path) else { continue };
            for line in text.lines().filter(|line| line.starts_with("<!-- $ ")) {
                let place = format!("{}: {line}", path.display());
                let named = line.strip_prefix(START).and_then(|rest| rest.strip_suffix(" -->")).expect(&place);
                Arguments::try_parse_from(["fem-bench".to_owned()].into_iter().chain(words(named))).expect(&place);
                let (before, after) = around(&text, &words(named)).expect(&place);
                assert!(text.starts_with(before) && text.ends_with(after) && after.starts_with(END), "{place}");
                let output = &text[before.len()..text.len() - after.len()];
                assert!(output.contains("; commit ") && output.contains("; load "), "{place}: no machine and commit");
                commands += 1;
            }
        }
        assert!(commands >= 6, "{commands}");
    }
}
