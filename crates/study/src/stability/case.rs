//! A case and the row that it becomes.

use std::fmt;
use std::time::Instant;

use serde::Serialize;

/// What a case ends in.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Outcome {
    /// Everything stays finite, J > 0, at least 95 % of the steps converge; what else the case measures is within its bound.
    Survives,
    /// Back at the shape of rest.
    Recovers,
    /// Upright everywhere (J > 0) and at rest, but not as it was made: wound or folded in another balance.
    Untangles,
    /// Not begun: the error names the element or field.
    Refused,
    /// Ended by a typed error that names the step.
    Explodes,
    /// Finite and upright, but much too stiff: a known defect of linear tetrahedra.
    Locks,
    /// Finite, but what is measured is beyond its bound.
    Deviates,
    /// Handed on an element that is inside out.
    Inverts,
    /// Fewer than 95 % of the steps converged.
    Unconverged,
    /// Handed on a NaN or an infinity.
    NotFinite,
    /// Began what should have been refused.
    Accepted,
    /// A panic.
    Panics,
    /// Took longer than its time.
    Hangs,
}

impl Outcome {
    /// The word of the tables.
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
}

impl Outcome {
    /// Whether it is what was expected: a body that comes back all the way has untangled, too.
    pub fn satisfies(self, expected: Self) -> bool {
        self == expected || (self, expected) == (Self::Recovers, Self::Untangles)
    }
}

impl fmt::Display for Outcome {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

/// What a case has found.
#[derive(Clone, Debug)]
pub struct Finding {
    /// How it ended.
    pub outcome: Outcome,
    /// The figure that decides, in the unit that [`Case::margin_is`] tells; none where nothing was measured.
    pub margin: Option<f64>,
    /// What a reader may want to know besides: figures, the message of an error.
    pub note: String,
}

impl Finding {
    /// With a figure.
    pub fn new(outcome: Outcome, margin: f64, note: impl Into<String>) -> Self {
        Self { outcome, margin: Some(margin), note: note.into() }
    }

    /// Without one.
    pub fn plain(outcome: Outcome, note: impl Into<String>) -> Self {
        Self { outcome, margin: None, note: note.into() }
    }

    /// `Survives` where the figure, in parts of its bound, is at most 1; NaN is not.
    pub fn within(part: f64, note: impl Into<String>) -> Self {
        Self::new(if part <= 1.0 { Outcome::Survives } else { Outcome::Deviates }, part, note)
    }
}

/// When a case has to end.
#[derive(Clone, Copy, Debug)]
pub struct Clock {
    /// It ends itself here, between two steps.
    pub deadline: Instant,
}

impl Clock {
    /// Whether time is up.
    pub fn is_over(&self) -> bool {
        Instant::now() >= self.deadline
    }
}

/// Something to be tried, and what it must end in.
pub struct Case {
    /// Its chapter.
    pub family: &'static str,
    /// What is extreme about it.
    pub case: String,
    /// The numbers that it is made of.
    pub parameters: String,
    /// Name of the method, as scenes spell it; `-` where none comes to run.
    pub integrator: String,
    /// Name of the law, as scenes spell it; `-` where none comes to run.
    pub material: String,
    /// How it must end.
    pub expected: Outcome,
    /// What the margin is, and its bound.
    pub margin_is: &'static str,
    /// Seeds of its random numbers.
    pub seed: Option<u64>,
    /// Tries it.
    pub work: Box<dyn FnOnce(Clock) -> Finding + Send>,
}

/// A case that has been tried.
#[derive(Clone, Debug, Serialize)]
#[allow(missing_docs)] // as in `Case`
pub struct Row {
    pub family: &'static str,
    pub case: String,
    pub parameters: String,
    pub integrator: String,
    pub material: String,
    pub expected: Outcome,
    pub outcome: Outcome,
    pub margin: Option<f64>,
    pub margin_is: &'static str,
    pub seed: Option<u64>,
    pub pass: bool,
    pub note: String,
    pub seconds: f64,
}
