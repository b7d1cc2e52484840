//! From a name to a checked scene.

use std::path::{Path, PathBuf};

use serde::de::{Deserialize, Deserializer, Error, Visitor};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use super::{DragVertex, Scene, SceneError, check::check};

/// Reads and checks a scene.
///
/// `name` is the path of a `.toml` file, or the name of one in the folder `scenes` of `data`.
pub fn load(name: &str, data: &Path) -> Result<Scene, SceneError> {
    let path = find(name, data)?;
    let unreadable = |reason: String| SceneError::Unreadable { file: path.clone(), reason };
    let bytes = std::fs::read(&path).map_err(|error| unreadable(error.to_string()))?;
    let text = String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8 text".to_owned()))?;
    parse(text.trim_start_matches('\u{feff}'), &path)
}

/// Reads and checks the text of a scene file; `path` is the file that errors name.
pub fn parse(text: &str, path: &Path) -> Result<Scene, SceneError> {
    let mut scene: Scene = toml::from_str(text).map_err(|error| SceneError::Line {
        file: path.to_owned(),
        line: error.span().map_or(1, |span| line_at(text, span.start)),
        problem: format!("{}; correct it as the scene format in README.md says", error.message().trim_end()),
    })?;
    scene.name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    scene.path = path.to_owned();
    check(&scene).map_err(|(field, problem)| SceneError::Line {
        file: path.to_owned(),
        line: line_of(text, field),
        problem: format!("{field} {problem}"),
    })?;
    Ok(scene)
}

/// Names of the scenes in `data/scenes`, sorted.
pub fn names(data: &Path) -> Vec<String> {
    let entries = std::fs::read_dir(data.join("scenes")).into_iter().flatten().flatten();
    let is_scene = |path: &PathBuf| path.extension().is_some_and(|extension| extension == "toml");
    let stem = |path: PathBuf| path.file_stem().map(|stem| stem.to_string_lossy().into_owned());
    let mut names: Vec<_> = entries.map(|entry| entry.path()).filter(is_scene).filter_map(stem).collect();
    names.sort();
    names
}

fn find(name: &str, data: &Path) -> Result<PathBuf, SceneError> {
    let looks_like_a_path = name.ends_with(".toml") || name.contains(['/', '\\']);
    let path = if looks_like_a_path { PathBuf::from(name) } else { data.join("scenes").join(format!("{name}.toml")) };
    if looks_like_a_path || path.is_file() {
        return Ok(path);
    }
    let known = match names(data) {
        names if names.is_empty() => format!("there are none in {}", data.join("scenes").display()),
        names => format!("choose one of {}", names.join(", ")),
    };
    Err(SceneError::Unknown { name: name.to_owned(), known })
}

fn line_at(text: &str, position: usize) -> usize {
    1 + text.bytes().take(position).filter(|&byte| byte == b'\n').count()
}

/// The line of a field such as `time.dt`; where the file leaves it out, that of the table that it belongs to.
pub(super) fn line_of(text: &str, field: &str) -> usize {
    let Ok(root) = DeTable::parse(text) else { return 1 };
    let mut table: &DeTable<'_> = root.get_ref();
    let mut position = 0;
    for key in field.split('.') {
        let Some((name, value)) = table.iter().find(|(name, _)| name.get_ref() == key) else { break };
        position = Spanned::span(name).start;
        match value.get_ref() {
            DeValue::Table(inner) => table = inner,
            _ => break,
        }
    }
    line_at(text, position)
}

/// Reads `vertex = "highest"` or `vertex = 12`.
pub(super) struct DragVertexVisitor;

impl Visitor<'_> for DragVertexVisitor {
    type Value = DragVertex;

    fn expecting(&self, formatter: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        formatter.write_str("\"highest\" or the index of a vertex")
    }

    fn visit_str<E: Error>(self, text: &str) -> Result<DragVertex, E> {
        if text == "highest" {
            Ok(DragVertex::Highest)
        } else {
            Err(E::invalid_value(serde::de::Unexpected::Str(text), &self))
        }
    }

    fn visit_i64<E: Error>(self, index: i64) -> Result<DragVertex, E> {
        let valid = usize::try_from(index).map(DragVertex::Index);
        valid.map_err(|_| E::invalid_value(serde::de::Unexpected::Signed(index), &self))
    }
}

/// Reads a vector. Serde's own arrays would let further numbers pass unnoticed.
pub(super) fn three_numbers<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[f64; 3], D::Error> {
    let numbers = Vec::<f64>::deserialize(deserializer)?;
    <[f64; 3]>::try_from(numbers).map_err(|numbers| D::Error::invalid_length(numbers.len(), &"three numbers"))
}
