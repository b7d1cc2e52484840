//! Runs and takes their time. The first run of each is looked at: its end, its energies on the way. Later ones are timed only, in
//! turn with all other runs, so that a busy minute of the machine falls on all of them.

use std::time::Instant;

use nalgebra::DVector;

use super::machine;
use super::plan::Run;
use crate::scene::Scene;
use crate::simulate::quantile;
use crate::simulation::{Counters, Simulation};

/// Builds the simulation of a scene, by whichever pipeline it names.
pub type Factory<'a> = dyn Fn(&Scene) -> Result<Box<dyn Simulation>, String> + 'a;

/// What a run led to.
#[derive(Clone, Debug, PartialEq)]
pub struct Outcome {
    /// s
    pub time: f64,
    /// Positions of all nodes, m.
    pub q: DVector<f64>,
    /// Velocities of all nodes, m/s.
    pub qdot: DVector<f64>,
    /// Kinetic and potential energy at the end, J.
    pub energies: (f64, f64),
    /// Time (s) and total energy (J) on the way.
    pub history: Vec<(f64, f64)>,
    /// Smallest J of the moments that were looked at.
    pub min_j: f64,
    /// Work done.
    pub counters: Counters,
    /// Why it ended early, where it did.
    pub failure: Option<String>,
    /// Distance from the scene's closed form, where it has one.
    pub analytic: Option<f64>,
    /// Largest memory of the process, MB.
    pub peak_mb: Option<f64>,
    /// The clock of this run.
    pub timing: Timing,
}

/// The clock of one run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Timing {
    /// s
    pub setup: f64,
    /// Each step, s.
    pub steps: Vec<f64>,
}

impl Timing {
    /// All steps, s.
    pub fn total(&self) -> f64 {
        self.steps.iter().sum()
    }
}

/// Moments of a run that are looked at.
const LOOKS: usize = 120;

/// Runs and looks. An error says why the scene cannot be built.
pub fn first(factory: &Factory, run: &Run) -> Result<Outcome, String> {
    machine::forget_peak();
    let start = Instant::now();
    let mut simulation = factory(&run.scene)?;
    let mut timing = Timing { setup: start.elapsed().as_secs_f64(), ..Timing::default() };
    let every = run.steps.div_ceil(LOOKS);
    let (mut history, mut min_j) = (vec![(0.0, simulation.energies().total())], simulation.min_J().0);
    let failure = steps(&mut *simulation, run.steps, &mut timing, |simulation, step| {
        if step % every == 0 || step == run.steps {
            history.push((simulation.time(), simulation.energies().total()));
            min_j = min_j.min(simulation.min_J().0);
        }
    });
    let energies = simulation.energies();
    Ok(Outcome {
        time: simulation.time(),
        q: simulation.positions(),
        qdot: simulation.velocities(),
        energies: (energies.kinetic, energies.potential),
        history,
        min_j,
        counters: simulation.counters(),
        analytic: super::closed_forms::error(&run.scene, &*simulation).filter(|_| failure.is_none()),
        failure,
        peak_mb: machine::peak_mb(),
        timing,
    })
}

/// Runs and takes the time, nothing else.
pub fn again(factory: &Factory, run: &Run) -> Result<Timing, String> {
    let start = Instant::now();
    let mut simulation = factory(&run.scene)?;
    let mut timing = Timing { setup: start.elapsed().as_secs_f64(), ..Timing::default() };
    steps(&mut *simulation, run.steps, &mut timing, |_, _| ());
    Ok(timing)
}

/// Steps; the clock runs in the steps alone.
fn steps(
    simulation: &mut dyn Simulation,
    count: usize,
    timing: &mut Timing,
    mut look: impl FnMut(&dyn Simulation, usize),
) -> Option<String> {
    timing.steps.reserve(count);
    for step in 1..=count {
        let start = Instant::now();
        let outcome = simulation.step();
        timing.steps.push(start.elapsed().as_secs_f64());
        if let Err(failure) = outcome {
            return Some(failure.to_string());
        }
        look(simulation, step);
    }
    None
}

/// When a run has been timed often enough.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Patience {
    /// Repetitions at least, and at most.
    pub repetitions: (usize, usize),
    /// Time for all of a run's repetitions, once there are enough of them, s.
    pub seconds: f64,
    /// A first run as long as this has warmed up by itself, and counts, s.
    pub long: f64,
}

impl Patience {
    /// For a study of minutes, or for a look.
    pub fn new(is_quick: bool) -> Self {
        let repetitions = if is_quick { (2, 3) } else { (3, 9) };
        Self { repetitions, seconds: if is_quick { 0.02 } else { 1.0 }, long: if is_quick { 0.3 } else { 2.0 } }
    }

    /// The clocks of all runs: round after round over all of them. `tell` is called after each.
    pub fn time(&self, factory: &Factory, runs: &[(&Run, &Timing)], mut tell: impl FnMut()) -> Vec<Vec<Timing>> {
        let counts = |timing: &Timing| timing.total() > self.long;
        let mut clocks: Vec<Vec<Timing>> =
            runs.iter().map(|(_, first)| if counts(first) { vec![(*first).clone()] } else { Vec::new() }).collect();
        for _ in 0..self.repetitions.1 {
            for ((run, _), clocks) in runs.iter().zip(&mut clocks) {
                let spent: f64 = clocks.iter().map(|clock| clock.total() + clock.setup).sum();
                let is_enough = clocks.len() >= self.repetitions.0 && spent > self.seconds;
                if clocks.len() < self.repetitions.1 && !is_enough {
                    // It could be built before, and can be again.
                    clocks.extend(again(factory, run));
                }
                tell();
            }
        }
        clocks
    }

    /// Calls of `tell` that [`time`](Self::time) makes for so many runs.
    pub fn calls(&self, runs: usize) -> usize {
        self.repetitions.1 * runs
    }
}

/// Lower quartile, median and upper quartile.
pub fn quartiles(values: &[f64]) -> [Option<f64>; 3] {
    [0.25, 0.5, 0.75].map(|part| quantile(values, part))
}
