//! Stiff and extreme cases: the outcome of each integrator beside the prediction of theory, or the robustness that is promised.
//!
//! Each file of `families` adds cases.

mod case;
mod families;
mod initial_state;
mod march;
mod page;
mod results;
mod setup;
mod theory;

pub use case::{CaseRow, Cell, Map, Outcome};
pub use results::{Counts, Results};

use std::fs;
use std::io;
use std::path::Path;
use std::thread;

use crate::study::{self, Finished, Found, Study};

/// The study of stiff and extreme cases.
pub struct Stability {
    /// One or a few cases of each family.
    pub quick: bool,
}

impl Study for Stability {
    type Row = CaseRow;

    fn arguments(&self) -> Vec<String> {
        ["stability"].into_iter().chain(self.quick.then_some("--quick")).map(str::to_owned).collect()
    }

    fn cases(&self) -> Vec<study::Case<'_, CaseRow>> {
        families::cases(self.quick).into_iter().map(case::Case::guarded).collect()
    }

    fn threads(&self) -> usize {
        thread::available_parallelism().map_or(1, usize::from)
    }

    fn remark(&self, row: &CaseRow) -> Option<String> {
        let CaseRow { family, case, parameters, integrator, material, expected, outcome, note, .. } = row;
        let case = format!("{family}: {case} ({parameters}), {integrator}, {material}");
        (!row.pass).then(|| format!("{case}: {outcome}, expected: {expected}; {note}"))
    }

    /// Writes `stability.csv`, `stability.json`, `stability.html`, and a picture of each map.
    fn finish(&self, found: Found<CaseRow>, out: &Path) -> io::Result<Finished> {
        let results = Results::new(self.quick, found);
        fs::write(out.join("stability.csv"), results.csv()?)?;
        fs::write(out.join("stability.json"), serde_json::to_string_pretty(&results)? + "\n")?;
        for map in &results.maps {
            let picture = page::picture(map).standalone();
            fs::write(out.join(format!("stability-{}.svg", map.integrator.name())), picture)?;
        }
        fs::write(out.join("stability.html"), page::render(&results))?;
        Ok(results.finished(out))
    }
}
