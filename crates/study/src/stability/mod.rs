//! Stiff and extreme cases: the outcome of each integrator beside the prediction of theory, or the robustness that is promised.
//!
//! Each file of `families` adds cases. `runner` runs them with a time limit and catches panics, so that every case becomes a row;
//! `output` writes the rows.

mod case;
mod families;
mod forecast;
mod initial_state;
mod march;
mod output;
mod page;
mod results;
mod runner;
mod scene_text;
mod theory;

pub use case::{CaseRow, Outcome};
pub use families::maps::{Cell, Map};
pub use output::write;
pub use results::{Counts, Results};
pub use runner::Progress;

use std::path::Path;
use std::time::Instant;

use crate::machine::Machine;
use families::maps;

/// Runs all cases, or a few of each family if `quick`. `progress` receives every row; the results name the commit of the checkout
/// around `sources`.
pub fn study(quick: bool, sources: &Path, progress: Progress) -> Results {
    let (start, machine) = (Instant::now(), Machine::this(sources));
    let found = maps::Found::default();
    let rows = runner::rows(families::cases(quick, &found), progress);
    let mut maps = found.lock().map(|maps| maps.clone()).unwrap_or_default();
    maps.sort_by_key(|map| scene_text::DYNAMIC.iter().position(|name| *name == map.integrator));
    Results::new(quick, machine, start.elapsed().as_secs_f64(), rows, maps)
}
