//! The manifests of the students' repository.

use toml_edit::{DocumentMut, Item, TableLike, TomlError};

/// From this line on, `grader/Cargo.toml` is the instructor's.
const MARKER: &str = "# The instructor's part";

/// `grader/Cargo.toml` above its marker.
pub fn without_instructors_part(manifest: &str) -> Result<String, String> {
    let at = manifest.find(MARKER).ok_or_else(|| format!("holds no line `{MARKER}`"))?;
    Ok(format!("{}\n", manifest[..at].trim_end()))
}

/// The root's `Cargo.toml` without the crates, features and tests that are not handed out; `has` tells whether a file is.
pub fn root_manifest(manifest: &str, has: impl Fn(&str) -> bool) -> Result<String, String> {
    let mut manifest: DocumentMut = manifest.parse().map_err(|error: TomlError| error.to_string())?;
    let is_crate = |folder: &str| has(&format!("{folder}/Cargo.toml"));
    if let Some(members) = manifest["workspace"]["members"].as_array_mut() {
        members.retain(|member| member.as_str().is_some_and(is_crate));
    }
    let mut removed = Vec::new();
    for list in ["dependencies", "dev-dependencies"] {
        if let Some(dependencies) = manifest.get_mut(list).and_then(Item::as_table_like_mut) {
            removed.extend(remove_crates(dependencies, is_crate));
        }
    }
    if let Some(features) = manifest.get_mut("features").and_then(Item::as_table_like_mut) {
        remove_features(features, &removed);
    }
    if let Some(optimised) = manifest.get_mut("profile").and_then(|profile| profile.get_mut("dev")?.get_mut("package"))
        && let Some(packages) = optimised.as_table_like_mut()
    {
        removed.iter().for_each(|name| drop(packages.remove(name)));
    }
    for (kind, folder) in [("test", "tests"), ("bench", "benches"), ("example", "examples")] {
        if let Some(targets) = manifest.get_mut(kind).and_then(Item::as_array_of_tables_mut) {
            targets.retain(|target| {
                let name = target.get("name").and_then(Item::as_str).unwrap_or_default();
                has(&format!("{folder}/{name}.rs")) || has(&format!("{folder}/{name}/main.rs"))
            });
        }
    }
    Ok(manifest.to_string())
}

/// Removes the dependencies on folders that are not handed out, and returns their names.
fn remove_crates(dependencies: &mut dyn TableLike, is_crate: impl Fn(&str) -> bool) -> Vec<String> {
    let path = |dependency: &Item| dependency.get("path").and_then(Item::as_str).map(str::to_owned);
    let is_missing = |dependency: &Item| path(dependency).is_some_and(|folder| !is_crate(&folder));
    let missing: Vec<String> =
        dependencies.iter().filter(|(_, item)| is_missing(item)).map(|(name, _)| name.to_owned()).collect();
    missing.iter().for_each(|name| drop(dependencies.remove(name)));
    missing
}

/// Removes the features that switch on a removed crate, and their names from the other features.
fn remove_features(features: &mut dyn TableLike, removed: &[String]) {
    let uses = |feature: &Item, name: &str| {
        feature.as_array().is_some_and(|parts| parts.iter().any(|part| part.as_str() == Some(name)))
    };
    let is_gone = |feature: &Item| removed.iter().any(|name| uses(feature, &format!("dep:{name}")));
    let gone: Vec<String> =
        features.iter().filter(|(_, feature)| is_gone(feature)).map(|(name, _)| name.to_owned()).collect();
    gone.iter().for_each(|name| drop(features.remove(name)));
    for (_, feature) in features.iter_mut() {
        if let Some(parts) = feature.as_array_mut() {
            parts.retain(|part| !gone.iter().any(|name| part.as_str() == Some(name)));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::root_manifest;

    #[test]
    fn crates_features_and_tests_that_are_not_handed_out_leave_no_trace() {
        let whole = "[workspace]\nmembers = [\"a\", \"b\"]\n\n[features]\ndefault = [\"b\", \"window\"]\nb = [\"dep:b\"]\n\
                     window = []\n\n[[test]]\nname = \"x\"\n\n[[test]]\nname = \"y\"\n\n[dependencies]\na = { path = \"a\" }\n\
                     b = { path = \"b\", optional = true }\n\n[profile.dev.package]\na = { opt-level = 3 }\nb = { opt-level = 2 }\n";
        let text = root_manifest(whole, |file| ["a/Cargo.toml", "tests/x.rs"].contains(&file)).unwrap();
        let expected = "[workspace]\nmembers = [\"a\"]\n\n[features]\ndefault = [ \"window\"]\nwindow = []\n\n[[test]]\nname = \"x\"\n\n\
                        [dependencies]\na = { path = \"a\" }\n\n[profile.dev.package]\na = { opt-level = 3 }\n";
        assert_eq!(text, expected);
    }
}
