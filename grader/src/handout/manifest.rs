//! The manifests of the students' repository.

use std::collections::BTreeSet;

use proc_macro2::{TokenStream, TokenTree};
use toml_edit::{DocumentMut, Item, TableLike, TomlError};

/// A package that is not named in any source: it is a dependency for its features only.
const FEATURES: &str = "fem-features";

/// A package's manifest with only those dependencies that its `sources` name.
pub fn with_used_dependencies<'a>(
    manifest: &str,
    sources: impl IntoIterator<Item = &'a str>,
) -> Result<String, String> {
    let mut manifest: DocumentMut = manifest.parse().map_err(|error: TomlError| error.to_string())?;
    let mut used = BTreeSet::new();
    for source in sources {
        add_crates(source.parse().map_err(|error| format!("{error}"))?, &mut used);
    }
    if let Some(dependencies) = manifest["dependencies"].as_table_mut() {
        dependencies.retain(|name, _| name == FEATURES || used.contains(&name.replace('-', "_")));
        // The comment above the list is about the whole list.
        dependencies.decor_mut().set_prefix("\n");
    }
    Ok(manifest.to_string())
}

/// Adds the words that begin a path: `a` of `a::b`, but not `b` of `a::b::c`.
fn add_crates(source: TokenStream, found: &mut BTreeSet<String>) {
    let tokens: Vec<_> = source.into_iter().collect();
    let is_colon = |token: Option<&TokenTree>| matches!(token, Some(TokenTree::Punct(sign)) if sign.as_char() == ':');
    for (i, token) in tokens.iter().enumerate() {
        match token {
            TokenTree::Group(group) => add_crates(group.stream(), found),
            TokenTree::Ident(word) if is_colon(tokens.get(i + 1)) && is_colon(tokens.get(i + 2)) => {
                let is_inside = i >= 2 && is_colon(tokens.get(i - 1)) && is_colon(tokens.get(i - 2));
                found.extend((!is_inside).then(|| word.to_string()));
            }
            _ => {}
        }
    }
}

/// The manifest of the program, `crates/cli`, without the crates that are not handed out, and without the features that need them. Returns
/// these as the root's features name them, too; `has` tells whether a file is handed out.
pub fn program_manifest(manifest: &str, has: impl Fn(&str) -> bool) -> Result<(String, Vec<String>), String> {
    let mut manifest: DocumentMut = manifest.parse().map_err(|error: TomlError| error.to_string())?;
    let is_crate = |folder: &str| has(&format!("{}/Cargo.toml", folder.replacen("..", "crates", 1)));
    let mut gone = Vec::new();
    if let Some(dependencies) = manifest.get_mut("dependencies").and_then(Item::as_table_like_mut) {
        gone = remove_crates(dependencies, is_crate);
    }
    let mut removed = Vec::new();
    if let Some(features) = manifest.get_mut("features").and_then(Item::as_table_like_mut) {
        removed = remove_features(features, |part| is_of_crates(part, &gone));
    }
    Ok((manifest.to_string(), removed.iter().map(|feature| format!("fem-cli/{feature}")).collect()))
}

/// The root's `Cargo.toml` without the crates, features and tests that are not handed out, nor the features that switch on one that is
/// `gone` from another package; `has` tells whether a file is handed out.
pub fn root_manifest(manifest: &str, has: impl Fn(&str) -> bool, gone: &[String]) -> Result<String, String> {
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
        remove_features(features, |part| gone.iter().any(|name| part == name) || is_of_crates(part, &removed));
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

/// The root's `Cargo.toml` without the profiles of packages that the lock file does not have, of which cargo would warn.
pub fn with_locked_profiles(manifest: &str, lock: &str) -> Result<String, String> {
    let mut manifest: DocumentMut = manifest.parse().map_err(|error: TomlError| error.to_string())?;
    for profile in ["dev", "release"] {
        let packages = manifest.get_mut("profile").and_then(|all| all.get_mut(profile)?.get_mut("package"));
        if let Some(packages) = packages.and_then(Item::as_table_like_mut) {
            let is_locked = |name: &str| name == "*" || lock.contains(&format!("\nname = \"{name}\"\n"));
            let gone: Vec<String> =
                packages.iter().map(|(name, _)| name.to_owned()).filter(|name| !is_locked(name)).collect();
            gone.iter().for_each(|name| drop(packages.remove(name)));
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

/// Returns true if a part of a feature switches on one of these crates, or a feature of it.
fn is_of_crates(part: &str, crates: &[String]) -> bool {
    let name = part.strip_prefix("dep:").or(part.split_once('/').map(|(name, _)| name));
    crates.iter().any(|removed| name == Some(removed))
}

/// Removes the features with a part that `is_gone`, and their names from the other features. Returns these names.
fn remove_features(features: &mut dyn TableLike, is_gone: impl Fn(&str) -> bool) -> Vec<String> {
    let has_gone = |feature: &Item| {
        let mut parts = feature.as_array().into_iter().flatten().filter_map(|part| part.as_str());
        parts.any(&is_gone)
    };
    let gone: Vec<String> =
        features.iter().filter(|(_, feature)| has_gone(feature)).map(|(name, _)| name.to_owned()).collect();
    gone.iter().for_each(|name| drop(features.remove(name)));
    for (_, feature) in features.iter_mut() {
        if let Some(parts) = feature.as_array_mut() {
            parts.retain(|part| !gone.iter().any(|name| part.as_str() == Some(name)));
        }
    }
    gone
}

#[cfg(test)]
mod tests {
    use super::{program_manifest, root_manifest, with_locked_profiles, with_used_dependencies};

    #[test]
    fn dependencies_that_no_source_names_are_removed() {
        let whole = "[dependencies]\nfem-features = \"0\"\nserde.workspace = true\nsome-zip = \"1\"\nzip = \"2\"\n\n[dev-dependencies]\nx = \"3\"\n";
        let source = "use some_zip::Archive;\nfn f() { let zip = a.iter().zip(b); crate::zip::g(\"serde::\") }";
        let text = with_used_dependencies(whole, [source]).unwrap();
        assert_eq!(text, "\n[dependencies]\nfem-features = \"0\"\nsome-zip = \"1\"\n\n[dev-dependencies]\nx = \"3\"\n");
    }

    #[test]
    fn crates_features_and_tests_that_are_not_handed_out_leave_no_trace() {
        let whole = "[workspace]\nmembers = [\"a\", \"b\"]\n\n[features]\ndefault = [\"b\", \"c\", \"window\"]\nb = [\"dep:b\"]\nc = [\"b/fast\"]\n\
                     window = []\n\n[[test]]\nname = \"x\"\n\n[[test]]\nname = \"y\"\n\n[dependencies]\na = { path = \"a\" }\n\
                     b = { path = \"b\", optional = true }\n";
        let text = root_manifest(whole, |file| ["a/Cargo.toml", "tests/x.rs"].contains(&file), &[]).unwrap();
        let expected = "[workspace]\nmembers = [\"a\"]\n\n[features]\ndefault = [ \"window\"]\nwindow = []\n\n[[test]]\nname = \"x\"\n\n\
                        [dependencies]\na = { path = \"a\" }\n";
        assert_eq!(text, expected);
    }

    #[test]
    fn features_of_the_program_that_are_not_handed_out_leave_no_trace_in_the_root() {
        let program = "[features]\nengine = [\"dep:engine\"]\nwindow = []\n\n[dependencies]\nengine = { path = \"../engine\", optional = true }\n\
                       mesh = { path = \"../mesh\" }\n";
        let has = |file: &str| file == "crates/mesh/Cargo.toml";
        let (text, gone) = program_manifest(program, has).unwrap();
        assert_eq!(text, "[features]\nwindow = []\n\n[dependencies]\nmesh = { path = \"../mesh\" }\n");
        assert_eq!(gone, ["fem-cli/engine"]);
        let root = "[workspace]\nmembers = []\n\n[features]\ndefault = [\"engine\", \"window\"]\nengine = [\"fem-cli/engine\"]\nwindow = [\"fem-cli/window\"]\n";
        let expected =
            "[workspace]\nmembers = []\n\n[features]\ndefault = [ \"window\"]\nwindow = [\"fem-cli/window\"]\n";
        assert_eq!(root_manifest(root, has, &gone).unwrap(), expected);
    }

    #[test]
    fn profiles_of_packages_that_are_not_locked_are_removed() {
        let whole = "[profile.dev.package.\"*\"]\ndebug = false\n\n[profile.release.package]\na = { opt-level = 3 }\nb = { opt-level = 0 }\n";
        let text = with_locked_profiles(whole, "\n[[package]]\nname = \"a\"\nversion = \"1\"\n").unwrap();
        assert_eq!(text, whole.replace("b = { opt-level = 0 }\n", ""));
    }
}
