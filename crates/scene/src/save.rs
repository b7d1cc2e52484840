//! Writing scene files: the text of a scene, which reads back to the same scene.

use std::path::{Path, PathBuf};

use thiserror::Error;
use toml::{Table, Value};

use crate::check::missing_tables;
use crate::load::{MOST_BYTES, parse};
use crate::paths::move_paths;
use crate::{Scene, SceneError};
use fem_mesh::MeshError;

/// Longest line of a list, characters.
const LINE: usize = 120;

/// The order of the tables in a file.
const ORDER: [&str; 31] = [
    "about",
    "pipeline",
    "mesh",
    "material",
    "materials",
    "plasticity",
    "fibres",
    "mass",
    "gravity",
    "body_force",
    "traction",
    "force",
    "central_gravity",
    "viscosity",
    "springs",
    "fixed",
    "prescribed",
    "initial_velocity",
    "planes",
    "contact",
    "time",
    "damping",
    "static",
    "newmark",
    "generalized_alpha",
    "iterations",
    "newton",
    "solver",
    "energy",
    "drag",
    "batch",
];

/// A scene that was not saved.
#[derive(Debug, Error)]
#[allow(missing_docs)] // the messages are the documentation of the fields
pub enum SaveError {
    /// The path cannot be that of a new scene file.
    #[error("{}: {problem}", file.display())]
    Path { file: PathBuf, problem: String },
    /// The text does not read back to the scene.
    #[error("the scene was not saved, as its file would not be read: {0}")]
    Unreadable(SceneError),
    /// The file cannot be written.
    #[error(transparent)]
    Unwritable(#[from] MeshError),
}

impl Scene {
    /// The text of a scene file with the same tables, those that the scene does not use left out. Comments of the file that the scene was
    /// read from are not kept.
    pub fn to_text(&self) -> String {
        text(self, &self.tables())
    }

    /// The keys and values as they are now: with the integrator, time step and number of steps in use.
    fn tables(&self) -> Table {
        let mut tables = self.source.clone();
        missing_tables(self).for_each(|name| drop(tables.remove(name)));
        tables.retain(|_, value| !value.as_array().is_some_and(Vec::is_empty));
        if let Some(Value::Table(time)) = tables.get_mut("time") {
            time.insert("integrator".to_owned(), Value::from(self.time.integrator.name()));
            set(time, "dt", self.time.dt.map(Value::Float));
            set(time, "steps", self.time.steps.map(|steps| Value::Integer(steps as i64)));
        }
        tables
    }
}

/// Writes a new scene file, which finds the files that the scene names. `data` is the folder of scenes and meshes. A file that is there
/// already is not replaced.
pub fn save(scene: &Scene, path: &Path, data: &Path) -> Result<(), SaveError> {
    let refuse = |problem: &str| Err(SaveError::Path { file: path.to_owned(), problem: problem.to_owned() });
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    if path.extension().is_none_or(|extension| extension != "toml") {
        return refuse("is no name of a scene file; let it end in .toml");
    }
    if !folder.is_dir() {
        return refuse("lies in a folder that does not exist; make the folder first, or give another");
    }
    if path.exists() {
        return refuse("exists already and is not replaced; give another name");
    }
    let mut tables = scene.tables();
    move_paths(&mut tables, scene, data, folder);
    let text = text(scene, &tables);
    if text.len() as u64 > MOST_BYTES {
        return refuse("would have more than 1 MiB, the most that is read; choose fewer nodes and faces");
    }
    parse(&text, path).map_err(SaveError::Unreadable)?;
    fem_mesh::write::save_bytes(path, text.as_bytes())?;
    Ok(())
}

fn set(table: &mut Table, key: &str, value: Option<Value>) {
    match value {
        Some(value) => drop(table.insert(key.to_owned(), value)),
        None => drop(table.remove(key)),
    }
}

fn text(scene: &Scene, tables: &Table) -> String {
    let mut text = format!(
        "# Saved from the scene {}. Nodes and faces that are listed have the numbers of its mesh.\n",
        scene.name.escape_debug()
    );
    let mut names: Vec<&String> = tables.keys().collect();
    names.sort_by_key(|name| ORDER.iter().position(|known| known == name).unwrap_or(ORDER.len()));
    let is_table =
        |value: &Value| value.is_table() || value.as_array().is_some_and(|list| list.iter().all(Value::is_table));
    for name in names.iter().filter(|name| !is_table(&tables[name.as_str()])) {
        text += &line(name, &tables[name.as_str()]);
    }
    for name in names {
        match &tables[name.as_str()] {
            Value::Table(table) => add_table(&mut text, &format!("[{name}]"), table),
            Value::Array(entries) if entries.iter().all(Value::is_table) => {
                let tables = entries.iter().filter_map(Value::as_table);
                tables.for_each(|table| add_table(&mut text, &format!("[[{name}]]"), table));
            }
            _ => {}
        }
    }
    text
}

fn add_table(text: &mut String, head: &str, table: &Table) {
    let lists = ["nodes", "faces", "edges"].into_iter();
    let count = lists.filter_map(|key| Some((key, table.get(key)?.as_array()?.len()))).find(|(_, count)| *count > 2);
    let comment = count.map_or(String::new(), |(key, count)| format!(" # {count} {key}"));
    *text += &format!("\n{head}{comment}\n");
    for (key, value) in table {
        *text += &line(key, value);
    }
}

/// `key = value`; a long list in several lines.
fn line(key: &str, value: &Value) -> String {
    let short = format!("{key} = {value}\n");
    let Value::Array(entries) = value else { return short };
    if short.len() <= LINE {
        return short;
    }
    let (mut lines, mut last) = (format!("{key} = [\n"), String::new());
    for entry in entries {
        let entry = entry.to_string();
        if !last.is_empty() && last.len() + entry.len() > LINE {
            lines += &format!("    {}\n", last.trim_end());
            last.clear();
        }
        last += &format!("{entry}, ");
    }
    lines + &format!("    {}\n]\n", last.trim_end())
}
