//! Measurement of runs. The first run records the state at the end and the energies on the way. Later runs are timed only, in turn
//! with all other runs, so that other load on the machine affects all of them alike.

use std::time::Instant;

use nalgebra::DVector;

use crate::machine;
use crate::runs::plan::PlannedRun;
use fem_model::simulation::{Counters, Simulation};
use fem_output::quantile;
use fem_scene::Scene;

/// Builds the simulation of a scene with the pipeline that the scene names.
pub type Factory<'a> = dyn Fn(&Scene) -> Result<Box<dyn Simulation>, String> + Sync + 'a;

/// The result of a run.
#[derive(Clone, Debug, PartialEq)]
pub struct RunResult {
    /// Time at the end, s.
    pub time: f64,
    /// Positions of all nodes, m.
    pub q: DVector<f64>,
    /// Velocities of all nodes, m/s.
    pub qdot: DVector<f64>,
    /// Kinetic and potential energy at the end, J.
    pub energies: (f64, f64),
    /// Samples of time, s, and total energy, J.
    pub history: Vec<(f64, f64)>,
    /// Smallest J of all samples.
    pub min_j: f64,
    /// Counters of the run.
    pub counters: Counters,
    /// Sum of the estimated errors of adaptive steps, m; `None` without them.
    pub estimated: Option<f64>,
    /// The failure that ended the run early.
    pub failure: Option<String>,
    /// Distance from the scene's closed form; `None` without one.
    pub analytic: Option<f64>,
    /// Peak memory of the process, MB.
    pub peak_mb: Option<f64>,
    /// Processor time of steps and samples, s; wall-clock time if the system has no such counter.
    pub spent: f64,
    /// Times of this run.
    pub timing: Timing,
}

/// Times of one run.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Timing {
    /// Set-up, s.
    pub setup: f64,
    /// Each step, s.
    pub steps: Vec<f64>,
    /// Processor time of all steps in all threads, s; `None` if unknown, or if samples were taken between the steps.
    pub processor: Option<f64>,
}

impl Timing {
    /// Sum over all steps, s.
    pub fn total(&self) -> f64 {
        self.steps.iter().sum()
    }
}

/// Samples of a run.
const SAMPLES: usize = 120;

/// The reason why a run has no result.
#[derive(Clone, Debug, PartialEq)]
pub struct Refusal {
    /// A sentence.
    pub reason: String,
    /// Time spent, s, and steps done in it.
    pub spent: Option<(f64, usize)>,
}

/// Runs and takes samples; gives up after `most_seconds`.
pub fn first(factory: &Factory, run: &PlannedRun, most_seconds: f64) -> Result<RunResult, Refusal> {
    machine::reset_peak();
    let (start, before) = (Instant::now(), machine::processor_seconds());
    let mut simulation = factory(&run.scene).map_err(|reason| Refusal { reason, spent: None })?;
    let mut timing = Timing { setup: start.elapsed().as_secs_f64(), ..Timing::default() };
    let every = run.steps.div_ceil(SAMPLES);
    let (mut history, mut min_j) = (vec![(0.0, simulation.energies().total())], simulation.min_J().0);
    let mut estimated: Option<f64> = None;
    let failure = steps(&mut *simulation, run.steps, &mut timing, |simulation, step| {
        if let Some(error) = simulation.estimated_error() {
            estimated = Some(estimated.unwrap_or_default() + error);
        }
        if step % every == 0 || step == run.steps {
            history.push((simulation.time(), simulation.energies().total()));
            min_j = min_j.min(simulation.min_J().0);
        }
        start.elapsed().as_secs_f64() < most_seconds
    });
    // Processor time: other load on the machine must not decide which runs are made.
    let spent = machine::processor_seconds().zip(before).map_or(timing.total(), |(after, before)| after - before);
    let count = timing.steps.len();
    if failure.is_none() && count < run.steps {
        let reason = format!("stopped in step {count} of {}, after {most_seconds:.0} s", run.steps);
        return Err(Refusal { reason, spent: Some((spent, count)) });
    }
    let energies = simulation.energies();
    Ok(RunResult {
        time: simulation.time(),
        q: simulation.positions(),
        qdot: simulation.velocities(),
        energies: (energies.kinetic, energies.potential),
        history,
        min_j,
        counters: simulation.counters(),
        estimated,
        analytic: fem_reference::space::closed_forms::error(&run.scene, &*simulation).filter(|_| failure.is_none()),
        failure,
        peak_mb: machine::peak_mb(),
        spent,
        timing,
    })
}

/// Runs and measures times only.
pub fn again(factory: &Factory, run: &PlannedRun) -> Result<Timing, String> {
    let start = Instant::now();
    let mut simulation = factory(&run.scene)?;
    let mut timing = Timing { setup: start.elapsed().as_secs_f64(), ..Timing::default() };
    let before = machine::processor_seconds();
    steps(&mut *simulation, run.steps, &mut timing, |_, _| true);
    timing.processor = machine::processor_seconds().zip(before).map(|(after, before)| after - before);
    Ok(timing)
}

/// Takes steps while `sample` returns true. Only the steps are timed.
fn steps(
    simulation: &mut dyn Simulation,
    count: usize,
    timing: &mut Timing,
    mut sample: impl FnMut(&dyn Simulation, usize) -> bool,
) -> Option<String> {
    timing.steps.reserve(count);
    for step in 1..=count {
        let start = Instant::now();
        let outcome = simulation.step();
        timing.steps.push(start.elapsed().as_secs_f64());
        if let Err(failure) = outcome {
            return Some(failure.to_string());
        }
        if !sample(simulation, step) {
            break;
        }
    }
    None
}

/// Numbers of repetitions.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TimingPlan {
    /// Least and largest number of repetitions.
    pub repetitions: (usize, usize),
    /// Time after which no repetitions are added to the least number, s.
    pub seconds: f64,
    /// A first run longer than this needs no warm-up and counts as a repetition, s.
    pub long: f64,
}

impl TimingPlan {
    /// The plan of the full study, or of the short one, of which each first run is the only one.
    pub fn new(is_quick: bool) -> Self {
        let repetitions = if is_quick { (1, 1) } else { (3, 9) };
        Self { repetitions, seconds: 0.6, long: if is_quick { 0.0 } else { 2.0 } }
    }

    /// Times all runs in turn, round after round. `tell` is called after each.
    pub fn time(&self, factory: &Factory, runs: &[(&PlannedRun, &Timing)], mut tell: impl FnMut()) -> Vec<Vec<Timing>> {
        let counts = |timing: &Timing| timing.total() > self.long;
        let mut clocks: Vec<Vec<Timing>> =
            runs.iter().map(|(_, first)| if counts(first) { vec![(*first).clone()] } else { Vec::new() }).collect();
        for _ in 0..self.repetitions.1 {
            for ((run, _), clocks) in runs.iter().zip(&mut clocks) {
                let spent: f64 = clocks.iter().map(|clock| clock.total() + clock.setup).sum();
                let is_enough = clocks.len() >= self.repetitions.0 && spent > self.seconds;
                if clocks.len() < self.repetitions.1 && !is_enough {
                    // The simulation was built before, so building it again succeeds.
                    clocks.extend(again(factory, run));
                }
                tell();
            }
        }
        clocks
    }

    /// Number of calls of `tell` by [`time`](Self::time) for a number of runs.
    pub fn calls(&self, runs: usize) -> usize {
        self.repetitions.1 * runs
    }
}

/// Lower quartile, median and upper quartile.
pub fn quartiles(values: &[f64]) -> [Option<f64>; 3] {
    [0.25, 0.5, 0.75].map(|part| quantile(values, part))
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use fem_scene::{body, parse};

    fn build(scene: &Scene) -> Result<Box<dyn Simulation>, String> {
        let body = body(scene, Path::new("no data")).map_err(|error| error.to_string())?;
        scene
            .check_one_body()
            .and_then(|()| fem_engine::simulator::build(body, &scene.method()))
            .map_err(|refusal| scene.refused(refusal).to_string())
    }

    fn run(dt: f64, steps: usize) -> PlannedRun {
        let text = format!(
            "pipeline = \"engine\"\n[mesh]\nbox = {{ size = [1, 1, 1], cells_per_unit = 1 }}\n[material]\n\
             model = \"neo_hookean\"\nC = 1e4\nD = 4e4\ndensity = 1000.0\n[gravity]\nacceleration = [0, -9.81, 0]\n\
             [fixed]\nplane = {{ axis = \"x\", below = 1e-9 }}\n[time]\ndt = {dt:e}\nintegrator = \"explicit_euler\"\n"
        );
        let scene = parse(&text, Path::new("box.toml")).unwrap();
        PlannedRun { group: "method", method: "explicit Euler".to_owned(), scene, steps }
    }

    #[test]
    fn a_run_is_sampled_from_start_to_end() {
        let outcome = first(&build, &run(1e-3, 300), 60.0).unwrap();
        assert_eq!(outcome.failure, None);
        assert_eq!((outcome.counters.steps, outcome.timing.steps.len()), (300, 300));
        let times: Vec<f64> = outcome.history.iter().map(|(time, _)| *time).collect();
        assert_eq!(times[0], 0.0);
        assert!((times[times.len() - 1] - 0.3).abs() < 1e-9 && times.len() <= SAMPLES + 2, "{}", times.len());
    }

    #[test]
    fn a_diverging_run_reports_its_step() {
        let outcome = first(&build, &run(1.0, 20), 60.0).unwrap();
        assert!(outcome.failure.is_some_and(|failure| failure.contains("failed in step")));
    }

    #[test]
    fn a_slow_run_is_stopped() {
        let refusal = first(&build, &run(1e-3, 300), 0.0).unwrap_err();
        assert!(refusal.reason.contains("step 1 of 300") && refusal.spent.is_some(), "{refusal:?}");
    }

    #[test]
    fn all_runs_have_the_least_number_of_repetitions() {
        let runs = [run(1e-3, 5), run(1e-3, 10)];
        let clock = Timing::default();
        let patience = TimingPlan { repetitions: (2, 4), seconds: 0.0, long: 1.0 };
        let mut told = 0;
        let clocks = patience.time(&build, &[(&runs[0], &clock), (&runs[1], &clock)], || told += 1);
        assert_eq!(clocks.iter().map(Vec::len).collect::<Vec<_>>(), [2, 2]);
        assert_eq!(clocks[1][0].steps.len(), 10);
        assert_eq!(told, patience.calls(2));
    }
}
