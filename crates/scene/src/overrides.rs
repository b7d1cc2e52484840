//! Keys of a scene that are overridden without a change of the file: `TABLE.KEY=VALUE`.

use std::fmt;
use std::str::FromStr;

use serde::Serialize;
use toml::{Table, Value};

/// An override of one key of a scene, such as `time.dt=0.01`, `traction.0.pressure=5` or `mesh.file=meshes/a.node`.
#[derive(Clone, Debug, PartialEq)]
pub struct Override {
    /// The keys from the root to the value; entries of arrays by their number, counted from 0.
    path: Vec<String>,
    /// `None` removes the key.
    value: Option<Value>,
    text: String,
}

impl FromStr for Override {
    type Err = String;

    /// Reads `TABLE.KEY=VALUE`. The value is TOML; a text that is no TOML value, such as a bare word or a path, is a string.
    fn from_str(text: &str) -> Result<Self, String> {
        let remedy = || "give TABLE.KEY=VALUE, such as time.dt=0.01 or traction.0.pressure=5".to_owned();
        let (path, value) = text.split_once('=').ok_or_else(remedy)?;
        let path: Vec<String> = path.split('.').map(|key| key.trim().to_owned()).collect();
        if path.iter().any(String::is_empty) {
            return Err(remedy());
        }
        Ok(Self { path, value: Some(value_of(value.trim())), text: text.to_owned() })
    }
}

impl fmt::Display for Override {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.text)
    }
}

impl Override {
    /// An override that sets a key, such as `time.dt`, to a number, a text, a list of them, or a table.
    pub fn to(path: &str, value: impl Serialize) -> Self {
        // Maps with other keys than texts alone have no TOML.
        let value = Value::try_from(value).expect("numbers, texts, lists and tables have TOML values");
        let text = format!("{path}={value}");
        Self { path: path.split('.').map(str::to_owned).collect(), value: Some(value), text }
    }

    /// An override that removes a key, such as `fixed` or `traction.0`; one that is not there stays away.
    pub fn without(path: &str) -> Self {
        Self { path: path.split('.').map(str::to_owned).collect(), value: None, text: format!("{path} removed") }
    }

    /// Sets the value in the tables of a scene; tables that are missing are added, and so is the entry after the last of an array.
    pub(crate) fn apply(&self, tables: &mut Table) -> Result<(), String> {
        let mut root = Value::Table(std::mem::take(tables));
        let outcome = self.set(&mut root, 0);
        if let Value::Table(changed) = root {
            *tables = changed;
        }
        outcome
    }

    /// Sets the value below `place`, at which the first `depth` keys end.
    fn set(&self, place: &mut Value, depth: usize) -> Result<(), String> {
        let Some(key) = self.path.get(depth) else {
            if let Some(value) = &self.value {
                *place = value.clone();
            }
            return Ok(());
        };
        if self.value.is_none() && depth + 1 == self.path.len() {
            remove(place, key);
            return Ok(());
        }
        let here = || self.path[..depth].join(".");
        match place {
            Value::Table(table) if self.value.is_none() && !table.contains_key(key) => Ok(()),
            Value::Table(table) => {
                let entry = table.entry(key.as_str()).or_insert_with(|| self.missing(depth + 1));
                self.set(entry, depth + 1)
            }
            Value::Array(entries)
                if self.value.is_none() && key.parse().is_ok_and(|number: usize| number >= entries.len()) =>
            {
                Ok(())
            }
            Value::Array(entries) => {
                let Ok(number) = key.parse::<usize>() else {
                    return Err(format!("{} is an array; give the number of an entry in place of `{key}`", here()));
                };
                if number == entries.len() {
                    entries.push(self.missing(depth + 1));
                }
                let count = entries.len();
                let entry = entries.get_mut(number);
                let entry =
                    entry.ok_or_else(|| format!("{} has {count} entries; give a number up to {count}", here()))?;
                self.set(entry, depth + 1)
            }
            _ => Err(format!("{} is a value without keys; remove `.{key}`", here())),
        }
    }

    /// A new value at which the first `depth` keys end: an empty array or table if keys follow.
    fn missing(&self, depth: usize) -> Value {
        match self.path.get(depth) {
            Some(key) if key.parse::<usize>().is_ok() => Value::Array(Vec::new()),
            Some(_) => Value::Table(Table::new()),
            None => self.value.clone().unwrap_or(Value::Array(Vec::new())),
        }
    }

    /// Returns true if it replaces an earlier override: it sets the same key, or a table that contains it. The places of an array move
    /// when an entry is removed, so that earlier overrides of entries keep their effect.
    pub(crate) fn replaces(&self, earlier: &Self) -> bool {
        self.value.is_some() && earlier.path.starts_with(&self.path)
    }

    /// Returns true if it sets a field such as `time.dt` or `traction[0].on`, a part of it, or a table that contains it.
    pub(crate) fn concerns(&self, field: &str) -> bool {
        let field = field.replace('[', ".").replace(']', "");
        self.path.iter().zip(field.split('.')).all(|(key, of_field)| key == of_field)
    }
}

/// Removes a key of a table or an entry of an array, if it is there.
fn remove(place: &mut Value, key: &str) {
    match place {
        Value::Table(table) => drop(table.remove(key)),
        Value::Array(entries) => {
            if let Some(number) = key.parse().ok().filter(|number| *number < entries.len()) {
                entries.remove(number);
            }
        }
        _ => {}
    }
}

/// A TOML value, or else a string.
fn value_of(text: &str) -> Value {
    let table = format!("value = {text}").parse::<Table>().ok().filter(|table| table.len() == 1);
    table.and_then(|mut table| table.remove("value")).unwrap_or_else(|| Value::String(text.to_owned()))
}
