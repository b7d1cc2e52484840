//! The energies of the last simulated seconds, for the plot.

use std::collections::VecDeque;

use fem_output::EnergyRow;

/// Simulated time that the plot spans, s.
pub const SPAN: f64 = 10.0;
const SAMPLES: f64 = 500.0; // more than the plot has pixels

/// Samples of the last [`SPAN`] seconds at a bounded rate, so that their number does not grow with the number of steps.
#[derive(Clone, Debug, Default)]
pub struct History {
    samples: VecDeque<EnergyRow>,
}

impl History {
    /// Returns true if a sample at `time` is due. To be called before the energies are computed, which costs a loop over the elements.
    pub fn wants(&self, time: f64) -> bool {
        self.samples.back().is_none_or(|last| time - last.time >= 0.999 * SPAN / SAMPLES || time < last.time)
    }

    /// Adds a sample. A time before the last one clears the history first.
    pub fn push(&mut self, sample: EnergyRow) {
        if self.samples.back().is_some_and(|last| sample.time < last.time) {
            self.samples.clear();
        }
        self.samples.push_back(sample);
        while self.samples.front().is_some_and(|first| first.time < sample.time - SPAN) {
            self.samples.pop_front();
        }
    }

    /// Removes all samples.
    pub fn clear(&mut self) {
        self.samples.clear();
    }

    /// The samples, oldest first.
    pub fn to_vec(&self) -> Vec<EnergyRow> {
        self.samples.iter().copied().collect()
    }
}

#[cfg(test)]
mod tests {
    use fem_model::simulation::Energies;

    use super::*;

    fn row(time: f64) -> EnergyRow {
        EnergyRow { time, energies: Energies::default(), ledger: None }
    }

    fn fill(history: &mut History, steps: usize, dt: f64) {
        for i in 0..steps {
            let time = i as f64 * dt;
            if history.wants(time) {
                history.push(row(time));
            }
        }
    }

    #[test]
    fn many_small_steps_are_thinned_and_old_samples_removed() {
        let mut history = History::default();
        fill(&mut history, 200_000, 1e-4);
        let samples = history.to_vec();
        assert!(samples.len() <= 501, "{} samples", samples.len());
        assert!(samples[0].time >= 20.0 - SPAN - 0.05);
        assert!(samples.last().unwrap().time > 19.97);
    }

    #[test]
    fn samples_of_large_steps_are_all_kept() {
        let mut history = History::default();
        fill(&mut history, 50, 0.02);
        assert_eq!(history.to_vec().len(), 50);
    }

    #[test]
    fn a_time_before_the_last_one_clears_the_history() {
        let mut history = History::default();
        fill(&mut history, 50, 0.1);
        history.push(row(0.0));
        assert_eq!(history.to_vec().len(), 1);
    }
}
