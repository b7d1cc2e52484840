//! Finding, reading and checking scene files.

use std::fs::File;
use std::io::Read;
use std::path::{Path, PathBuf};

use fem_model::Refusal;
use toml::de::{DeTable, DeValue};
use toml::{Spanned, Table, Value};

use crate::check::check;
use crate::overrides::Override;
use crate::tables::Text;
use crate::{Scene, SceneError};

/// Largest scene file, bytes: the tree of a text takes up to a hundred times its memory, so at most 128 MiB.
pub(crate) const MOST_BYTES: u64 = 1 << 20;

/// Reads and checks a scene.
///
/// `name` is the path of a `.toml` file, or the name of one in the folder `scenes` of `data`.
pub fn load(name: &str, data: &Path) -> Result<Scene, SceneError> {
    load_with(name, data, &[])
}

/// The same with some keys overridden. The values of all keys are checked as those of a file; an error names the override that
/// causes it.
pub fn load_with(name: &str, data: &Path, overrides: &[Override]) -> Result<Scene, SceneError> {
    let path = find(name, data)?;
    let unreadable = |reason: String| SceneError::Unreadable { file: path.clone(), reason };
    let mut bytes = Vec::new();
    let opened = File::open(&path).and_then(|file| file.take(MOST_BYTES + 1).read_to_end(&mut bytes));
    opened.map_err(|error| unreadable(error.to_string()))?;
    if bytes.len() as u64 > MOST_BYTES {
        let problem = format!(
            "the file has more than {MOST_BYTES} bytes; name many nodes by a set of the mesh, and give their velocities in a file of their own"
        );
        return Err(SceneError::Line { file: path, line: 1, problem });
    }
    let text = String::from_utf8(bytes).map_err(|_| unreadable("it is not UTF-8 text".to_owned()))?;
    parse_with(text.trim_start_matches('\u{feff}'), &path, overrides)
}

/// Reads and checks the text of a scene file; errors name the file `path`.
pub fn parse(text: &str, path: &Path) -> Result<Scene, SceneError> {
    parse_with(text, path, &[])
}

fn parse_with(text: &str, path: &Path, overrides: &[Override]) -> Result<Scene, SceneError> {
    let mut source: Table = text.parse().map_err(|error| of_line(text, path, &error))?;
    apply(overrides, &mut source)?;
    let mut scene = match overrides {
        [] => toml::from_str(text).map_err(|error| wrong_header(text, path, &source, &error))?,
        _ => overridden(text, path, &source, overrides)?,
    };
    scene.name = path.file_stem().unwrap_or_default().to_string_lossy().into_owned();
    scene.path = path.to_owned();
    scene.text = Text(text.into());
    scene.source = source;
    scene.overrides = overrides.to_vec();
    scene.check()?;
    Ok(scene)
}

fn apply(overrides: &[Override], source: &mut Table) -> Result<(), SceneError> {
    overrides.iter().try_for_each(|change| {
        let refuse = |problem| SceneError::Override { option: change.to_string(), problem };
        change.apply(source).map_err(refuse)
    })
}

/// Reads a scene from its tables after the overrides.
fn overridden(text: &str, path: &Path, source: &Table, overrides: &[Override]) -> Result<Scene, SceneError> {
    let merged = source.to_string();
    toml::from_str(&merged).map_err(|error: toml::de::Error| {
        if let Err(own) = toml::from_str::<Scene>(text)
            && own.message() == error.message()
        {
            return of_line(text, path, &own);
        }
        // The file without the overrides does not have this problem.
        let field = error.span().map_or(String::new(), |span| field_before(&merged, span.end));
        let cause = overrides.iter().rev().find(|change| change.concerns(&field)).or(overrides.last());
        let option = cause.map_or(String::new(), Override::to_string);
        SceneError::Override { option, problem: problem_of(&error) }
    })
}

impl Scene {
    /// The scene with some keys changed, such as by a user of its window. The values of all keys are checked as those of a file. Another
    /// integrator, time step or number of steps than that of the file stays.
    pub fn changed(&self, changes: &[Override]) -> Result<Self, SceneError> {
        let mut source = self.source.clone();
        apply(changes, &mut source)?;
        let text = self.source.to_string();
        let mut scene = overridden(&text, &self.path, &source, changes)?;
        let is_changed = |field: &str| changes.iter().any(|change| change.concerns(field));
        if !is_changed("time.dt") {
            scene.time.dt = self.time.dt;
        }
        if !is_changed("time.integrator") && scene.time.integrator != self.time.integrator {
            scene.time.integrator = self.time.integrator;
            scene.remove_unused_tables();
        }
        if !is_changed("time.steps") {
            scene.time.steps = self.time.steps;
        }
        scene.name.clone_from(&self.name);
        scene.path.clone_from(&self.path);
        scene.text.clone_from(&self.text);
        scene.source = source;
        let lasts = |earlier: &&Override| !changes.iter().any(|change| change.replaces(earlier));
        scene.overrides = self.overrides.iter().filter(lasts).chain(changes).cloned().collect();
        scene.check()?;
        Ok(scene)
    }

    /// Checks the tables again after a change, such as another integrator. Returns the first problem.
    pub fn check(&self) -> Result<(), SceneError> {
        check(self).map_err(|refusal| self.refused(refusal))
    }

    /// The error of a refused value: of the override that sets it, or else of its line.
    pub fn refused(&self, Refusal { field, problem }: Refusal) -> SceneError {
        self.refuse(&field, &problem)
    }

    /// The error of a field, such as `time.integrator`. `problem` continues the sentence that begins with the field.
    pub fn refuse(&self, field: &str, problem: &str) -> SceneError {
        let problem = format!("{field} {problem}");
        match self.overrides.iter().rev().find(|change| change.concerns(field)) {
            Some(change) => SceneError::Override { option: change.to_string(), problem },
            None => SceneError::Line { file: self.path.clone(), line: line_of(&self.text.0, field), problem },
        }
    }
}

fn of_line(text: &str, path: &Path, error: &toml::de::Error) -> SceneError {
    let line = error.span().map_or(1, |span| line_at(text, span.start));
    SceneError::Line { file: path.to_owned(), line, problem: problem_of(error) }
}

/// The error of a table that is written as a list, or the other way round, where nothing else is wrong; or the error itself.
fn wrong_header(text: &str, path: &Path, source: &Table, error: &toml::de::Error) -> SceneError {
    for (key, value) in source {
        let (problem, right) = match value {
            Value::Array(tables) if tables.len() > 1 && tables.iter().all(Value::is_table) => {
                (format!("[[{key}]] is written more than once; keep one, as [{key}]"), tables[0].clone())
            }
            Value::Array(tables) if tables.len() == 1 && tables[0].is_table() => {
                (format!("[[{key}]] is not a list; write [{key}]"), tables[0].clone())
            }
            Value::Table(_) => {
                (format!("[{key}] is one of a list; write [[{key}]]"), Value::Array(vec![value.clone()]))
            }
            _ => continue,
        };
        let mut changed = source.clone();
        changed.insert(key.clone(), right);
        if changed.try_into::<Scene>().is_ok() {
            return SceneError::Line { file: path.to_owned(), line: line_of(text, key), problem };
        }
    }
    of_line(text, path, error)
}

fn problem_of(error: &toml::de::Error) -> String {
    let message = error.message().trim_end();
    let remedy = match message.split(' ').next() {
        Some("missing") => "add it",
        Some("unknown") => "correct this name",
        Some("duplicate") => "remove one of the two",
        Some("invalid") => "correct this value",
        _ => "correct this line",
    };
    format!("{message}; {remedy}")
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

/// The last field whose key begins before a position of the text, such as `traction.0.on`.
fn field_before(text: &str, position: usize) -> String {
    fn visit(value: &DeValue<'_>, path: &str, position: usize, last: &mut (usize, String)) {
        let below = |key: &str| if path.is_empty() { key.to_owned() } else { format!("{path}.{key}") };
        match value {
            DeValue::Table(table) => {
                for (key, value) in table {
                    let (start, path) = (key.span().start, below(key.get_ref()));
                    if start < position && start >= last.0 {
                        *last = (start, path.clone());
                    }
                    visit(value.get_ref(), &path, position, last);
                }
            }
            DeValue::Array(entries) => {
                for (number, value) in entries.iter().enumerate() {
                    visit(value.get_ref(), &below(&number.to_string()), position, last);
                }
            }
            _ => {}
        }
    }
    let mut last = (0, String::new());
    if let Ok(root) = DeTable::parse(text) {
        visit(&DeValue::Table(root.into_inner()), "", position, &mut last);
    }
    last.1
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
