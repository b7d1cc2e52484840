//! The loop that steps a simulation and measures its time.

use std::ops::ControlFlow;
use std::time::Instant;

use fem_model::simulation::{Failure, Simulation};

/// Step times of a run, and the failure that ended it.
#[derive(Clone, Debug, Default)]
pub struct Run {
    /// Wall-clock time of each completed step, without `after_step`, s.
    pub step_seconds: Vec<f64>,
    /// The failure, if a step failed.
    pub failure: Option<Failure>,
    /// True if `after_step` ended the run before its last step.
    pub interrupted: bool,
}

/// Advances by `steps` steps, or up to the first that fails. `after_step` is not part of the measured time; it ends the run by an
/// error or by [`ControlFlow::Break`].
pub fn run<E>(
    simulation: &mut dyn Simulation,
    steps: usize,
    mut after_step: impl FnMut(&dyn Simulation) -> Result<ControlFlow<()>, E>,
) -> Result<Run, E> {
    let mut run = Run::default();
    for step in 1..=steps {
        let start = Instant::now();
        let outcome = simulation.step();
        let seconds = start.elapsed().as_secs_f64();
        if let Err(failure) = outcome {
            run.failure = Some(failure);
            break;
        }
        run.step_seconds.push(seconds);
        if after_step(simulation)?.is_break() {
            run.interrupted = step < steps;
            break;
        }
    }
    Ok(run)
}

/// Quantile of the values by nearest rank, `fraction` from 0 to 1; `None` without values.
pub fn quantile(values: &[f64], fraction: f64) -> Option<f64> {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let rank = (fraction * sorted.len() as f64).ceil() as usize;
    sorted.get(rank.clamp(1, sorted.len().max(1)) - 1).copied()
}

#[cfg(test)]
mod tests {
    use super::quantile;

    #[test]
    fn the_median_of_an_odd_number_of_values_is_the_middle_one() {
        assert_eq!(quantile(&[3.0, 1.0, 2.0], 0.5), Some(2.0));
    }

    #[test]
    fn ninety_five_percent_of_the_values_lie_at_or_below_their_quantile() {
        let values: Vec<f64> = (1..=100).map(f64::from).collect();
        assert_eq!(quantile(&values, 0.95), Some(95.0));
        assert_eq!(quantile(&values, 1.0), Some(100.0));
    }

    #[test]
    fn an_empty_list_has_no_quantile() {
        assert_eq!(quantile(&[], 0.5), None);
    }
}
