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
    /// The reason why the run does not survive; `None` if it does.
    pub fn trouble(&self) -> Option<Finding> {
        if self.is_late {
            return Some(Finding::plain(Outcome::Hangs, format!("deadline after {} steps", self.steps)));
        }
        if let Some(failure) = &self.failure {
            return Some(Finding::plain(
                Outcome::Explodes,
                format!("{failure} (smallest J until then: {:.3e})", self.min_J),
            ));
        }
        if !self.is_finite {
            return Some(Finding::plain(Outcome::NotFinite, format!("within {} steps", self.steps)));
        }
        if self.min_J <= 0.0 {
            return Some(Finding::new(Outcome::Inverts, self.min_J, self.note()));
        }
        if self.is_unconverged() {
            return Some(Finding::new(Outcome::Unconverged, self.min_J, self.note()));
        }
        None
    }

    fn is_unconverged(&self) -> bool {
        (self.unconverged as f64) > (1.0 - CONVERGED) * self.steps as f64
    }

    /// Survival of a body whose elements may invert, with the smallest J as margin.
    pub fn endurance(&self) -> Finding {
        match self.trouble() {
            Some(trouble) if trouble.outcome != Outcome::Inverts => trouble,
            _ if self.is_unconverged() => Finding::new(Outcome::Unconverged, self.min_J, self.note()),
            _ => Finding::new(Outcome::Survives, self.min_J, self.note()),
        }
    }

    /// Survival, with the smallest J as margin.
    pub fn survival(&self) -> Finding {
        self.trouble().unwrap_or_else(|| Finding::new(Outcome::Survives, self.min_J, self.note()))
    }

    /// The number of steps, and of those that did not converge.
    pub fn note(&self) -> String {
        let not = if self.unconverged > 0 { format!(", {} not converged", self.unconverged) } else { String::new() };
        format!("{} steps{not}", self.steps)
    }
}
