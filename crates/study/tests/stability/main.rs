//! The short stability study ends as expected, and as in the stored table docs/reference/stability-quick.csv.
//!
//! After an intended change, write the table anew:
//! `FEM_WRITE_REFERENCE=1 cargo test --release -p fem-study --test stability`, and give the reason in the commit.

use std::collections::BTreeMap;
use std::path::Path;

use fem_study::stability::{CaseRow, Outcome, Stability};
use fem_study::study;

/// Largest change of a margin, relative to its bound or to itself, whichever is larger.
const SAME: f64 = 0.01;

const HEAD: [&str; 9] =
    ["family", "case", "parameters", "integrator", "material", "seed", "expected", "outcome", "margin"];

#[test]
fn every_case_ends_as_expected_and_as_stored() {
    let table = study::rows(&Stability { quick: true });
    let wrong: Vec<_> = table.rows.iter().filter(|row| !row.pass).collect();
    assert!(wrong.is_empty(), "{wrong:#?}");

    let rows: Vec<[String; 9]> = table.rows.iter().map(determined).collect();
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/reference/stability-quick.csv");
    if std::env::var_os("FEM_WRITE_REFERENCE").is_some() {
        let mut writer = csv::Writer::from_path(&path).unwrap();
        writer.write_record(HEAD).unwrap();
        rows.iter().for_each(|row| writer.write_record(row).unwrap());
        writer.flush().unwrap();
        return;
    }
    let mut reader = csv::Reader::from_path(&path).unwrap_or_else(|error| panic!("{}: {error}", path.display()));
    let stored = reader.deserialize::<[String; 9]>().map(|row| row.unwrap());
    let by_name = |row: [String; 9]| (row[..6].join(", "), row);
    let (mut lost, mut changes) = (stored.map(by_name).collect::<BTreeMap<_, _>>(), Vec::new());
    for (name, row) in rows.into_iter().map(by_name) {
        match lost.remove(&name) {
            Some(before) if is_same(&before, &row) => {}
            before => {
                changes.push(format!("{name}: {:?} is now {:?}", before.map(|row| row[6..].join(", ")), &row[6..]))
            }
        }
    }
    assert!(changes.is_empty() && lost.is_empty(), "\n{}\nlost: {:#?}\n", changes.join("\n"), lost.keys());
}

/// Columns of a case that are equal on every processor. Round-off decides which equilibrium an untangled or a buckled body reaches, and
/// how small an error is that should be zero.
fn determined(row: &CaseRow) -> [String; 9] {
    let is_one_of_many = row.expected == Outcome::Untangles || row.case.starts_with("compressed to 2 %");
    let is_steady = !row.margin_is.contains("round-off") && !is_one_of_many;
    let outcome = if row.expected == Outcome::Untangles { "" } else { row.outcome.name() };
    let margin = row.margin.filter(|_| is_steady).map_or(String::new(), |margin| format!("{margin:.3e}"));
    let seed = row.seed.map_or(String::new(), |seed| seed.to_string());
    let [family, expected] = [&row.family, row.expected.name()].map(str::to_owned);
    let [case, parameters] = [row.case.clone(), row.parameters.clone()];
    let [integrator, material] = [row.integrator.clone(), row.material.clone()];
    [family, case, parameters, integrator, material, seed, expected, outcome.to_owned(), margin]
}

fn is_same(before: &[String; 9], now: &[String; 9]) -> bool {
    let same_margin = match [before, now].map(|row| row[8].parse::<f64>()) {
        [Ok(a), Ok(b)] => (a - b).abs() <= SAME * a.abs().max(1.0),
        _ => before[8] == now[8],
    };
    before[..8] == now[..8] && same_margin
}

#[test]
fn a_margin_that_changes_by_two_percent_is_reported() {
    let row = |margin: &str| HEAD.map(|name| if name == "margin" { margin } else { name }.to_owned());
    assert!(!is_same(&row("2e0"), &row("2.05e0")) && is_same(&row("2e0"), &row("2.01e0")));
    assert!(!is_same(&row("2e0"), &row("")));
}
