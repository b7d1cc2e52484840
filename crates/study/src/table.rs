//! Rows as CSV (RFC 4180) and as JSON.

use serde_json::{Map, Value as Json};

use super::machine::Machine;
use super::row::{Row, Value};

/// All rows, with the machine's columns in each; the first line names the columns.
pub fn csv(rows: &[Row], machine: &Machine) -> String {
    let names =
        Row::default().cells().into_iter().map(|(name, _)| name).chain(machine_cells(machine).map(|cell| cell.0));
    let mut text = line(names.map(str::to_owned));
    for row in rows {
        let cells = row.cells().into_iter().map(|(_, value)| written(&value));
        text.push_str(&line(cells.chain(machine_cells(machine).map(|cell| cell.1))));
    }
    text
}

/// Any table of text.
pub fn csv_of(head: &[&str], rows: &[Vec<String>]) -> String {
    let head = line(head.iter().map(|&name| name.to_owned()));
    head + &rows.iter().map(|row| line(row.iter().cloned())).collect::<String>()
}

/// One object for each row; what is missing is null.
pub fn json(rows: &[Row]) -> Json {
    let object = |row: &Row| {
        let entries = row.cells().into_iter().map(|(name, value)| (name.to_owned(), to_json(value)));
        Json::Object(entries.collect::<Map<_, _>>())
    };
    Json::Array(rows.iter().map(object).collect())
}

fn machine_cells(machine: &Machine) -> impl Iterator<Item = (&'static str, String)> {
    let Machine { cpu, threads, flags, commit, date, .. } = machine;
    let cells = [
        ("threads", threads.to_string()),
        ("commit", commit.clone()),
        ("cpu", cpu.clone()),
        ("flags", flags.clone()),
        ("date", date.clone()),
    ];
    cells.into_iter()
}

fn to_json(value: Value) -> Json {
    match value {
        Value::Text(text) => Json::from(text),
        Value::Count(count) => count.map_or(Json::Null, Json::from),
        // A number that is not finite has no JSON form and becomes null.
        Value::Number(number) => number.map_or(Json::Null, Json::from),
    }
}

fn written(value: &Value) -> String {
    match value {
        Value::Text(text) => text.clone(),
        Value::Count(count) => count.map_or(String::new(), |count| count.to_string()),
        Value::Number(number) => number.filter(|number| number.is_finite()).map_or(String::new(), |x| format!("{x:e}")),
    }
}

fn line(cells: impl Iterator<Item = String>) -> String {
    let cells: Vec<String> = cells.map(|cell| quoted(&cell)).collect();
    cells.join(",") + "\n"
}

/// In quotes where it holds a comma, a quote or the end of a line.
fn quoted(cell: &str) -> String {
    if cell.contains([',', '"', '\n', '\r']) { format!("\"{}\"", cell.replace('"', "\"\"")) } else { cell.to_owned() }
}

/// Cells of a line of CSV that holds no line end in a cell.
pub fn split(line: &str) -> Vec<String> {
    let (mut cells, mut cell, mut is_quoted) = (Vec::new(), String::new(), false);
    let mut characters = line.chars().peekable();
    while let Some(character) = characters.next() {
        match character {
            '"' if is_quoted && characters.next_if_eq(&'"').is_some() => cell.push('"'),
            '"' => is_quoted = !is_quoted,
            ',' if !is_quoted => cells.push(std::mem::take(&mut cell)),
            other => cell.push(other),
        }
    }
    cells.push(cell);
    cells
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn commas_and_quotes_are_quoted_and_read_back() {
        let cells = ["a,b", "say \"no\"", "plain", ""];
        let text = csv_of(&cells, &[]);
        assert_eq!(text, "\"a,b\",\"say \"\"no\"\"\",plain,\n");
        assert_eq!(split(text.trim_end()), cells);
    }

    #[test]
    fn every_line_has_every_column_and_what_is_missing_is_empty() {
        let machine = Machine::this(std::path::Path::new("."));
        let text = csv(&[Row::default()], &machine);
        let lines: Vec<Vec<String>> = text.lines().map(split).collect();
        assert_eq!(lines[0].len(), lines[1].len());
        let column = lines[0].iter().position(|name| name == "err_time_L2").unwrap();
        assert_eq!(lines[1][column], "");
        assert_eq!(json(&[Row::default()])[0]["err_time_L2"], Json::Null);
    }
}
