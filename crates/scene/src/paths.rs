//! The files that a scene names.

use std::path::{Path, PathBuf};

use toml::{Table, Value};

use crate::Scene;

/// The path of a mesh file: beside the scene, else in `data`. An absolute path is used as it is.
pub(crate) fn find(scene: &Scene, data: &Path, file: &Path) -> PathBuf {
    let folder = scene.path.parent().unwrap_or(Path::new(""));
    find_from(folder, data, file)
}

fn find_from(folder: &Path, data: &Path, file: &Path) -> PathBuf {
    let beside = folder.join(file);
    if beside.exists() { beside } else { data.join(file) }
}

/// Rewrites the paths in the tables of a scene so that a scene file in `folder` finds the same files. A path that is found from there too
/// stays as it is, the others become absolute.
pub(crate) fn move_paths(tables: &mut Table, scene: &Scene, data: &Path, folder: &Path) {
    let moved = |file: &str| {
        let (old, new) = (find(scene, data, file.as_ref()), find_from(folder, data, file.as_ref()));
        let old = std::fs::canonicalize(&old).or_else(|_| std::path::absolute(&old)).unwrap_or(old);
        let is_same = std::fs::canonicalize(new).is_ok_and(|new| new == old);
        if is_same { file.to_owned() } else { old.to_string_lossy().into_owned() }
    };
    for value in paths(tables) {
        if let Value::String(file) = value {
            *file = moved(file);
        }
    }
}

/// The values of all keys that name files.
fn paths(tables: &mut Table) -> Vec<&mut Value> {
    let mut found = Vec::new();
    for (name, value) in tables.iter_mut() {
        match (name.as_str(), value) {
            ("mesh", Value::Table(mesh)) => mesh.iter_mut().for_each(|(key, value)| match (key.as_str(), value) {
                ("file" | "display", value) => found.push(value),
                ("files", Value::Array(files)) => found.extend(files.iter_mut()),
                ("surface" | "picture", Value::Table(source)) => found.extend(source.get_mut("file")),
                _ => {}
            }),
            ("initial_velocity", Value::Array(entries)) => found.extend(of_each(entries, "per_node")),
            ("fibres", Value::Array(entries)) => found.extend(of_each(entries, "per_element")),
            _ => {}
        }
    }
    found
}

/// The values of a key in a list of tables.
fn of_each<'a>(entries: &'a mut [Value], key: &'a str) -> impl Iterator<Item = &'a mut Value> {
    entries.iter_mut().filter_map(move |entry| entry.as_table_mut()?.get_mut(key))
}
