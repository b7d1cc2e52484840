//! The files and variables that rustc has read for a program, as it lists them itself: after all macros are expanded.

use grader_child::Exercise;

/// The first thing in a list of dependencies that is no source of the program; `None` if it holds nothing else.
///
/// The list is a makefile's: `program: src/main.rs src/calls.rs …`, and a comment for each variable of the environment.
pub fn first_stray(list: &str) -> Option<String> {
    if let Some(variable) = list.lines().find_map(|line| line.strip_prefix("# env-dep:")) {
        let name = variable.split('=').next().unwrap_or_default();
        return Some(format!("the environment variable {}", shown(name)));
    }
    let (_, read) = list.lines().find_map(|line| line.split_once(": "))?;
    // A space in a path is written `\ `; paths of the program have no spaces.
    read.split(' ').filter(|path| !path.is_empty()).find(|path| !is_own(path)).map(|_| "another file".to_owned())
}

fn shown(name: &str) -> String {
    name.chars().filter(|c| c.is_ascii_alphanumeric() || *c == '_').take(40).collect()
}

fn is_own(path: &str) -> bool {
    // Windows divides paths in its own way.
    let path = path.replace('\\', "/");
    let Some(file) = path.strip_prefix("src/") else { return false };
    let function = file.strip_prefix("calls/").unwrap_or(file).strip_suffix(".rs");
    ["main.rs", "calls.rs"].contains(&file) || function.is_some_and(|name| Exercise::from_name(name).is_some())
}

#[cfg(test)]
mod tests {
    use super::first_stray;

    #[test]
    fn sources_are_expected_and_anything_else_is_a_stray() {
        let own = "program: src/main.rs src/calls.rs src/calls/newtons_method.rs src/newtons_method.rs";
        assert_eq!(first_stray(&format!("{own}\n\nsrc/main.rs:\n")), None);
        assert_eq!(first_stray("program: src\\main.rs src\\calls\\newtons_method.rs"), None);
        for file in [
            "/etc/passwd",
            "src/../x.rs",
            "src/hidden.rs",
            "src/newtons_method/x.rs",
            "below/libcourse_below.rlib",
            "a\\ b",
        ] {
            assert!(first_stray(&format!("{own} {file}\n")).is_some(), "{file}");
        }
        let variable = first_stray(&format!("{own}\n\n# env-dep:HOME=/root\n"));
        assert_eq!(variable.as_deref(), Some("the environment variable HOME"));
    }
}
