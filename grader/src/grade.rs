//! The grade of a submission. `grade.json` holds it field by field.

use std::collections::BTreeMap;

use grader::status::Status;
use grader::submission::NAMES;
use grader_child::wire;
use serde::{Deserialize, Serialize};

use crate::rubric::Lateness;

/// Version of the format of `grade.json`.
pub const FORMAT_VERSION: u32 = 1;

/// Size of the largest `grade.json`, bytes. Every text that a submission can make long is cut until all of it fits.
pub const MOST_BYTES: u64 = 1 << 20;

/// One graded submission.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Grade {
    pub format_version: u32,
    /// Name of the submission: its folder or archive without the ending.
    pub submission: String,
    /// Hash of the 22 files as they were read; submissions with the same hash are the same.
    pub files: String,
    pub score: f64,
    pub max_score: f64,
    pub seed: u64,
    /// Output of `rustc --version`.
    pub toolchain: String,
    /// Layers of the sandbox, and whether this machine had them.
    pub sandbox: BTreeMap<String, bool>,
    /// Remarks on the submission as a whole: it cannot be read, files were ignored, …
    pub remarks: Vec<String>,
    /// The functions of the assignment, in the order of the rubric.
    pub functions: Vec<FunctionGrade>,
    /// The whole simulation with the submission's functions alone.
    pub simulation: FunctionGrade,
    /// Points by hand and lateness, if they have been applied.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub account: Option<Account>,
    /// Address of a function's page, with `{name}` in it; relative to the student's repository unless it begins with `http`.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub pages: Option<String>,
    /// The whole simulation at several time steps, with `--report`; it does not count for points.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub study: Option<Study>,
    /// Processor time of this grading with all its processes, s; on a system without that counter, the wall-clock time.
    pub seconds: f64,
}

/// Points as people read them, without needless digits: `7`, `7.5`, `7.25`.
pub fn points(points: f64) -> String {
    let text = format!("{points:.2}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

/// The pages in the students' repository.
const PAGES: &str = "include-docs/{name}.md";

impl Grade {
    /// The address of a function's page; `None` for what is no function of the course.
    pub fn page_of(&self, function: &str) -> Option<String> {
        let pages = self.pages.as_deref().unwrap_or(PAGES);
        NAMES.contains(&function).then(|| pages.replace("{name}", function))
    }
}

/// Steps from the points of the checks to the final score.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Account {
    pub student: String,
    /// The points of the checks, before adjustments and penalty.
    pub raw_score: f64,
    /// `None` without a deadline or a time of submission.
    pub late: Option<Lateness>,
    pub adjustments: Vec<Adjustment>,
}

/// Points or a comment by hand.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Adjustment {
    /// `None`: the whole.
    pub function: Option<String>,
    pub points: Option<f64>,
    /// The instructor's.
    pub reason: Option<String>,
    /// Words for the student.
    pub comment: Option<String>,
}

/// Error against run time of the whole simulation, the submission beside the reference.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Study {
    /// By integrator and time step, the submission's and the reference's runs in pairs.
    pub runs: Vec<Run>,
    /// Uncertainty of the motion that errors are measured against, m.
    pub uncertainty: f64,
}

/// The whole simulation with one integrator and one time step.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Run {
    /// The course's name of it.
    pub integrator: String,
    /// Time step, s.
    pub dt: f64,
    /// `None` if the submission gave no answer.
    pub submission: Option<Outcome>,
    pub reference: Outcome,
    /// The submission's positions are those of the reference. If not, the times cannot be compared.
    #[serde(default = "right")]
    pub is_right: bool,
}

/// Missing in records of earlier versions.
fn right() -> bool {
    true
}

/// Result of a simulation.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Outcome {
    /// Largest distance of a vertex from its true position at the end, m; the body is 1 m long.
    pub error: f64,
    /// Time by the clock on the wall, s: the fastest of a few.
    pub seconds: f64,
}

/// One function of a submission.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct FunctionGrade {
    pub name: String,
    pub score: f64,
    pub max_score: f64,
    pub status: Status,
    /// Short name of the mistake that explains the answers, such as `negated`.
    pub diagnosis: Option<String>,
    /// Sentences about the inputs and entries for which the answers are right, and those for which they are wrong.
    #[serde(default)]
    pub location: Option<String>,
    /// A sentence for the student: what the diagnosis means, why the file was refused, what the compiler says, …
    pub message: Option<String>,
    /// The rubric's hint, if the function does not pass.
    pub hint: Option<String>,
    /// Worst relative error against the reference; `None` if there is no answer to compare.
    pub error: Option<f64>,
    /// Time of one call on a standard load by the clock on the wall, s: the fastest of a few series.
    pub seconds: Option<f64>,
    /// The same for the reference on the same machine in the same minute, s.
    pub reference_seconds: Option<f64>,
    /// Growth of the time of an assembly, of skinning or of picking with the mesh; `None` if it was not measured.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub growth: Option<Growth>,
    pub checks: Vec<CheckGrade>,
}

/// Growth of the time t ~ nᵉ with the number of elements n.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
pub struct Growth {
    /// The exponent e of the submission.
    pub exponent: f64,
    /// That of the reference, which is measured where the submission's is not near 1.
    pub reference_exponent: Option<f64>,
    /// Elements of the largest mesh that was measured.
    pub elements: usize,
}

impl FunctionGrade {
    /// The part of its points that a function keeps, if a growth faster than the reference's costs this part.
    pub fn kept(&self, growth_costs: f64) -> f64 {
        let is_faster = self.growth.is_some_and(|growth| growth.is_faster());
        if is_faster && self.status == Status::Passed { 1.0 - growth_costs } else { 1.0 }
    }
}

impl Growth {
    /// Smallest exponent that cannot be explained by noise of the clock or the memory of a larger mesh.
    pub const CLEAR: f64 = 1.6;

    /// Returns true if the submission's time clearly grows faster than that of the reference.
    pub fn is_faster(&self) -> bool {
        self.exponent > Self::CLEAR && self.reference_exponent.is_some_and(|reference| reference < self.exponent - 0.5)
    }

    /// The sentence for the student, where the submission clearly grows faster than the reference.
    pub fn sentence(&self) -> Option<String> {
        let reference = self.reference_exponent.filter(|_| self.is_faster())?;
        Some(format!(
            "The time of your function grows as n^{:.1} with the number of elements, the reference's as n^{reference:.1}: look for a \
             loop over the whole mesh, or a full matrix, inside of a loop over the mesh.",
            self.exponent
        ))
    }
}

/// One check of a function.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct CheckGrade {
    pub name: String,
    pub status: Status,
    /// The broken rule or the failure without inputs and figures, which students may read.
    pub message: String,
    /// Input and figures of the failure: the instructor's.
    pub counterexample: Option<String>,
}

impl Grade {
    /// The same with its texts cut so that `grade.json` has at most [`MOST_BYTES`].
    pub fn bounded(mut self) -> Self {
        for most in [4000, 1000, 250, 60] {
            self.cut(most);
            let length = serde_json::to_vec_pretty(&self).map_or(0, |text| text.len() as u64);
            if length < MOST_BYTES {
                break;
            }
        }
        self
    }

    /// Cuts every text that a submission can influence to this number of bytes.
    fn cut(&mut self, most: usize) {
        self.remarks.iter_mut().for_each(|remark| cut(remark, most));
        for part in self.functions.iter_mut().chain([&mut self.simulation]) {
            part.message
                .iter_mut()
                .chain(&mut part.diagnosis)
                .chain(&mut part.location)
                .for_each(|text| cut(text, most));
            for check in &mut part.checks {
                cut(&mut check.message, most);
                check.counterexample.iter_mut().for_each(|text| cut(text, most));
            }
        }
    }
}

fn cut(text: &mut String, most: usize) {
    if text.len() > most {
        *text = format!("{} …", wire::start(text, most));
    }
}
