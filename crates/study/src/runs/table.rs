//! Rows of runs as CSV and as JSON.

use serde_json::{Map, Value as Json};

use super::row::{COLUMNS, CellValue, Row};
use crate::csv_table::csv_text;
use crate::machine::Machine;

/// All rows; the first line names the columns, and the last columns of every row describe the machine.
pub fn csv(rows: &[Row], machine: &Machine) -> Result<String, csv::Error> {
    let machine = machine_cells(machine);
    let names: Vec<&str> = COLUMNS.iter().map(|column| column.0).chain(machine.iter().map(|cell| cell.0)).collect();
    let cells = |row: &Row| {
        let own = COLUMNS.iter().map(|(_, value)| written(&value(row)));
        own.chain(machine.iter().map(|cell| cell.1.clone())).collect::<Vec<_>>()
    };
    csv_text(&names, rows.iter().map(cells))
}

/// One object for each row; a missing value is null.
pub fn json(rows: &[Row]) -> Json {
    let object = |row: &Row| {
        let entries = COLUMNS.iter().map(|(name, value)| ((*name).to_owned(), to_json(value(row))));
        Json::Object(entries.collect::<Map<_, _>>())
    };
    Json::Array(rows.iter().map(object).collect())
}

fn machine_cells(machine: &Machine) -> [(&'static str, String); 5] {
    let Machine { cpu, threads, flags, commit, date, .. } = machine;
    [
        ("threads", threads.to_string()),
        ("commit", commit.clone()),
        ("cpu", cpu.clone()),
        ("flags", flags.clone()),
        ("date", date.clone()),
    ]
}

fn to_json(value: CellValue) -> Json {
    match value {
        CellValue::Text(text) => Json::from(text),
        CellValue::Count(count) => count.map_or(Json::Null, Json::from),
        // JSON has no infinity and no NaN: they become null.
        CellValue::Number(number) => number.map_or(Json::Null, Json::from),
    }
}

fn written(value: &CellValue) -> String {
    match value {
        CellValue::Text(text) => text.clone(),
        CellValue::Count(count) => count.map_or(String::new(), |count| count.to_string()),
        CellValue::Number(number) => {
            number.filter(|number| number.is_finite()).map_or(String::new(), |x| format!("{x:e}"))
        }
    }
}

#[cfg(test)]
mod tests {
    use fem_model::Integrator;

    use super::*;
    use crate::runs::row::Configuration;

    #[test]
    fn every_line_has_every_column_and_missing_values_are_empty() {
        let text = String::new;
        let config = Configuration {
            id: text(),
            scene: text(),
            group: text(),
            method: text(),
            pipeline: text(),
            mesh_hash: text(),
            nodes: 4,
            elements: 1,
            young: None,
            poisson: None,
            integrator: Integrator::Static,
            projection: text(),
            solver: text(),
            dt: 1.0,
            steps: 1,
            tolerance: None,
            max_iterations: None,
            precision: text(),
        };
        let row = Row::new(config, text(), text());
        let machine = Machine::this(std::path::Path::new("."));
        let table = csv(std::slice::from_ref(&row), &machine).unwrap();
        let mut reader = csv::Reader::from_reader(table.as_bytes());
        let column = reader.headers().unwrap().iter().position(|name| name == "err_time_L2").unwrap();
        let cells = reader.records().next().unwrap().unwrap();
        assert_eq!((cells.len(), &cells[column]), (reader.headers().unwrap().len(), ""));
        assert_eq!(json(&[row])[0]["err_time_L2"], Json::Null);
    }
}
