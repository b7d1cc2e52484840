//! The short stability study ends as expected, and as in the stored table docs/reference/stability-quick.csv.
//!
//! After an intended change, write the table anew:
//! `FEM_WRITE_REFERENCE=1 cargo test --release -p fem-study --test stability`, and give the reason in the commit.

use std::collections::BTreeMap;
use std::path::Path;

use fem_study::stability::study;

/// Largest change of a margin, relative to its bound or to itself, whichever is larger.
const SAME: f64 = 0.01;

#[test]
fn every_case_ends_as_expected_and_as_stored() {
    let table = study(true, Path::new("."), &|_, _| {});
    let wrong: Vec<_> = table.rows.iter().filter(|row| !row.pass).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");

    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/reference/stability-quick.csv");
    if std::env::var_os("FEM_WRITE_REFERENCE").is_some() {
        std::fs::write(&path, table.csv().unwrap()).unwrap();
        return;
    }
    let stored = std::fs::read_to_string(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let (stored, found) = (rows(&stored), rows(&table.csv().unwrap()));
    let only_in = |rows: &BTreeMap<String, Row>, others: &BTreeMap<String, Row>| {
        rows.keys().filter(|name| !others.contains_key(*name)).cloned().collect::<Vec<_>>()
    };
    let (new, lost) = (only_in(&found, &stored), only_in(&stored, &found));
    assert!(
        new.is_empty() && lost.is_empty(),
        "write the stored table anew; new cases: {new:#?}, lost ones: {lost:#?}"
    );
    let changes = found.iter().filter_map(|(name, row)| Some(format!("{name}: {}", change(&stored[name], row)?)));
    let changes: Vec<String> = changes.collect();
    assert!(changes.is_empty(), "\n{}\n", changes.join("\n"));
}

/// The outcome of a case.
#[derive(Debug, PartialEq)]
struct Row {
    expected: String,
    outcome: String,
    margin: Option<f64>,
    /// The margin is the same on every machine.
    is_steady: bool,
}

/// Outcomes by the names of the cases.
fn rows(text: &str) -> BTreeMap<String, Row> {
    let mut reader = csv::Reader::from_reader(text.as_bytes());
    let head = reader.headers().unwrap().clone();
    let column = |name: &str| head.iter().position(|found| found == name).unwrap_or_else(|| panic!("no column {name}"));
    let names = ["family", "case", "parameters", "integrator", "material", "seed"].map(column);
    let [expected, outcome, margin, margin_is] = ["expected", "outcome", "margin", "margin_is"].map(column);
    let row = |fields: csv::StringRecord| {
        // Round-off decides which equilibrium an untangled or a buckled body reaches.
        let is_one_of_many = &fields[expected] == "untangles" || fields[names[1]].starts_with("compressed to 2 %");
        let is_steady = !fields[margin_is].contains("round-off") && !is_one_of_many;
        let row = Row {
            outcome: if &fields[expected] == "untangles" { "-".to_owned() } else { fields[outcome].to_owned() },
            expected: fields[expected].to_owned(),
            margin: fields[margin].parse().ok(),
            is_steady,
        };
        (names.map(|name| &fields[name]).join(", "), row)
    };
    reader.records().map(|fields| row(fields.unwrap())).collect()
}

fn change(stored: &Row, found: &Row) -> Option<String> {
    let same_end = (&stored.expected, &stored.outcome) == (&found.expected, &found.outcome);
    let same_margin = match (stored.margin, found.margin) {
        (Some(a), Some(b)) => (a - b).abs() <= SAME * a.abs().max(1.0),
        (a, b) => a == b,
    };
    let is_same = same_end && (same_margin || !found.is_steady);
    (!is_same).then(|| format!("{stored:?} is now {found:?}"))
}

#[test]
fn a_margin_that_changes_by_two_percent_is_reported() {
    let row = |margin| Row {
        expected: "survives".to_owned(),
        outcome: "survives".to_owned(),
        margin: Some(margin),
        is_steady: true,
    };
    assert!(change(&row(2.0), &row(2.05)).is_some() && change(&row(2.0), &row(2.01)).is_none());
    assert!(change(&row(2.0), &Row { margin: None, ..row(2.0) }).is_some());
}
