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
        line: line_of(text, &field),
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

/// The line of a field such as `time.dt` or `traction[0].on`; where the file leaves it out, that of the table that it
/// belongs to.
pub(super) fn line_of(text: &str, field: &str) -> usize {
    let Ok(root) = DeTable::parse(text) else { return 1 };
    let mut table: &DeTable<'_> = root.get_ref();
    let mut position = 0;
    for key in field.split('.') {
        let (key, number) = numbered(key);
        let Some((name, value)) = table.iter().find(|(name, _)| name.get_ref() == key) else { break };
        position = Spanned::span(name).start;
        let Some(value) = entry(value, number) else { break };
        if number.is_some() {
            position = value.span().start;
        }
        match value.get_ref() {
            DeValue::Table(inner) => table = inner,
            _ => break,
        }
    }
    line_at(text, position)
}

/// `("traction", Some(0))` of `traction[0]`.
fn numbered(key: &str) -> (&str, Option<usize>) {
    let parts = key.strip_suffix(']').and_then(|key| key.split_once('['));
    parts.map_or((key, None), |(name, number)| (name, number.parse().ok()))
}

fn entry<'a, 'b>(value: &'a Spanned<DeValue<'b>>, number: Option<usize>) -> Option<&'a Spanned<DeValue<'b>>> {
    match (value.get_ref(), number) {
        (DeValue::Array(entries), Some(number)) => entries.get(number),
        (_, Some(_)) => None,
        (_, None) => Some(value),
    }
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
    exactly(Vec::deserialize(deserializer)?, "three numbers")
}

/// Reads a vector that a table may leave out.
pub(super) fn three_numbers_if_any<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Option<[f64; 3]>, D::Error> {
    three_numbers(deserializer).map(Some)
}

/// Reads the two ends of a spring.
pub(super) fn two_nodes<'de, D: Deserializer<'de>>(deserializer: D) -> Result<[usize; 2], D::Error> {
    exactly(Vec::deserialize(deserializer)?, "two nodes")
}

/// Reads triangles that a table may leave out.
pub(super) fn triangles_if_any<'de, D: Deserializer<'de>>(
    deserializer: D,
) -> Result<Option<Vec<[usize; 3]>>, D::Error> {
    let faces = Vec::<Vec<usize>>::deserialize(deserializer)?;
    faces.into_iter().map(|nodes| exactly(nodes, "three nodes")).collect::<Result<_, _>>().map(Some)
}

fn exactly<T, const N: usize, E: Error>(list: Vec<T>, expected: &str) -> Result<[T; N], E> {
    <[T; N]>::try_from(list).map_err(|list| E::invalid_length(list.len(), &expected))
}
