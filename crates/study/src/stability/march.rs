//! Time marching of a case, with the quantities that decide its outcome.

use super::case::{Finding, Outcome};
use crate::study::Deadline;

use fem_engine::simulator::{Compiled, Simulator};
use fem_model::simulation::{Failure, Simulation};

/// Share of the steps that must converge.
const CONVERGED: f64 = 0.95;

/// The result of a number of steps.
#[derive(Clone, Debug)]
pub struct March {
    /// Completed steps.
    pub steps: usize,
    /// Completed steps that did not converge.
    pub unconverged: usize,
    /// The failure of the last step.
    pub failure: Option<Failure>,
    /// Smallest J at the end of all steps.
    pub min_J: f64,
    /// Largest kinetic energy at the end of all steps, J.
    pub kinetic: f64,
    /// All values were finite after every step.
    pub is_finite: bool,
    /// The deadline passed before the last step.
    pub is_late: bool,
}

/// Takes up to `steps` steps.
pub fn march<T: Compiled>(simulation: &mut Simulator<T>, steps: usize, deadline: Deadline) -> March {
    march_with(simulation, steps, deadline, |_| {})
}

/// Takes up to `steps` steps and calls `after` at the end of each.
pub fn march_with<T: Compiled>(
    simulation: &mut Simulator<T>,
    steps: usize,
    deadline: Deadline,
    mut after: impl FnMut(&Simulator<T>),
) -> March {
    let before = simulation.counters().unconverged_steps;
    let mut march = March {
        steps: 0,
        unconverged: 0,
        failure: None,
        min_J: f64::INFINITY,
        kinetic: 0.0,
        is_finite: true,
        is_late: false,
    };
    for _ in 0..steps {
        if deadline.is_over() {
            march.is_late = true;
            break;
        }
        if let Err(failure) = simulation.step() {
            march.failure = Some(failure);
            break;
        }
        march.steps += 1;
        let energies = simulation.energies();
        march.kinetic = march.kinetic.max(energies.kinetic);
        // `min` ignores a NaN.
        let J = simulation.min_J().0;
        march.is_finite &= simulation.state().first_not_finite().is_none() && !J.is_nan();
        march.min_J = march.min_J.min(J);
        after(simulation);
    }
    march.unconverged = simulation.counters().unconverged_steps - before;
    march
}

impl March {
    /// Fails with the reason why the run does not survive.
    pub fn survived(&self) -> Result<(), Finding> {
        Err(match &self.failure {
            _ if self.is_late => Finding::plain(Outcome::Hangs, format!("deadline after {} steps", self.steps)),
            Some(failure) => {
                let note = format!("{failure} (smallest J until then: {:.3e})", self.min_J);
                Finding::plain(Outcome::Explodes, note)
            }
            None if !self.is_finite => Finding::plain(Outcome::NotFinite, format!("within {} steps", self.steps)),
            None if self.min_J <= 0.0 => self.finding(Outcome::Inverts),
            None if self.is_unconverged() => self.finding(Outcome::Unconverged),
            None => return Ok(()),
        })
    }

    /// A finding with the smallest J as margin.
    fn finding(&self, outcome: Outcome) -> Finding {
        Finding::new(outcome, self.min_J, self.note())
    }

    fn is_unconverged(&self) -> bool {
        (self.unconverged as f64) > (1.0 - CONVERGED) * self.steps as f64
    }

    /// Survival of a body whose elements may invert, with the smallest J as margin.
    pub fn endurance(&self) -> Finding {
        match self.survived() {
            Err(trouble) if trouble.outcome != Outcome::Inverts => trouble,
            _ if self.is_unconverged() => self.finding(Outcome::Unconverged),
            _ => self.finding(Outcome::Survives),
        }
    }

    /// Survival, with the smallest J as margin.
    pub fn survival(&self) -> Finding {
        self.survived().map_or_else(|trouble| trouble, |()| self.finding(Outcome::Survives))
    }

    /// The number of steps, and of those that did not converge.
    pub fn note(&self) -> String {
        let not = if self.unconverged > 0 { format!(", {} not converged", self.unconverged) } else { String::new() };
        format!("{} steps{not}", self.steps)
    }
}
