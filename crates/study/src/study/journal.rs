//! The rows of a study on disk, one a line: a killed run goes on after the last of them, and shards are joined from them.

use std::collections::BTreeMap;
use std::fmt;
use std::fs::{self, File, OpenOptions};
use std::hash::{DefaultHasher, Hash, Hasher};
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::sync::Mutex;

use serde::de::DeserializeOwned;
use serde::{Deserialize, Serialize};

use super::{Case, Found, Trouble};
use crate::machine::Machine;

/// The K-th of N parts of a study.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Shard {
    /// From 1 to `of`.
    pub number: usize,
    /// Number of shards.
    pub of: usize,
}

impl Shard {
    /// The whole study.
    pub const WHOLE: Self = Self { number: 1, of: 1 };

    /// Returns true if a case belongs to the shard. Neighbouring cases, which often take as long, belong to different ones.
    pub(super) fn has(self, case: usize) -> bool {
        case % self.of == self.number - 1
    }
}

impl fmt::Display for Shard {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "{}/{}", self.number, self.of)
    }
}

impl FromStr for Shard {
    type Err = String;

    fn from_str(text: &str) -> Result<Self, String> {
        let numbers = text.split_once('/').and_then(|(k, n)| Some((k.parse().ok()?, n.parse().ok()?)));
        match numbers {
            Some((number, of)) if (1..=of).contains(&number) => Ok(Self { number, of }),
            _ => Err("give K/N, the K-th of N shards, such as 2/8".to_owned()),
        }
    }
}

/// The file in the folder of a study.
const NAME: &str = "rows.jsonl";

/// The first line: which study it is.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Heading {
    arguments: Vec<String>,
    /// A hash of the names of all cases.
    cases: u64,
    shard: Shard,
    pub machine: Machine,
}

impl Heading {
    pub fn new<Row>(arguments: Vec<String>, cases: &[Case<Row>], machine: Machine, shard: Shard) -> Self {
        let mut hash = DefaultHasher::new();
        cases.iter().for_each(|case| case.name.hash(&mut hash));
        Self { arguments, cases: hash.finish(), shard, machine }
    }

    /// Returns true if the rows below another heading belong to the same study by the same program.
    fn fits(&self, other: &Self) -> bool {
        let key = |of: &Self| (of.arguments.clone(), of.cases, of.machine.commit.clone(), of.machine.flags.clone());
        key(self) == key(other)
    }
}

/// A row with its place among the cases and its time, s.
#[derive(Serialize, Deserialize)]
pub(super) struct Line<Row> {
    pub case: usize,
    pub seconds: f64,
    pub row: Row,
}

/// Rows in the order of their lines.
pub(super) fn found<Row>(lines: Vec<Line<Row>>, machine: Machine) -> Found<Row> {
    let seconds = lines.iter().map(|line| line.seconds).sum();
    Found { rows: lines.into_iter().map(|line| line.row).collect(), machine, seconds }
}

/// The file of a running study.
pub(super) struct Journal {
    path: PathBuf,
    file: Mutex<File>,
}

impl Journal {
    /// Opens the journal of a folder, and returns the rows that are in it.
    pub fn open<Row: DeserializeOwned>(out: &Path, heading: &Heading) -> Result<(Self, Vec<Line<Row>>), Trouble> {
        let path = out.join(NAME);
        let unwritable = |error| Trouble::Unusable(format!("{}: cannot be written: {error}", path.display()));
        let (lines, length) = match fs::read_to_string(&path) {
            Ok(text) => rows_of(&text, &path, |found| heading.fits(found) && heading.shard == found.shard)?,
            Err(error) if error.kind() == io::ErrorKind::NotFound => (Vec::new(), 0),
            Err(error) => return Err(unwritable(error)),
        };
        let mut file = OpenOptions::new().create(true).append(true).open(&path).map_err(unwritable)?;
        // A line that a killed run has left unfinished.
        file.set_len(length).map_err(unwritable)?;
        if length == 0 {
            writeln!(file, "{}", serde_json::json!(heading)).map_err(unwritable)?;
        }
        Ok((Self { path, file: Mutex::new(file) }, lines))
    }

    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Adds a row.
    pub fn add<Row: Serialize>(&self, line: &Line<Row>) -> io::Result<()> {
        let text = serde_json::to_string(line)? + "\n";
        let mut file =
            self.file.lock().map_err(|_| io::Error::other("another case panicked while it wrote its row"))?;
        file.write_all(text.as_bytes())
    }

    /// Removes the file of a study that is complete.
    pub fn remove(self) -> io::Result<()> {
        fs::remove_file(self.path)
    }
}

/// The rows below a heading, and the length of the text up to the last whole line.
fn rows_of<Row: DeserializeOwned>(
    text: &str,
    path: &Path,
    fits: impl Fn(&Heading) -> bool,
) -> Result<(Vec<Line<Row>>, u64), Trouble> {
    let whole = text.rfind('\n').map_or("", |end| &text[..=end]);
    let Some((first, rest)) = whole.split_once('\n') else { return Ok((Vec::new(), 0)) };
    if !serde_json::from_str(first).is_ok_and(|heading| fits(&heading)) {
        let problem = "has rows of another study, shard or commit; remove it, or name another folder";
        return Err(Trouble::Unusable(format!("{}: {problem}", path.display())));
    }
    let row = |(number, line): (usize, &str)| {
        serde_json::from_str(line).map_err(|error| {
            let place = format!("{}, line {}", path.display(), number + 2);
            Trouble::Unusable(format!("{place}: {error}; remove the line, and its case runs again"))
        })
    };
    Ok((rest.lines().enumerate().map(row).collect::<Result<_, _>>()?, whole.len() as u64))
}

/// The arguments of the program that made the rows in the folder of a shard.
pub fn arguments(folder: &Path) -> Result<Vec<String>, String> {
    let path = folder.join(NAME);
    let text = fs::read_to_string(&path)
        .map_err(|error| format!("{}: {error}; name the folders that `--shard` has written", path.display()))?;
    let heading: Result<Heading, _> = serde_json::from_str(text.lines().next().unwrap_or_default());
    heading.map(|heading| heading.arguments).map_err(|error| format!("{}, line 1: {error}", path.display()))
}

/// The rows of several folders, and copies of the states beside them.
pub(super) fn joined<Row: DeserializeOwned>(
    folders: &[PathBuf],
    heading: &Heading,
    cases: &[Case<Row>],
    out: &Path,
) -> Result<Found<Row>, Trouble> {
    let (mut lines, mut machines) = (BTreeMap::new(), Vec::<Machine>::new());
    for folder in folders {
        let path = folder.join(NAME);
        let unreadable = |error| Trouble::Unusable(format!("{}: {error}", path.display()));
        let text = fs::read_to_string(&path).map_err(unreadable)?;
        lines.extend(rows_of(&text, &path, |found| heading.fits(found))?.0.into_iter().map(|line| (line.case, line)));
        machines.extend(text.lines().next().and_then(|line| Some(serde_json::from_str::<Heading>(line).ok()?.machine)));
        copy_states(folder, out).map_err(unreadable)?;
    }
    let missing: Vec<_> = (0..cases.len()).filter(|case| !lines.contains_key(case)).collect();
    if let Some(&first) = missing.first() {
        let (count, all, name) = (missing.len(), cases.len(), &cases[first].name);
        let problem = format!("{count} of {all} cases have no row, the first `{name}`; run their shards to the end");
        return Err(Trouble::Incomplete(problem));
    }
    let mut machine = machines.first().unwrap_or(&heading.machine).clone();
    let mut processors: Vec<_> = machines.into_iter().map(|machine| machine.cpu).collect();
    processors.sort();
    processors.dedup();
    machine.cpu = processors.join(" and ");
    Ok(found(lines.into_values().collect(), machine))
}

/// Copies the files of `states`, which rows name.
fn copy_states(from: &Path, to: &Path) -> io::Result<()> {
    let (from, to) = (from.join("states"), to.join("states"));
    if !from.is_dir() {
        return Ok(());
    }
    fs::create_dir_all(&to)?;
    for entry in fs::read_dir(from)? {
        let entry = entry?;
        fs::copy(entry.path(), to.join(entry.file_name()))?;
    }
    Ok(())
}
