//! A case of the study, its outcome, and the row that it becomes.

use std::fmt;
use std::time::{Duration, Instant};

use fem_model::Integrator;
use serde::{Deserialize, Serialize};

use crate::study::{self, Deadline, Stopped, guarded};

/// The outcome of a case.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// All values stay finite, J > 0, at least 95 % of the steps converge, and the margin is within its bound.
    Survives,
    /// The body returned to its undeformed shape.
    Recovers,
    /// J > 0 in all elements and the body is at rest, in an equilibrium other than the undeformed shape.
    Untangles,
    /// The case was refused before its first step by an error that names the element or key.
    Refused,
    /// A typed error that names the step ended the run.
    Explodes,
    /// All values are finite and J > 0, but the body is far too stiff: a known defect of linear tetrahedra.
    Locks,
    /// All values are finite, but the margin exceeds its bound.
    Deviates,
    /// The run returned an inverted element.
    Inverts,
    /// Fewer than 95 % of the steps converged.
    Unconverged,
    /// The run returned a NaN or an infinity.
    NotFinite,
    /// A scene that should be refused was accepted.
    Accepted,
    /// The case panicked.
    Panics,
    /// The case exceeded its time.
    Hangs,
}

impl Outcome {
    /// The word in tables.
    pub fn name(self) -> &'static str {
        match self {
            Self::Survives => "survives",
            Self::Recovers => "recovers",
            Self::Untangles => "untangles",
            Self::Refused => "refused",
            Self::Explodes => "explodes",
            Self::Locks => "locks",
            Self::Deviates => "deviates",
            Self::Inverts => "inverts",
            Self::Unconverged => "unconverged",
            Self::NotFinite => "not_finite",
            Self::Accepted => "accepted",
            Self::Panics => "panics",
            Self::Hangs => "hangs",
        }
    }

    /// Returns true if the outcome is the expected one. `Recovers` satisfies `Untangles`.
    pub fn satisfies(self, expected: Self) -> bool {
        self == expected || (self, expected) == (Self::Recovers, Self::Untangles)
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// The result of a case.
#[derive(Clone, Debug)]
pub struct Finding {
    /// The outcome.
    pub outcome: Outcome,
    /// The deciding figure, defined by [`Case::margin_is`]; `None` without a measurement.
    pub margin: Option<f64>,
    /// Further figures, or the message of an error.
    pub note: String,
    /// The map that the case has drawn.
    pub map: Option<Map>,
}

impl Finding {
    /// A finding with a margin.
    pub fn new(outcome: Outcome, margin: f64, note: impl Into<String>) -> Self {
        Self { margin: Some(margin), ..Self::plain(outcome, note) }
    }

    /// A finding without a margin.
    pub fn plain(outcome: Outcome, note: impl Into<String>) -> Self {
        Self { outcome, margin: None, note: note.into(), map: None }
    }

    /// `Survives` if the margin, relative to its bound, is at most 1; NaN is not.
    pub fn within(part: f64, note: impl Into<String>) -> Self {
        Self::new(if part <= 1.0 { Outcome::Survives } else { Outcome::Deviates }, part, note)
    }
}

/// Runs a case until its deadline.
pub type Work = Box<dyn FnOnce(Deadline) -> Finding + Send>;

/// A margin: the smallest det F.
pub const SMALLEST_J: &str = "smallest J at the end of a step; must be above 0";

/// A case and its expected outcome.
pub struct Case {
    /// The family of the case.
    pub family: &'static str,
    /// The extreme property of the case.
    pub case: String,
    /// Its parameters.
    pub parameters: String,
    /// Name of the integrator, as in scenes; `-` without one.
    pub integrator: String,
    /// Name of the material, as in scenes; `-` without one.
    pub material: String,
    /// The expected outcome.
    pub expected: Outcome,
    /// Definition and bound of the margin.
    pub margin_is: &'static str,
    /// Seed of its random numbers.
    pub seed: Option<u64>,
    /// Runs the case.
    pub work: Work,
}

/// Time after which a case ends itself between two steps.
const TIME_LIMIT: Duration = Duration::from_secs(60);

impl Case {
    /// The case for the runner of all studies. A panic or a hang becomes its row.
    pub fn guarded(self) -> study::Case<'static, CaseRow> {
        let Self { family, case, parameters, integrator, material, expected, margin_is, seed, work } = self;
        let seeded = seed.map_or(String::new(), |seed| format!(", seed {seed}"));
        let name = format!("{family}: {case} ({parameters}), {integrator}, {material}{seeded}");
        study::Case::new(name, move || {
            let start = Instant::now();
            let Finding { outcome, margin, note, map } = guarded(TIME_LIMIT, work).unwrap_or_else(Finding::from);
            CaseRow {
                family: family.to_owned(),
                case,
                parameters,
                integrator,
                material,
                expected,
                outcome,
                margin: margin.filter(|margin| margin.is_finite()),
                margin_is: margin_is.to_owned(),
                seed,
                pass: outcome.satisfies(expected),
                // A row is one line.
                note: note.split_whitespace().collect::<Vec<_>>().join(" "),
                seconds: start.elapsed().as_secs_f64(),
                map,
            }
        })
    }
}

impl From<Stopped> for Finding {
    fn from(stopped: Stopped) -> Self {
        match stopped {
            Stopped::Panicked(message) => Self::plain(Outcome::Panics, message),
            Stopped::Hangs => Self::plain(Outcome::Hangs, "a step does not end"),
        }
    }
}

/// All pairs of one integrator.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Map {
    /// Name of the integrator.
    pub integrator: Integrator,
    /// E dt² at the stability limit ω_max dt, Pa s². For integrators without a stable step: where the highest mode grows enough
    /// within the run. `None` for unconditionally stable integrators.
    pub limit: Option<f64>,
    /// Steps of the longest run.
    pub most_steps: usize,
    /// Cells by rows, from the softest.
    pub cells: Vec<Cell>,
}

/// One pair.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Cell {
    /// Young's modulus, Pa.
    pub young: f64,
    /// Time step, s.
    pub dt: f64,
    /// ω_max dt
    pub z: f64,
    /// Steps of the run.
    pub steps: usize,
    /// The prediction of theory.
    pub expected: Outcome,
    /// The outcome.
    pub outcome: Outcome,
    /// The note of the run.
    pub note: String,
}

/// A case with its result.
#[derive(Clone, Debug, Serialize, Deserialize)]
#[allow(missing_docs)] // as in `Case`
pub struct CaseRow {
    pub family: String,
    pub case: String,
    pub parameters: String,
    pub integrator: String,
    pub material: String,
    pub expected: Outcome,
    pub outcome: Outcome,
    pub margin: Option<f64>,
    pub margin_is: String,
    pub seed: Option<u64>,
    pub pass: bool,
    pub note: String,
    pub seconds: f64,
    /// The map of a case that draws one; tables have it beside the rows.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub map: Option<Map>,
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_becomes_a_finding_with_its_message() {
        let found =
            guarded(TIME_LIMIT, |_| -> Finding { panic!("element {} is gone", 7) }).unwrap_or_else(Finding::from);
        assert_eq!((found.outcome, found.note.as_str()), (Outcome::Panics, "element 7 is gone"));
    }

    #[test]
    fn nan_is_not_within_a_bound() {
        assert_eq!(Finding::within(f64::NAN, "").outcome, Outcome::Deviates);
    }
}
