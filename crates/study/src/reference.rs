//! What a body truly does, as far as its elements let it: a reference in time by a method that is under no test here.
//!
//! Extrapolation of the modified midpoint rule with step numbers 2, 4, 6, … (Gragg, Bulirsch and Stoer): order 2K with K columns.
//! E. Hairer, S. P. Nørsett, G. Wanner, Solving Ordinary Differential Equations I, 2nd edition, 1993, II.9, equations (9.10) and
//! (9.13). Matrix-free, with the mass solved exactly. Every reference is computed twice, the second time with half the step,
//! and their distance is told with it.

use nalgebra::DVector;

use super::equations::{Equations, Scratch};
use super::led::Phase;

/// Columns of the extrapolation: the order is twice as high.
const COLUMNS: usize = 8;

/// Fastest vibration times the first step that is tried.
const FIRST: f64 = 3.0;

/// Largest distance between the two solutions, as a part of their own size: of displacements, and of velocities, in which the
/// round-off of fast vibrations is larger.
pub const SELF_CHECK: (f64, f64) = (1e-10, 1e-8);

/// Halvings after which a reference is given up.
const MOST_HALVINGS: usize = 4;

/// The state of a body at one time, in the mesh's order of nodes.
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
    /// Distance from the solution with twice the step, relative: of displacements, and of velocities.
    pub check: (f64, f64),
    /// Force evaluations of the finer of the two.
    pub evaluations: usize,
}

/// A time in which nothing jumps: its begin and end, s, and into how many steps it is cut.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Piece {
    begin: f64,
    end: f64,
    steps: usize,
}

/// The state at a time, s, from rest. Says why where there is none, or where it would take longer than `most_seconds`.
pub fn reference(equations: &Equations, horizon: f64, most_seconds: f64) -> Result<Reference, String> {
    let fastest = equations.fastest();
    let jumps = equations.jumps(horizon)?;
    let piece = |ends: &[f64]| {
        let steps = ((ends[1] - ends[0]) * fastest / FIRST).ceil().max(4.0) as usize;
        Piece { begin: ends[0], end: ends[1], steps }
    };
    let mut pieces: Vec<Piece> = jumps.windows(2).map(piece).collect();
    let all = |pieces: &[Piece]| pieces.iter().map(|piece| piece.steps).sum::<usize>();
    // The first solution and the one with half the step.
    let seconds = 3.0 * (all(&pieces) * COLUMNS * (COLUMNS + 1)) as f64 * seconds_of_one(equations);
    if seconds > most_seconds {
        return Err(format!("the reference in time would take {seconds:.0} s"));
    }
    let mut coarse = solve(equations, &pieces);
    for _ in 0..MOST_HALVINGS {
        pieces.iter_mut().for_each(|piece| piece.steps *= 2);
        let fine = solve(equations, &pieces);
        let check = distance(&coarse, &fine);
        // NaN fails it.
        if check.0 <= SELF_CHECK.0 && check.1 <= SELF_CHECK.1 {
            return Ok(finished(equations, horizon, fine, check, all(&pieces)));
        }
        coarse = fine;
    }
    Err(format!("the reference in time does not settle within {} steps", all(&pieces)))
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
    let (u, v) = (system.order.to_mesh(&u), system.order.to_mesh(&v));
    let rest = &system.shape.mesh.vertices;
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

fn solve(equations: &Equations, pieces: &[Piece]) -> Phase {
    let zero = || vec![[0.0; 3]; equations.nodes()];
    let mut now: Phase = [zero(), zero()];
    let mut work = Work { previous: [zero(), zero()], next: [zero(), zero()], a: zero(), scratch: Scratch::default() };
    let mut table: Vec<Phase> = (0..COLUMNS).map(|_| [zero(), zero()]).collect();
    for piece in pieces {
        equations.kick(piece.begin, &mut now, &mut work.scratch);
        for number in 0..piece.steps {
            advance(equations, piece, number, &mut now, &mut table, &mut work);
        }
    }
    now
}

/// One step of a piece: all columns of the extrapolation.
fn advance(equations: &Equations, piece: &Piece, number: usize, now: &mut Phase, table: &mut [Phase], work: &mut Work) {
    let length = piece.end - piece.begin;
    let (step, time) = (length / piece.steps as f64, piece.begin + length * number as f64 / piece.steps as f64);
    for row in 0..COLUMNS {
        let substeps = 2 * (row + 1);
        let mut column = midpoint(equations, now, (piece.begin, time), step, substeps, work);
        // Aitken and Neville: each entry of the table takes the place of the one above it.
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
    equations.lead(piece.begin, time + step, now, &mut work.scratch);
}

/// T + (T − T') w.
fn extrapolated(fine: &Phase, coarse: &Phase, weight: f64) -> Phase {
    let blend = |fine: &[[f64; 3]], coarse: &[[f64; 3]]| {
        let pairs = fine.iter().zip(coarse);
        pairs.map(|(f, c)| std::array::from_fn(|i| f[i] + (f[i] - c[i]) * weight)).collect()
    };
    [blend(&fine[0], &coarse[0]), blend(&fine[1], &coarse[1])]
}

/// Vectors that the midpoint rule writes to.
struct Work {
    previous: Phase,
    next: Phase,
    a: Vec<[f64; 3]>,
    scratch: Scratch,
}

/// y₁ = y₀ + h f(y₀), y_{m+1} = y_{m−1} + 2h f(y_m): an even number of substeps, no smoothing.
/// `begin` is when the piece began that `time` belongs to, s.
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
        equations.lead(begin, instant, &mut at, scratch);
        equations.accelerations(&at[0], &at[1], instant, a, scratch);
        let (from, length) = if m == 0 { (now, h) } else { (&*previous, 2.0 * h) };
        for ((next, from), v) in next[0].iter_mut().zip(&from[0]).zip(&at[1]) {
            *next = std::array::from_fn(|i| from[i] + length * v[i]);
        }
        for ((next, from), a) in next[1].iter_mut().zip(&from[1]).zip(&*a) {
            *next = std::array::from_fn(|i| from[i] + length * a[i]);
        }
        // previous ← at ← next; the old previous is written over next time.
        std::mem::swap(previous, &mut at);
        std::mem::swap(&mut at, next);
    }
    at
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use super::*;
    use fem_scene::{body, parse};

    fn equations(text: &str) -> Equations {
        let scene = parse(text, Path::new("folder/name.toml")).unwrap();
        let body = body(&scene, Path::new("no data")).unwrap();
        Equations::new(&scene, body).unwrap()
    }

    #[test]
    fn free_fall_is_exact() {
        let text = "pipeline = \"engine\"\n[mesh]\nbox = { size = [1, 1, 1], cells_per_unit = 1 }\n[material]\n\
            model = \"neo_hookean\"\nC = 1e4\nD = 4e4\ndensity = 1000.0\n[gravity]\nacceleration = [0, -9.81, 0]\n\
            [time]\ndt = 0.01\nintegrator = \"verlet\"\n";
        let reference = reference(&equations(text), 0.5, 60.0).unwrap();
        assert!(reference.check.0 <= SELF_CHECK.0 && reference.check.1 <= SELF_CHECK.1);
        for (i, v) in reference.qdot.iter().enumerate() {
            let expected = if i % 3 == 1 { -9.81 * 0.5 } else { 0.0 };
            assert!((v - expected).abs() < 1e-11, "{v} {expected}");
        }
    }

    #[test]
    fn a_node_on_a_spring_swings_as_the_cosine_says() {
        // All nodes but one are held, the body itself is too soft to matter: ü = 1 − ω² u, ω² = k/m.
        let text = "pipeline = \"engine\"\n[mesh]\nbox = { size = [2, 1, 1], cells_per_unit = 1 }\n[material]\n\
            model = \"linear\"\nyoung = 1e-9\npoisson = 0.0\ndensity = 1000.0\n[mass]\nlumped = true\n[gravity]\n\
            acceleration = [1, 0, 0]\n[fixed]\nnodes = [0, 1, 2, 3, 4, 6, 7, 8, 9, 10, 11]\n[[springs]]\nnodes = [4, 5]\n\
            stiffness = 1e4\n[time]\ndt = 0.01\nintegrator = \"verlet\"\n";
        let equations = equations(text);
        let fastest = equations.fastest();
        let found = reference(&equations, 3.0, 60.0).unwrap();
        let expected = (1.0 - (fastest * 3.0).cos()) / (fastest * fastest);
        let moved = found.q[15] - 2.0;
        // The force along the spring is not quite linear in the displacement across it; along it, it is.
        assert!((moved - expected).abs() < 1e-9 * (2.0 / (fastest * fastest)), "{moved} {expected}");
    }

    #[test]
    fn energy_is_kept_to_the_self_check() {
        let text = "pipeline = \"engine\"\n[mesh]\nbox = { size = [2, 1, 1], cells_per_unit = 1 }\n[material]\n\
            model = \"neo_hookean\"\nC = 1e4\nD = 4e4\ndensity = 1000.0\n[gravity]\nacceleration = [0, -9.81, 0]\n\
            [fixed]\nplane = { axis = \"x\", below = 1e-9 }\n[time]\ndt = 0.01\nintegrator = \"verlet\"\n";
        let found = reference(&equations(text), 0.3, 60.0).unwrap();
        assert!((found.kinetic + found.potential).abs() < 1e-9 * found.kinetic, "{found:?}");
    }
}
