//! Files with a vector in each line.

use std::path::Path;

use nalgebra::Vector3;

/// Words for messages about a file.
pub(super) struct Rows {
    /// The things of which each has a line, such as `nodes`.
    pub each: &'static str,
    /// A line, such as `x,y,z in m/s`.
    pub form: &'static str,
}

/// A line of a file.
pub(super) struct Row {
    /// Its number, from 1.
    pub line: usize,
    pub vector: Vector3<f64>,
}

/// Reads `count` vectors: three numbers a line, after a line of titles if there is one. The error continues a sentence that
/// begins with the field.
pub(super) fn vectors(path: &Path, count: usize, Rows { each, form }: &Rows) -> Result<Vec<Row>, String> {
    let file = path.display();
    let text = std::fs::read_to_string(path)
        .map_err(|error| format!("is {file}, which cannot be read: {error}; check the path"))?;
    let lines = text.lines().enumerate().filter(|(_, line)| !line.trim().is_empty());
    let has_titles = |line: &str| line.split(',').all(|word| word.trim().parse::<f64>().is_err());
    let mut rows = Vec::new();
    for (number, line) in lines.filter(|(number, line)| *number > 0 || !has_titles(line)) {
        let at = || format!("is {file}, whose line {}", number + 1);
        let numbers: Result<Vec<f64>, _> = line.split(',').map(|word| word.trim().parse()).collect();
        let numbers = numbers.map_err(|_| format!("{} is no list of numbers; write {form}", at()))?;
        let [x, y, z] = numbers[..] else {
            return Err(format!("{} has {} numbers; write {form}", at(), numbers.len()));
        };
        if !numbers.iter().all(|number| number.abs() <= LARGEST) {
            return Err(format!("{} has a number that is not finite or too large; give at most {LARGEST:e}", at()));
        }
        rows.push(Row { line: number + 1, vector: Vector3::new(x, y, z) });
    }
    if rows.len() == count {
        return Ok(rows);
    }
    Err(format!("is {file}, which has {} lines; the mesh has {count} {each}, give a line for each", rows.len()))
}

/// Largest component: squares of it do not overflow.
const LARGEST: f64 = 1e60;
