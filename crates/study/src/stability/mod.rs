//! Stiff and extreme cases: what each integrator does with them, beside what theory or robustness promises.
//!
//! Each file of this folder adds a family of cases; `run` tries them one by one under a wall-clock guard and catches panics, so
//! that whatever a case does becomes a row; `output` writes the rows.

mod bodies;
mod case;
mod frames;
mod invalid;
mod lasting;
mod limits;
mod map;
mod march;
mod matrix;
mod mixed;
mod output;
mod page;
mod poisson;
mod recovery;
mod run;
mod scene_text;
mod single;
mod slivers;
mod start;
mod strains;
mod theory;

pub use case::{Case, Clock, Finding, Outcome, Row};
pub use map::{Cell, Map};
pub use output::{Counts, Table, write};
pub use run::Progress;

use std::path::Path;
use std::time::Instant;

use crate::machine::Machine;

/// Tries everything that an adversary would; `quick` one or a few of each kind. `progress` hears of every row; `sources` is a
/// folder of the checkout whose commit the table names.
pub fn study(quick: bool, sources: &Path, progress: Progress) -> Table {
    let (start, machine) = (Instant::now(), Machine::this(sources));
    let maps = map::Found::default();
    let rows = run::rows(cases(quick, &maps), progress);
    let mut maps = maps.lock().map(|maps| maps.clone()).unwrap_or_default();
    maps.sort_by_key(|map| scene_text::DYNAMIC.iter().position(|name| *name == map.integrator));
    Table::new(quick, machine, start.elapsed().as_secs_f64(), rows, maps)
}

fn cases(quick: bool, maps: &map::Found) -> Vec<Case> {
    let mut cases = Vec::new();
    matrix::add(&mut cases, quick);
    map::add(&mut cases, quick, maps);
    limits::add(&mut cases, quick);
    poisson::add(&mut cases, quick);
    frames::add(&mut cases, quick);
    slivers::add(&mut cases, quick);
    single::add(&mut cases, quick);
    mixed::add(&mut cases, quick);
    strains::add(&mut cases, quick);
    recovery::add(&mut cases, quick);
    bodies::add(&mut cases, quick);
    lasting::add(&mut cases, quick);
    invalid::add(&mut cases);
    cases
}
