//! Steps a case, and notes what decides whether it survives.

use super::case::{Clock, Finding, Outcome};
use fem_engine::number::Real;
use fem_engine::simulator::Simulator;
use fem_scene::simulation::{Failure, Simulation};

/// Part of the steps that must converge.
const CONVERGED: f64 = 0.95;

/// What margins of [`March::survival`] are.
pub const SMALLEST_J: &str = "smallest J at the end of a step; must be above 0";

/// What became of some steps.
#[derive(Clone, Debug)]
pub struct March {
    /// Steps that ended well.
    pub steps: usize,
    /// Steps of these that did not converge.
    pub unconverged: usize,
    /// What ended it too early.
    pub failure: Option<Failure>,
    /// Smallest J at the end of any step.
    pub min_J: f64,
    /// Largest kinetic energy at the end of any step, J.
    pub kinetic: f64,
    /// Whether everything was finite after every step.
    pub is_finite: bool,
    /// Whether time was up before the last step.
    pub is_late: bool,
}

/// Takes up to so many steps.
pub fn march<T: Real>(simulation: &mut Simulator<T>, steps: usize, clock: Clock) -> March {
    march_with(simulation, steps, clock, |_| {})
}

/// The same; calls `after` at the end of each step.
pub fn march_with<T: Real>(
    simulation: &mut Simulator<T>,
    steps: usize,
    clock: Clock,
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
        if clock.is_over() {
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
        // The smallest of some numbers is the other one where one is NaN.
        let J = simulation.min_J().0;
        march.is_finite &= simulation.state().first_not_finite().is_none() && !J.is_nan();
        march.min_J = march.min_J.min(J);
        after(simulation);
    }
    march.unconverged = simulation.counters().unconverged_steps - before;
    march
}

impl March {
    /// Why it does not survive; `None` where it does.
    pub fn trouble(&self) -> Option<Finding> {
        if self.is_late {
            return Some(Finding::plain(Outcome::Hangs, format!("{} steps when time was up", self.steps)));
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
        if (self.unconverged as f64) > (1.0 - CONVERGED) * self.steps as f64 {
            return Some(Finding::new(Outcome::Unconverged, self.min_J, self.note()));
        }
        None
    }

    /// Whether it survives; the margin is the smallest J.
    pub fn survival(&self) -> Finding {
        self.trouble().unwrap_or_else(|| Finding::new(Outcome::Survives, self.min_J, self.note()))
    }

    /// The figures.
    pub fn note(&self) -> String {
        let not = if self.unconverged > 0 { format!(", {} not converged", self.unconverged) } else { String::new() };
        format!("{} steps{not}", self.steps)
    }
}
