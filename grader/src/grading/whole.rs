//! The whole simulation with a submission's functions alone: the student's own code from the mass matrix to the last step.

use std::collections::BTreeMap;
use std::path::Path;
use std::rc::Rc;
use std::time::Duration;

use grader::compile::{Attempt, Plan, attempt};
use grader::implementation::Trouble;
use grader::implementation::budget::Budget;
use grader::implementation::places::Places;
use grader::implementation::sandboxed::Sandboxed;
use grader::status::Status;
use grader::submission::{NAMES, Source, Submission};
use grader_child::simulation::Scene;
use nalgebra::{DVector, Vector3};
use tempfile::TempDir;

use super::load::cube;
use super::programs::start;
use super::{Grading, GradingError};
use crate::grade::FunctionGrade;

/// The methods whose motions are compared, as a [`Scene`] numbers them.
const INTEGRATORS: [usize; 2] = [0, 1];

/// Longest time for the motion of one method; the reference needs a fraction of a second.
pub(super) const LIMIT: Duration = Duration::from_secs(30);

/// The time step whose answers are compared, s.
const TIME_STEP: f64 = 0.01;

/// Simulated time, s.
const DURATION: f64 = 0.2;

/// Largest distance from the reference's positions, in lengths of the body. Newton's method may end a little earlier or later.
const TOLERANCE: f64 = 1e-6;

/// All of a submission's functions in one program, or the reason why it could not be built.
pub(super) struct Whole {
    attempt: Attempt,
    folder: TempDir,
    places: Places,
}

impl Whole {
    /// The program, and the folder that it may see.
    pub(super) fn program(&self) -> Option<(&Path, &Path)> {
        match &self.attempt {
            Attempt::Built(program) => Some((program, self.folder.path())),
            _ => None,
        }
    }
}

impl Grading {
    /// Builds the program, unless a function of it is already known not to compile.
    pub(super) fn whole(
        &self,
        submission: &Submission,
        graded: &BTreeMap<String, FunctionGrade>,
        budget: &Budget,
    ) -> Result<Option<Whole>, GradingError> {
        if !absent(graded).is_empty() || !self.rubric.later.is_empty() {
            return Ok(None);
        }
        let own = NAMES.into_iter().filter_map(|name| match submission.functions.get(name) {
            Some(Source::Written(text)) => Some((name, text.clone())),
            _ => None,
        });
        let folder = self.workspace.folder()?;
        let limit = self.compile_limit();
        let plan = Plan { own: own.collect(), reference: None, helpers: BTreeMap::new(), limit };
        let attempt = attempt(&self.prebuilt, &self.sandbox, &plan, folder.path(), budget)?;
        Ok(Some(Whole { attempt, folder, places: Places::of(submission) }))
    }

    /// Grades the simulation. If a function is missing, the simulation cannot run, and no further points are lost.
    pub(super) fn grade_simulation(
        &self,
        whole: Option<&Whole>,
        functions: &BTreeMap<String, FunctionGrade>,
        budget: &Rc<Budget>,
    ) -> Result<FunctionGrade, GradingError> {
        let mut grade = FunctionGrade {
            name: "simulation".to_owned(),
            score: 0.0,
            max_score: self.rubric.simulation.points,
            status: Status::Missing,
            diagnosis: None,
            location: None,
            message: None,
            hint: None,
            error: None,
            seconds: None,
            reference_seconds: None,
            growth: None,
            checks: Vec::new(),
        };
        let absent = absent(functions);
        let Some(Whole { attempt, folder, places }) = whole.filter(|_| absent.is_empty()) else {
            grade.message = Some(match &absent[..] {
                [] => "the whole simulation needs functions of a later assignment".to_owned(),
                names => format!("the whole simulation needs {}", names.join(", ")),
            });
            return Ok(grade);
        };
        let program = match attempt {
            Attempt::Built(program) => program,
            // All parts have been compiled on this machine, so the fault is in their combination.
            Attempt::GaveUp(why) => {
                grade.status = Status::DidNotCompile;
                grade.message = Some(format!("the files compile one by one, but not together: {why}"));
                return Ok(grade);
            }
            Attempt::Refused(what) => {
                grade.status = Status::Refused;
                grade.message = Some(format!("a file reads {what} while it is compiled, which is not allowed"));
                return Ok(grade);
            }
            Attempt::OutOfTime => {
                grade.status = Status::TimedOut;
                grade.message = Some("the time of the submission was used up before".to_owned());
                return Ok(grade);
            }
            Attempt::Failed(faults) => {
                grade.status = Status::DidNotCompile;
                grade.message = Some(match faults.first_key_value() {
                    Some((name, fault)) => format!("{name} does not compile with the student's other files:\n{fault}"),
                    None => "the files compile one by one, but not together".to_owned(),
                });
                return Ok(grade);
            }
        };
        // Right code may be a hundred times slower than the reference, so a motion has more time than a check.
        let left = budget.left_in_all();
        let own = Rc::new(Budget::new(LIMIT, LIMIT * INTEGRATORS.len() as u32, left));
        let subject = Sandboxed::new(start(&self.sandbox, Some(program.clone()), folder.path()), LIMIT)
            .within(own.clone(), places.clone());
        let outcome = self.compare_simulations(grade, &subject, &own);
        budget.spend_apart(left.saturating_sub(own.left_in_all()));
        outcome
    }

    fn compare_simulations(
        &self,
        mut grade: FunctionGrade,
        subject: &Sandboxed,
        budget: &Budget,
    ) -> Result<FunctionGrade, GradingError> {
        let reference = Sandboxed::new(self.programs.start_reference(&self.sandbox), LIMIT);
        let mut worst = 0.0_f64;
        for integrator in INTEGRATORS {
            let scene = scene(integrator, TIME_STEP);
            let failed = |trouble: Trouble| GradingError::Reference(trouble.to_string());
            let (expected, reference_seconds) = reference.simulate(&scene, LIMIT).map_err(failed)?;
            budget.next_check();
            match subject.simulate(&scene, LIMIT) {
                Ok((positions, seconds)) => {
                    worst = worst.max(distance(&positions, &expected));
                    grade.seconds = Some(grade.seconds.unwrap_or(0.0) + seconds);
                    grade.reference_seconds = Some(grade.reference_seconds.unwrap_or(0.0) + reference_seconds);
                }
                Err(trouble) => {
                    let is_late = matches!(trouble, Trouble::TimedOut(_));
                    grade.status = if is_late { Status::TimedOut } else { Status::Crashed };
                    grade.message = Some(trouble.to_string());
                    return Ok(grade);
                }
            }
        }
        grade.error = worst.is_finite().then_some(worst);
        if worst <= TOLERANCE {
            grade.status = Status::Passed;
            grade.score = grade.max_score;
        } else {
            grade.status = Status::Failed;
            grade.message = Some("the body does not move as it should; mend the functions that fail".to_owned());
        }
        Ok(grade)
    }
}

/// The functions that are not there, or not in a form that can be run.
fn absent(functions: &BTreeMap<String, FunctionGrade>) -> Vec<&str> {
    let absent = functions.values().filter(|function| function.status > Status::TimedOut);
    absent.map(|function| function.name.as_str()).collect()
}

/// Largest distance between two simulations; ∞ where they cannot be compared.
pub(super) fn distance(positions: &[DVector<f64>], expected: &[DVector<f64>]) -> f64 {
    let is_comparable = positions.len() == expected.len()
        && positions.iter().zip(expected).all(|(a, b)| a.len() == b.len() && a.iter().all(|x| x.is_finite()));
    if !is_comparable {
        return f64::INFINITY;
    }
    positions.iter().zip(expected).map(|(a, b)| (a - b).amax()).fold(0.0, f64::max)
}

/// A rubber cube of 1 m that stands on its lowest vertices, sags, and is pulled at a corner.
pub(super) fn scene(integrator: usize, dt: f64) -> Scene {
    let (V, T, v0) = cube(3);
    let fixed = (0..V.len()).filter(|&vertex| V[vertex].z == 0.0).collect();
    let pulled = V.len() - 1;
    let target = V[pulled] + Vector3::new(0.2, 0.1, 0.05);
    let V_skin = V.iter().map(|X| X * 0.98 + Vector3::repeat(0.01)).collect();
    let (C, D, density, pull) = (2e4, 5e4, 1000.0, 2e3);
    let gravity = Vector3::new(0.0, 0.0, -9.81);
    let steps = (DURATION / dt).round() as usize;
    Scene { V, T, v0, fixed, pulled, target, pull, C, D, density, gravity, dt, steps, integrator, V_skin }
}
