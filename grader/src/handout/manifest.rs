//! The manifests of the students' repository.

use toml::{Table, Value};

/// From this line on, `grader/Cargo.toml` is the instructor's.
const MARKER: &str = "# The instructor's part";

/// `grader/Cargo.toml` above its marker.
pub fn without_instructors_part(manifest: &str) -> Result<String, String> {
    let at = manifest.find(MARKER).ok_or_else(|| format!("holds no line `{MARKER}`"))?;
    Ok(format!("{}\n", manifest[..at].trim_end()))
}

/// The root's `Cargo.toml` without the tests and the members that are not handed out.
pub fn root_manifest(manifest: &str, has: impl Fn(&str) -> bool) -> Result<String, String> {
    let table: Table = manifest.parse().map_err(|error: toml::de::Error| error.to_string())?;
    let mut text = manifest.to_owned();
    let members = table.get("workspace").and_then(|workspace| workspace.get("members")).and_then(Value::as_array);
    for member in members.into_iter().flatten().filter_map(Value::as_str) {
        if !has(&format!("{member}/Cargo.toml")) {
            let quoted = format!("\"{member}\"");
            text = text.replacen(&format!(", {quoted}"), "", 1).replacen(&format!("{quoted}, "), "", 1);
        }
    }
    let targets = [("test", "tests"), ("bench", "benches"), ("example", "examples")];
    for (kind, folder) in targets {
        for target in table.get(kind).and_then(Value::as_array).into_iter().flatten() {
            let name = target.get("name").and_then(Value::as_str).unwrap_or_default();
            if !has(&format!("{folder}/{name}.rs")) && !has(&format!("{folder}/{name}/main.rs")) {
                text = without_table(&text, kind, name);
            }
        }
    }
    Ok(text)
}

/// Removes the table `[[kind]]` that has this name, up to the next table.
fn without_table(text: &str, kind: &str, name: &str) -> String {
    let head = format!("[[{kind}]]\n");
    let named = format!("name = \"{name}\"");
    let mut rest = text;
    let mut kept = String::new();
    while let Some(at) = rest.find(&head) {
        let end = rest[at + 1..].find("\n[").map_or(rest.len(), |end| at + 1 + end + 1);
        kept.push_str(&rest[..at]);
        if !rest[at..end].lines().any(|line| line == named) {
            kept.push_str(&rest[at..end]);
        }
        rest = &rest[end..];
    }
    kept + rest
}
