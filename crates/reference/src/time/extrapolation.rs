//! The reference in time: Gragg–Bulirsch–Stoer extrapolation of the modified midpoint rule, which no integrator of the engine uses.
//!
//! Step numbers 2, 4, 6, … give order 2K with K columns: E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential
//! Equations I, 2nd edition, 1993, II.9, equations (9.10) and (9.13). The method is matrix-free and solves with the exact mass. Every
//! reference is computed twice, with a step and with half of it; the distance of the two is its self-check.

use nalgebra::DVector;

use super::equations::{Equations, Phase, Scratch};

/// Columns of the extrapolation; the order is twice this number.
const COLUMNS: usize = 8;

/// ω_max dt of the first step size.
const FIRST: f64 = 3.0;

/// Largest relative distance between the two solutions: of displacements, and of velocities, in which the round-off of fast
/// vibrations is larger.
pub const SELF_CHECK: (f64, f64) = (1e-10, 1e-8);

/// Halvings of the step before the reference is refused.
const MAX_HALVINGS: usize = 4;

/// The state of a body at one time, in the mesh's numbering of nodes.
#[derive(Clone, Debug, PartialEq)]
pub struct Reference {
    /// s
    pub time: f64,
    /// Positions of all nodes, m.
    pub q: DVector<f64>,
    /// Velocities of all nodes, m/s.
    pub qdot: DVector<f64>,
    /// J
    pub kinetic: f64,
    /// J
    pub potential: f64,
    /// Relative distance from the solution with twice the step: of displacements, and of velocities.
    pub check: (f64, f64),
    /// Force evaluations of the solution with the smaller step.
    pub evaluations: usize,
}

/// An interval without velocity jumps: its begin and end, s, and its number of steps.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Interval {
    begin: f64,
    end: f64,
    steps: usize,
}

/// Integrates from the start to a time, s. The error says why the scene has no reference, or that it would take longer than
/// `most_seconds`.
pub fn reference(equations: &Equations, horizon: f64, most_seconds: f64) -> Result<Reference, String> {
    let fastest = equations.fastest();
    let jumps = equations.jumps(horizon)?;
    let interval = |ends: &[f64]| {
        let steps = ((ends[1] - ends[0]) * fastest / FIRST).ceil().max(4.0) as usize;
        Interval { begin: ends[0], end: ends[1], steps }
    };
    let mut intervals: Vec<Interval> = jumps.windows(2).map(interval).collect();
    let all = |intervals: &[Interval]| intervals.iter().map(|interval| interval.steps).sum::<usize>();
    // The first solution and the one with half the step.
    let seconds = 3.0 * (all(&intervals) * COLUMNS * (COLUMNS + 1)) as f64 * seconds_of_one(equations);
    if seconds > most_seconds {
        return Err(format!("the reference in time would take {seconds:.0} s"));
    }
    let mut coarse = solve(equations, &intervals);
    for _ in 0..MAX_HALVINGS {
        intervals.iter_mut().for_each(|interval| interval.steps *= 2);
        let fine = solve(equations, &intervals);
        let check = distance(&coarse, &fine);
        // NaN fails the check.
        if check.0 <= SELF_CHECK.0 && check.1 <= SELF_CHECK.1 {
            return Ok(finished(equations, horizon, fine, check, all(&intervals)));
        }
        coarse = fine;
    }
    Err(format!("the reference in time does not converge within {} steps", all(&intervals)))
}

/// Seconds of one evaluation of the accelerations.
fn seconds_of_one(equations: &Equations) -> f64 {
    let zero = vec![[0.0; 3]; equations.nodes()];
    let (mut a, mut scratch) = (zero.clone(), Scratch::default());
    let time = |_| {
        let start = std::time::Instant::now();
        equations.accelerations(&zero, &zero, 0.0, &mut a, &mut scratch);
        start.elapsed().as_secs_f64()
    };
    (0..5).map(time).fold(f64::INFINITY, f64::min)
}

fn finished(equations: &Equations, time: f64, [u, v]: Phase, check: (f64, f64), steps: usize) -> Reference {
    let (kinetic, potential) = equations.energies(&u, &v, time);
    let system = &equations.system;
    let (u, v) = (system.numbering.to_mesh(&u), system.numbering.to_mesh(&v));
    let rest = system.shape.mesh.vertices();
    Reference {
        time,
        q: DVector::from_fn(3 * u.len(), |i, _| rest[i / 3][i % 3] + u[i / 3][i % 3]),
        qdot: DVector::from_fn(3 * v.len(), |i, _| v[i / 3][i % 3]),
        kinetic,
        potential,
        check,
        evaluations: steps * COLUMNS * (COLUMNS + 1),
    }
}

/// ‖a − b‖ / ‖b‖ of the displacements, and of the velocities.
fn distance(a: &Phase, b: &Phase) -> (f64, f64) {
    let part = |a: &[[f64; 3]], b: &[[f64; 3]]| {
        let pairs = a.as_flattened().iter().zip(b.as_flattened());
        let (apart, size) = pairs.fold((0.0, 0.0), |(apart, size), (a, b)| (apart + (a - b).powi(2), size + b * b));
        if apart == 0.0 { 0.0 } else { (apart / size).sqrt() }
    };
    (part(&a[0], &b[0]), part(&a[1], &b[1]))
}

fn solve(equations: &Equations, intervals: &[Interval]) -> Phase {
    let zero = || vec![[0.0; 3]; equations.nodes()];
    let mut now = equations.start();
    let mut work = Work { previous: [zero(), zero()], next: [zero(), zero()], a: zero(), scratch: Scratch::default() };
    let mut table: Vec<Phase> = (0..COLUMNS).map(|_| [zero(), zero()]).collect();
    for interval in intervals {
        equations.jump(interval.begin, &mut now, &mut work.scratch);
        for number in 0..interval.steps {
            advance(equations, interval, number, &mut now, &mut table, &mut work);
        }
    }
    now
}

/// One step of an interval: all columns of the extrapolation.
fn advance(
    equations: &Equations,
    interval: &Interval,
    number: usize,
    now: &mut Phase,
    table: &mut [Phase],
    work: &mut Work,
) {
    let length = interval.end - interval.begin;
    let (step, time) =
        (length / interval.steps as f64, interval.begin + length * number as f64 / interval.steps as f64);
    for row in 0..COLUMNS {
        let substeps = 2 * (row + 1);
        let mut column = midpoint(equations, now, (interval.begin, time), step, substeps, work);
        // Aitken–Neville: each entry of the table replaces the one above it.
        for (k, entry) in table.iter_mut().enumerate().take(row + 1) {
            if k == row {
                *entry = column;
                break;
            }
            let ratio = substeps as f64 / (2 * (row - k)) as f64;
            let better = extrapolated(&column, entry, 1.0 / (ratio * ratio - 1.0));
            *entry = std::mem::replace(&mut column, better);
        }
    }
    now.clone_from(&table[COLUMNS - 1]);
    equations.prescribe(interval.begin, time + step, now, &mut work.scratch);
}

/// T + (T − T') w.
fn extrapolated(fine: &Phase, coarse: &Phase, weight: f64) -> Phase {
    let blend = |fine: &[[f64; 3]], coarse: &[[f64; 3]]| {
        let pairs = fine.iter().zip(coarse);
        pairs.map(|(f, c)| std::array::from_fn(|i| f[i] + (f[i] - c[i]) * weight)).collect()
    };
    [blend(&fine[0], &coarse[0]), blend(&fine[1], &coarse[1])]
}

/// Working memory of the midpoint rule.
struct Work {
    previous: Phase,
    next: Phase,
    a: Vec<[f64; 3]>,
    scratch: Scratch,
}

/// y₁ = y₀ + h f(y₀), y_{m+1} = y_{m−1} + 2h f(y_m): an even number of substeps, without smoothing.
/// `begin` is the start of the interval that contains `time`, s.
fn midpoint(
    equations: &Equations,
    now: &Phase,
    (begin, time): (f64, f64),
    step: f64,
    substeps: usize,
    work: &mut Work,
) -> Phase {
    let Work { previous, next, a, scratch } = work;
    let h = step / substeps as f64;
    let mut at = now.clone();
    for m in 0..substeps {
        let instant = time + m as f64 * h;
        equations.prescribe(begin, instant, &mut at, scratch);
        equations.accelerations(&at[0], &at[1], instant, a, scratch);
        let (from, length) = if m == 0 { (now, h) } else { (&*previous, 2.0 * h) };
        for ((next, from), v) in next[0].iter_mut().zip(&from[0]).zip(&at[1]) {
            *next = std::array::from_fn(|i| from[i] + length * v[i]);
        }
        for ((next, from), a) in next[1].iter_mut().zip(&from[1]).zip(&*a) {
            *next = std::array::from_fn(|i| from[i] + length * a[i]);
        }
        // previous ← at ← next; the old previous is overwritten in the next pass.
        std::mem::swap(previous, &mut at);
        std::mem::swap(&mut at, next);
    }
    at
}
