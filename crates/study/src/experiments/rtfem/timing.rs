//! Times of the steps of one run, on the clock and on the processor.

use std::time::Instant;

use super::setting::{Setting, median_and_p95};
use super::torus::Torus;

/// Times of the steps of one run, ms.
pub(super) struct Timed {
    /// The first step, which factorises.
    pub first: f64,
    /// The others: the middle, and the one below which 95 % lie.
    pub median: f64,
    pub p95: f64,
    /// Processor time of the thread that steps, the mean of the others; other programs on the machine do not change it.
    pub processor: f64,
    /// Factorisations in all steps.
    pub factorizations: usize,
    /// Iterations of the linear solver, and of Newton's method, a step.
    pub solver_iterations: f64,
    pub newton_iterations: f64,
    /// Largest step that did not converge.
    pub unconverged: usize,
}

/// Processor time of this thread so far, ms; 0 on systems other than Linux.
fn processor_time() -> f64 {
    let text = std::fs::read_to_string("/proc/thread-self/schedstat").unwrap_or_default();
    text.split(' ').next().and_then(|nanoseconds| nanoseconds.parse::<f64>().ok()).unwrap_or(0.0) * 1e-6
}

/// Times the first steps of a run.
///
/// # Errors
/// A step that fails.
pub(super) fn timed(torus: &Torus, setting: &Setting, count: usize) -> Result<Timed, String> {
    let mut simulation = setting.torus(&torus.mesh)?;
    let mut times = Vec::with_capacity(count + 1);
    let mut processor_begun = 0.0;
    for step in 0..=count {
        if step == 1 {
            processor_begun = processor_time();
        }
        let begun = Instant::now();
        simulation.step().map_err(|failure| failure.to_string())?;
        times.push(1e3 * begun.elapsed().as_secs_f64());
    }
    let processor = (processor_time() - processor_begun) / count as f64;
    let first = times.remove(0);
    let (median, p95) = median_and_p95(times);
    let counters = simulation.counters();
    let a_step = |total: usize| total as f64 / (count + 1) as f64;
    Ok(Timed {
        first,
        median,
        p95,
        processor: if processor > 0.0 { processor } else { median },
        factorizations: counters.factorizations,
        solver_iterations: a_step(counters.solver_iterations),
        newton_iterations: a_step(counters.newton_iterations),
        unconverged: counters.unconverged_steps,
    })
}
