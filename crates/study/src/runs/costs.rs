//! Costs of the parts of a step on this machine, each timed alone. With the counters of a run they give the shares of its time.

use std::time::Instant;

use serde::{Deserialize, Serialize};

use crate::runs::row::Row;
use fem_engine::forces::Moment;
use fem_engine::simulator::double;
use fem_engine::solvers::SolverChoice;
use fem_output::quantile;
use fem_reference::time::Equations;

/// Time of one call, s.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Costs {
    /// Internal forces.
    pub force: f64,
    /// Energy and internal forces together.
    pub pass: f64,
    /// Assembly of the stiffness matrix.
    pub stiffness: f64,
    /// Its Cholesky factorization.
    pub factor: f64,
    /// Forward and backward substitution.
    pub substitution: f64,
}

/// The parts, in the order of [`shares`].
pub const KINDS: [&str; 5] =
    ["forces and energies", "stiffness", "factorization", "substitution", "mass and remainder"];

/// Times each part for the undeformed body.
pub fn measure(equations: &Equations) -> Costs {
    let system = &equations.system;
    let u = vec![[0.0; 3]; system.nodes()];
    let mut gradient = u.clone();
    let mut values = vec![[[0.0; 3]; 3]; system.pattern.blocks()];
    let moment = Moment::at(0.0);
    let mut solver = system.solver(SolverChoice::Cholesky);
    let force = median(|| double::gradient(system, &u, moment, &mut gradient));
    let pass = median(|| {
        double::potential_and_gradient(system, &u, moment, &mut gradient);
    });
    let stiffness = median(|| {
        values.fill([[0.0; 3]; 3]);
        double::add_stiffness(system, &u, &mut values);
    });
    // The mass makes the matrix positive definite, as in a step.
    system.mass.add_to(1e4, &system.pattern, &mut values);
    system.dirichlet.eliminate(&system.pattern, &mut values);
    let mut is_factor = false;
    let factor = median(|| is_factor = solver.prepare(&values).is_ok());
    let mut x = vec![[0.0; 3]; system.nodes()];
    let substitution = if is_factor { median(|| solver.apply(&gradient, &mut x)) } else { 0.0 };
    Costs { force, pass, stiffness, factor, substitution }
}

fn median(mut work: impl FnMut()) -> f64 {
    let mut times = Vec::new();
    let begin = Instant::now();
    while times.len() < 5 || (times.len() < 40 && begin.elapsed().as_secs_f64() < 0.2) {
        let start = Instant::now();
        work();
        times.push(start.elapsed().as_secs_f64());
    }
    quantile(&times, 0.5).unwrap_or_default()
}

/// Milliseconds of a step for each of [`KINDS`]. `None` for runs that these costs do not describe: iterative solvers, LU, single
/// precision, the course.
pub fn shares(costs: &Costs, row: &Row) -> Option<[f64; 5]> {
    let case = &row.config;
    let is_known = ["automatic", "cholesky", "none"].contains(&&*case.solver);
    if case.pipeline != "engine" || case.precision != "f64" || !is_known {
        return None;
    }
    let (counters, steps) = (&row.counters, row.counters.steps.max(1) as f64);
    let per_step = |count: usize, seconds: f64| 1e3 * count as f64 * seconds / steps;
    let pass = if counters.energy_evaluations > 0 { costs.pass } else { costs.force };
    let mut known = [
        per_step(counters.force_assemblies, pass),
        per_step(counters.stiffness_assemblies, costs.stiffness),
        per_step(counters.factorizations, costs.factor),
        per_step(row.linear_solves(), costs.substitution),
    ];
    // The median step: other load on the machine lengthens some steps, but not the parts that were timed alone.
    let whole = row.times.step_ms[0]?;
    let rest = (whole - known.iter().sum::<f64>()).max(0.0);
    // Steps with a new factorization take longer than the median.
    let fitting = (whole / known.iter().sum::<f64>()).min(1.0);
    known.iter_mut().for_each(|part| *part *= fitting);
    Some([known[0], known[1], known[2], known[3], rest])
}
