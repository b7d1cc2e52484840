//! Finding, reading and checking scene files.

use std::path::{Path, PathBuf};

use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::check::check;
use crate::{Scene, SceneError};

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

/// Reads and checks the text of a scene file; errors name the file `path`.
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

/// The line of a field such as `time.dt` or `traction[0].on`; the line of its table if the field is missing.
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
