//! The time of a step and its parts.

use std::time::{Duration, Instant};

use fem_model::simulation::Simulation;

const INTERVAL: Duration = Duration::from_millis(500); // over which times are averaged

/// A part of a step.
#[derive(Clone, Debug, PartialEq)]
pub struct StepTimer {
    /// The part, as `--stats` names it.
    pub name: &'static str,
    /// Mean time in a step, s.
    pub seconds: f64,
    /// Mean number of uses in a step.
    pub uses: f64,
}

/// The parts of the last steps.
#[derive(Default)]
pub struct StepTimers {
    /// The last reading: its time, the number of steps then, and the uses and seconds of each part.
    last: Option<(Instant, usize, Vec<Reading>)>,
    rows: Vec<StepTimer>,
    /// Mean time of the steps that the rows are about, s.
    step: f64,
    /// Time of all steps since the last reading, s.
    since: f64,
}

/// Name, uses and seconds of a part.
type Reading = (&'static str, usize, f64);

impl StepTimers {
    /// The parts that took time in the last steps, in the order of `--explain`.
    pub fn rows(&self) -> &[StepTimer] {
        &self.rows
    }

    /// Mean time of the steps of which the rows are parts, s.
    pub fn step(&self) -> f64 {
        self.step
    }

    /// Adds the time of a step, s.
    pub fn add_step(&mut self, seconds: f64) {
        self.since += seconds;
    }

    /// Reads the timers of a simulation, unless that was done lately.
    pub fn update(&mut self, simulation: &dyn Simulation) {
        if self.last.as_ref().is_some_and(|(when, ..)| when.elapsed() < INTERVAL) {
            return;
        }
        let steps = simulation.counters().steps;
        let built = simulation.parts().into_iter().filter(|part| part.built);
        let now: Vec<Reading> = built.map(|part| (part.name, part.uses, part.seconds)).collect();
        match self.last.take() {
            // Another simulation, or no step since.
            Some((_, before, readings)) if steps > before && readings.len() == now.len() => {
                self.rows = differences(&readings, &now, steps - before);
                self.step = self.since / (steps - before) as f64;
            }
            Some(last) if last.1 == steps && last.2.len() == now.len() => {}
            _ => self.rows.clear(),
        }
        self.last = Some((Instant::now(), steps, now));
        self.since = 0.0;
    }
}

fn differences(before: &[Reading], now: &[Reading], steps: usize) -> Vec<StepTimer> {
    let row = |(before, now): (&Reading, &Reading)| StepTimer {
        name: now.0,
        seconds: (now.2 - before.2).max(0.0) / steps as f64,
        uses: now.1.saturating_sub(before.1) as f64 / steps as f64,
    };
    before.iter().zip(now).map(row).filter(|row| row.seconds > 0.0).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn times_are_those_of_one_step_of_the_last_ones() {
        let before = [("mesh", 0, 0.0), ("forces", 10, 1.0), ("solver", 4, 8.0)];
        let now = [("mesh", 0, 0.0), ("forces", 30, 2.0), ("solver", 6, 12.0)];
        let rows = differences(&before, &now, 2);
        assert_eq!(rows.len(), 2, "parts without a time of their own are left out");
        assert_eq!(rows[0], StepTimer { name: "forces", seconds: 0.5, uses: 10.0 });
        assert_eq!(rows[1], StepTimer { name: "solver", seconds: 2.0, uses: 1.0 });
    }
}
