//! Error against run time of the whole simulation, at several time steps, beside the reference. No points depend on it.

use std::rc::Rc;
use std::time::Duration;

use grader::implementation::budget::Budget;
use grader::implementation::places::Places;
use grader::implementation::sandboxed::Sandboxed;
use grader::status::Status;
use grader_child::simulation::Scene;
use nalgebra::DVector;

use super::programs::start;
use super::truth::{Truth, truth};
use super::whole::{LIMIT, Whole, distance, scene};
use super::{Grading, GradingError};
use crate::grade::{FunctionGrade, Outcome, Run, Study};

/// The integrators, by their number in a scene.
const INTEGRATORS: [&str; 2] = ["linearly_implicit_euler", "implicit_euler"];

/// Time steps, s.
const TIME_STEPS: [f64; 4] = [0.02, 0.01, 0.005, 0.0025];

/// Runs, the fastest of which counts.
const REPEATS: usize = 3;

/// Largest distance from the reference's positions at which a run is right, m. The methods themselves err a thousand times as much.
const RIGHT: f64 = 1e-5;

/// A run that takes longer than this is not repeated: it is long enough to be timed once.
const LONG: Duration = Duration::from_secs(1);

impl Grading {
    /// Runs the simulations. Where the submission has no program, or one that does not come to an end, there are none.
    pub(super) fn study(
        &self,
        whole: Option<&Whole>,
        simulation: &FunctionGrade,
        budget: &Rc<Budget>,
    ) -> Result<Study, GradingError> {
        let truth = truth(&scene(0, TIME_STEPS[0])).map_err(GradingError::Reference)?;
        let mut study = Study { runs: Vec::new(), uncertainty: truth.uncertainty };
        let runs_to_the_end = matches!(simulation.status, Status::Passed | Status::Failed);
        let Some((program, folder)) = whole.and_then(Whole::program).filter(|_| runs_to_the_end) else {
            return Ok(study);
        };
        let subject = Sandboxed::new(start(&self.sandbox, Some(program.to_owned()), folder), LIMIT)
            .within(budget.clone(), Places::default());
        let reference = Sandboxed::new(self.programs.start_reference(&self.sandbox), LIMIT);
        budget.next_function();
        let mut answers = true;
        for (number, integrator) in INTEGRATORS.into_iter().enumerate() {
            for dt in TIME_STEPS {
                let scene = scene(number, dt);
                let expected = outcome(&reference, &scene, &truth);
                let silent = || GradingError::Reference(format!("{integrator} with a time step of {dt} s"));
                // After one time-out no further run is started.
                let found = if answers { outcome(&subject, &scene, &truth) } else { None };
                answers = found.is_some();
                let (reference, expected) = expected.ok_or_else(silent)?;
                let is_right = found.as_ref().is_none_or(|(_, answers)| agree(answers, &expected));
                study.runs.push(Run {
                    integrator: integrator.to_owned(),
                    dt,
                    submission: found.map(|(outcome, _)| outcome),
                    reference,
                    is_right,
                });
            }
        }
        Ok(study)
    }
}

/// Returns true if every run has the positions of the first run of the reference.
fn agree(runs: &[Positions], expected: &[Positions]) -> bool {
    let Some(expected) = expected.first() else { return false };
    runs.iter().all(|run| distance(run, expected) <= RIGHT)
}

/// Positions after each step of a run.
type Positions = Vec<DVector<f64>>;

/// Runs a scene a few times, and keeps all their positions; `None` if an answer is missing or not valid.
fn outcome(program: &Sandboxed, scene: &Scene, truth: &Truth) -> Option<(Outcome, Vec<Positions>)> {
    let (mut best, mut answers): (Option<Outcome>, _) = (None, Vec::new());
    for _ in 0..REPEATS {
        // In a process of its own, whose time is not yet used up.
        program.next_function();
        let (positions, seconds) = program.simulate(scene, LIMIT).ok()?;
        let error = error(&positions, scene, truth)?;
        answers.push(positions);
        best = best.filter(|best| best.seconds <= seconds).or(Some(Outcome { error, seconds }));
        if seconds > LONG.as_secs_f64() {
            break;
        }
    }
    best.map(|best| (best, answers))
}

/// Distance from the truth after the last step, m. One more vector follows it: that of the display surface.
fn error(positions: &[DVector<f64>], scene: &Scene, truth: &Truth) -> Option<f64> {
    let last = positions.get(scene.steps.checked_sub(1)?)?;
    let error = (last.len() == truth.positions.len()).then(|| (last - &truth.positions).amax())?;
    // The largest of entries is not defined if one of them is NaN.
    last.iter().all(|x| x.is_finite()).then_some(error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_answer_that_is_short_or_no_number_has_no_error() {
        let scene = scene(0, 0.1);
        let truth = Truth { positions: DVector::zeros(3), uncertainty: 0.0 };
        let ends_at = |last: Vec<f64>| [DVector::zeros(3), DVector::from_vec(last), DVector::zeros(1)];
        assert_eq!(scene.steps, 2);
        assert_eq!(error(&ends_at(vec![0.0, -2.0, 1.0]), &scene, &truth), Some(2.0));
        for wrong in [vec![0.0, f64::NAN, 1.0], vec![f64::INFINITY, 0.0, 0.0], vec![1.0]] {
            assert_eq!(error(&ends_at(wrong), &scene, &truth), None);
        }
        assert_eq!(error(&ends_at(vec![0.0; 3])[..1], &scene, &truth), None);
    }

    #[test]
    fn a_run_whose_positions_are_not_the_references_is_not_right() {
        let run = |x: f64| vec![DVector::repeat(3, x), DVector::repeat(6, x)];
        let expected = [run(1.0), run(1.0)];
        assert!(agree(&[run(1.0), run(1.0 + 1e-7)], &expected));
        // A program that answers wrongly once would be faster.
        assert!(!agree(&[run(1.0), run(1.0 + 1e-3)], &expected));
        assert!(!agree(&[run(f64::NAN)], &expected) && !agree(&[run(1.0)[..1].to_vec()], &expected));
        assert!(!agree(&[run(1.0)], &[]));
    }
}
